#include "core/io/draws_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/io/input_error.h"
#include "core/io/json_ref.h"

namespace etalon::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kSnaps{SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero,
                            SnapRounding::floor};
constexpr std::array kFillRules{FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax};
constexpr std::array kHalfRoundings{HalfRounding::nearest_even, HalfRounding::toward_zero};
constexpr std::array kCullModes{CullMode::none, CullMode::clockwise, CullMode::counter_clockwise};
constexpr std::array kFilters{Filter::nearest, Filter::linear};
constexpr std::array kWraps{Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat};
constexpr std::array kShadings{Shading::vertex_color, Shading::texture, Shading::indexed};
constexpr std::array kContents{TargetContent::color, TargetContent::triangle_id, TargetContent::barycentrics, TargetContent::coordinate,
                               TargetContent::depth, TargetContent::margins,     TargetContent::bound_terms};
constexpr std::array kTypes{ChannelType::unorm8, ChannelType::srgb8,   ChannelType::unorm16,
                            ChannelType::half,   ChannelType::float32, ChannelType::uint32};

std::string name_of(CullMode value) {
  switch (value) {
    case CullMode::none: return "none";
    case CullMode::clockwise: return "clockwise";
    case CullMode::counter_clockwise: return "counter_clockwise";
  }
  return "?";
}

std::string name_of(Shading value) {
  switch (value) {
    case Shading::vertex_color: return "vertex_color";
    case Shading::texture: return "texture";
    case Shading::indexed: return "indexed";
  }
  return "?";
}

template <class Value>
std::string name_of(Value value) {
  return to_string(value);
}

template <class Value, std::size_t kCount>
Value one_of(const JsonRef& at, const std::array<Value, kCount>& values) {
  const std::string text = at.text();
  std::vector<std::string> names;
  for (const Value value : values) {
    names.push_back(name_of(value));
    if (names.back() == text) return value;
  }
  at.fail(fmt::format("expected one of {}, got '{}'", fmt::join(names, ", "), printable(text)));
}

std::uint64_t integer_within(const JsonRef& at, std::uint64_t low, std::uint64_t high) {
  const std::uint64_t value = at.integer();
  if (value < low || value > high) at.fail(fmt::format("expected {} to {}, got {}", low, high, value));
  return value;
}

PixelFormat pixel_format(const JsonRef& at) {
  const std::string text = at.text();
  for (const ChannelType type : kTypes)
    for (int channels = 1; channels <= 4; ++channels)
      if (name_of(PixelFormat{type, channels}) == text) return {type, channels};
  at.fail(fmt::format("expected channels and type such as 'rgba unorm8', got '{}'", printable(text)));
}

TargetSpec target(const JsonRef& at) {
  at.require_only({"content", "format", "clear"});
  TargetSpec spec{.content = one_of(at.at("content"), kContents), .format = pixel_format(at.at("format"))};
  if (!at.has("clear")) return spec;
  const JsonRef clear = at.at("clear");
  if (clear.size() != spec.clear.size()) clear.fail(fmt::format("expected 4 numbers, got {}", clear.size()));
  for (std::size_t c = 0; c < spec.clear.size(); ++c) {
    spec.clear[c] = static_cast<float>(clear.at(c).real());
    if (!std::isfinite(spec.clear[c])) clear.at(c).fail("expected a number within float32");
  }
  return spec;
}

Frame frame(const JsonRef& root) {
  Frame result;
  const JsonRef size = root.at("frame");
  size.require_only({"width", "height", "guard"});
  constexpr std::uint64_t kMost = 16384;
  result.width = static_cast<int>(integer_within(size.at("width"), 1, kMost));
  result.height = static_cast<int>(integer_within(size.at("height"), 1, kMost));
  if (size.has("guard")) result.guard = static_cast<int>(integer_within(size.at("guard"), 0, kMost));
  const JsonRef state = root.at("state");
  state.require_only({"subtexel_bits", "snap", "fill_rule", "half_rounding", "cull", "depth_test"});
  result.state.subtexel_bits = static_cast<int>(integer_within(state.at("subtexel_bits"), 1, 16));
  result.state.snap = one_of(state.at("snap"), kSnaps);
  result.state.fill_rule = one_of(state.at("fill_rule"), kFillRules);
  result.state.half_rounding = one_of(state.at("half_rounding"), kHalfRoundings);
  result.state.cull = one_of(state.at("cull"), kCullModes);
  result.state.depth_test = state.at("depth_test").boolean();
  for (std::size_t n = 0; root.has("targets") && n < root.at("targets").size(); ++n) {
    const JsonRef at = root.at("targets").at(n);
    const TargetSpec spec = target(at);
    for (const TargetSpec& other : result.targets)
      if (other.content == spec.content) at.at("content").fail("expected each content once, got '" + name_of(spec.content) + "' again");
    result.targets.push_back(spec);
  }
  return result;
}

DrawsImage image(const JsonRef& at) {
  at.require_only({"path", "sha256", "color_space", "first_row"});
  DrawsImage result{.path = at.at("path").text(), .sha256 = at.at("sha256").text()};
  const auto plain = [](unsigned char c) { return c >= 0x20 && c != 0x7F; };
  if (result.path.empty() || !std::all_of(result.path.begin(), result.path.end(), plain))
    at.at("path").fail("expected a file name without control characters, got '" + printable(result.path) + "'");
  const bool is_hash = result.sha256.size() == 64 && result.sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!is_hash) at.at("sha256").fail("expected 64 hexadecimal digits in lower case, got '" + printable(result.sha256) + "'");
  const auto is_second = [&](const char* key, const std::string& first, const std::string& second) {
    const std::string text = at.text_or(key, first.c_str());
    if (text != first && text != second) at.at(key).fail(fmt::format("expected '{}' or '{}', got '{}'", first, second, printable(text)));
    return text == second;
  };
  result.srgb = is_second("color_space", "linear", "srgb");
  result.top_first = is_second("first_row", "bottom", "top");
  return result;
}

