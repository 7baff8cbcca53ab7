#include "cli/view_option.h"

#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/usage_error.h"
#include "core/base/error.h"
#include "core/io/inputs.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::json;

bool is_built_in(const std::string& text) {
  if (text == "front" || text == "fit") return true;
  const std::size_t slash = text.find("/24");
  if (slash == std::string::npos || slash + 3 != text.size()) return false;
  int index = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + slash, index);
  return error == std::errc() && end == text.data() + slash && index >= 0 && index < 24;
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) { throw InputError(fmt::format("{}: {}", file, what)); }

double number(const Json& document, const std::string& file, const char* key) {
  if (!document.contains(key) || !document[key].is_number()) refuse(file, fmt::format("'{}': expected a number", key));
  const double value = document[key].get<double>();
  if (!std::isfinite(value)) refuse(file, fmt::format("'{}': expected a finite number", key));
  return value;
}

Vec3d vector3(const Json& document, const std::string& file, const char* key) {
  if (!document.contains(key) || !document[key].is_array() || document[key].size() != 3)
    refuse(file, fmt::format("'{}': expected three numbers", key));
  Vec3d result{0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const Json& item = document[key][static_cast<std::size_t>(i)];
    if (!item.is_number()) refuse(file, fmt::format("'{}': expected three numbers", key));
    result[i] = item.get<double>();
  }
  return result;
}

int side(const Json& document, const std::string& file, const char* key) {
  const bool is_integer = document.contains(key) && document[key].is_number_integer();
  if (!is_integer || document[key] < 1 || document[key] > kMaxFrameSize)
    refuse(file, fmt::format("'{}': expected a whole number from 1 to {}", key, kMaxFrameSize));
  return document[key].get<int>();
}

ViewChoice read_view(const std::string& file) {
  const io::FileBytes bytes = io::read_file(file);
  const Json document = Json::parse(bytes.text().begin(), bytes.text().end(), nullptr, false);
  if (document.is_discarded() || !document.is_object()) refuse(file, "expected a JSON object (etalon/view/1)");
  // Not document.value(): it would copy whatever stands there, by recursion.
  if (!document.contains("schema") || !document["schema"].is_string() || document["schema"] != "etalon/view/1")
    refuse(file, "'schema': expected \"etalon/view/1\"");
  ViewChoice view;
  view.named.name = std::filesystem::path(file).filename().string();
  Camera& camera = view.named.camera.emplace();
  camera.eye = vector3(document, file, "eye");
  camera.target = vector3(document, file, "target");
  camera.up = vector3(document, file, "up");
  camera.tan_half_fov_y = number(document, file, "tan_half_fov_y");
  camera.near = number(document, file, "near");
  camera.far = number(document, file, "far");
  if (document.contains("width") || document.contains("height"))
    view.size = FrameSize{side(document, file, "width"), side(document, file, "height")};
  try {
    (void)clip_from_object(camera, 1, 1);  // whether a view is degenerate does not depend on the aspect
  } catch (const InputError& error) {
    refuse(file, error.what());
  }
  return view;
}

}  // namespace

ViewChoice parse_view(const std::string& text) {
  if (is_built_in(text)) return {{text, {}}, {}};
  if (!std::filesystem::exists(text)) throw UsageError(fmt::format("--view: expected front, fit, 0/24 to 23/24 or a file, got '{}'", text));
  return read_view(text);
}

FrameSize frame_size(const std::string& size, const std::vector<ViewChoice>& views) {
  if (!size.empty()) return parse_size(size);
  std::optional<FrameSize> result;
  for (const ViewChoice& view : views) {
    if (!view.size) continue;
    if (result && *result != *view.size) throw UsageError("--view: the files name frames of different sizes: give --size");
    result = view.size;
  }
  return result.value_or(FrameSize{1024, 1024});
}

}  // namespace etalon::cli
