#include "cli/terrain_view_option.h"

#include <filesystem>

#include "cli/view_option.h"
#include "validation/joint/terrain_problem.h"

namespace etalon::cli {

std::string plain_name(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!is_plain) c = '-';
  }
  return name;
}

validation::NamedTerrainView chosen_terrain_view(const std::string& text, const std::string& size, FrameSize fallback,
                                                 const terrain::HeightField& field) {
  const ViewChoice choice = parse_view(text);
  const FrameSize frame = !size.empty() ? parse_size(size) : choice.size.value_or(fallback);
  const bool is_file = choice.named.camera.has_value();
  const Camera camera =
      is_file ? *choice.named.camera : named_view(choice.named.name, bounding_box(validation::full_mesh(field)), frame.width, frame.height);
  std::string name = plain_name(is_file ? std::filesystem::path(text).stem().string() : text);
  if (constexpr std::string_view kSuffix = "-view"; name.size() > kSuffix.size() && name.ends_with(kSuffix))
    name.resize(name.size() - kSuffix.size());
  return {.name = std::move(name),
          .title = choice.named.name,
          .view = {.eye = camera.eye,
                   .target = camera.target,
                   .up = camera.up,
                   .tan_half_fov_y = camera.tan_half_fov_y,
                   .near = camera.near,
                   .far = camera.far,
                   .width = frame.width,
                   .height = frame.height}};
}

}  // namespace etalon::cli