Sampler sampler(const JsonRef& at) {
  at.require_only({"filter", "wrap_u", "wrap_v"});
  return {one_of(at.at("filter"), kFilters), one_of(at.at("wrap_u"), kWraps), one_of(at.at("wrap_v"), kWraps)};
}

std::uint32_t image_index(const JsonRef& at, std::size_t image_count) {
  const std::uint64_t index = at.integer();
  if (index >= image_count) at.fail(fmt::format("expected an image below {}, got {}", image_count, index));
  return static_cast<std::uint32_t>(index);
}

DrawsDraw draw(const JsonRef& at, std::size_t image_count) {
  const Shading shading = one_of(at.at("shading"), kShadings);
  switch (shading) {
    case Shading::vertex_color: at.require_only({"space", "vertices", "triangles", "shading"}); break;
    case Shading::texture: at.require_only({"space", "vertices", "triangles", "shading", "texture", "sampler"}); break;
    case Shading::indexed:
      at.require_only({"space", "vertices", "triangles", "shading", "texture", "sampler", "indexing_map", "map_sampler"});
      break;
  }
  DrawsDraw result;
  const std::string space = at.at("space").text();
  result.clip_space = space == "clip";
  if (!result.clip_space && space != "raster") at.at("space").fail("expected 'clip' or 'raster', got '" + printable(space) + "'");
  result.vertex_count = integer_within(at.at("vertices"), 0, kNoTriangle - 1);
  result.draw.triangle_count = static_cast<std::uint32_t>(integer_within(at.at("triangles"), 0, kNoTriangle - 1));
  result.draw.shading = shading;
  if (shading == Shading::vertex_color) return result;
  result.draw.texture = image_index(at.at("texture"), image_count);
  result.draw.sampler = sampler(at.at("sampler"));
  if (shading == Shading::texture) return result;
  result.draw.indexing_map = image_index(at.at("indexing_map"), image_count);
  result.draw.map_sampler = sampler(at.at("map_sampler"));
  return result;
}

Json to_json(const Sampler& s) { return {{"filter", name_of(s.filter)}, {"wrap_u", name_of(s.wrap_u)}, {"wrap_v", name_of(s.wrap_v)}}; }

Json to_json(const DrawsDraw& d) {
  Json json = {{"space", d.clip_space ? "clip" : "raster"},
               {"vertices", d.vertex_count},
               {"triangles", d.draw.triangle_count},
               {"shading", name_of(d.draw.shading)}};
  if (d.draw.shading == Shading::vertex_color) return json;
  json["texture"] = d.draw.texture;
  json["sampler"] = to_json(d.draw.sampler);
  if (d.draw.shading == Shading::texture) return json;
  json["indexing_map"] = d.draw.indexing_map;
  json["map_sampler"] = to_json(d.draw.map_sampler);
  return json;
}

}  // namespace

DrawsHeader parse_draws_header(std::span<const std::byte> bytes, const std::string& file) {
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const nlohmann::json json = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
  if (json.is_discarded()) fail_file(file, "header: expected JSON, got something else");
  const JsonRef root(json, "header", file);
  const std::string schema = root.at("schema").text();
  if (schema != "etalon/draws/1") root.at("schema").fail("expected 'etalon/draws/1', got '" + printable(schema) + "'");
  root.require_only({"schema", "frame", "state", "targets", "images", "draws"});
  DrawsHeader header{.frame = frame(root), .images = {}, .draws = {}};
  for (std::size_t n = 0; root.has("images") && n < root.at("images").size(); ++n) header.images.push_back(image(root.at("images").at(n)));
  const JsonRef draws = root.at("draws");
  std::uint64_t triangles = 0, vertices = 0;
  for (std::size_t n = 0; n < draws.size(); ++n) {
    DrawsDraw item = draw(draws.at(n), header.images.size());
    item.draw.first_triangle = static_cast<std::uint32_t>(triangles);
    triangles += item.draw.triangle_count;
    vertices += item.vertex_count;
    if (triangles >= kNoTriangle || vertices >= kNoTriangle)
      draws.fail(fmt::format("expected fewer than 2^32 - 1 vertices and triangles, got {} and {}", vertices, triangles));
    header.draws.push_back(item);
  }
  return header;
}

std::string draws_header_text(const DrawsHeader& header) {
  const Frame& f = header.frame;
  Json json = {{"schema", "etalon/draws/1"},
               {"frame", {{"width", f.width}, {"height", f.height}, {"guard", f.guard}}},
               {"state",
                {{"subtexel_bits", f.state.subtexel_bits},
                 {"snap", name_of(f.state.snap)},
                 {"fill_rule", name_of(f.state.fill_rule)},
                 {"half_rounding", name_of(f.state.half_rounding)},
                 {"cull", name_of(f.state.cull)},
                 {"depth_test", f.state.depth_test}}},
               {"targets", Json::array()},
               {"images", Json::array()},
               {"draws", Json::array()}};
  for (const TargetSpec& t : f.targets)
    json["targets"].push_back({{"content", name_of(t.content)}, {"format", name_of(t.format)}, {"clear", t.clear}});
  for (const DrawsImage& i : header.images) {
    json["images"].push_back({{"path", i.path},
                              {"sha256", i.sha256},
                              {"color_space", i.srgb ? "srgb" : "linear"},
                              {"first_row", i.top_first ? "top" : "bottom"}});
  }
  for (const DrawsDraw& d : header.draws) json["draws"].push_back(to_json(d));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace etalon::io
