#include "cli/info_findings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "cli/draws_input.h"
#include "core/math/half.h"
#include "validation/report/json_report.h"
#include "validation/verify/draw_list_hash.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

const char* name_of(Shading shading) {
  switch (shading) {
    case Shading::vertex_color: return "vertex_color";
    case Shading::texture: return "texture";
    case Shading::indexed: return "indexed";
  }
  return "?";
}

const char* name_of(CullMode cull) {
  switch (cull) {
    case CullMode::none: return "none";
    case CullMode::clockwise: return "clockwise";
    case CullMode::counter_clockwise: return "counter_clockwise";
  }
  return "?";
}

Json sampler_json(const Sampler& sampler) {
  return {{"filter", to_string(sampler.filter)}, {"wrap_u", to_string(sampler.wrap_u)}, {"wrap_v", to_string(sampler.wrap_v)}};
}

std::string sampler_text(const Sampler& sampler) {
  return fmt::format("{} {} {}", to_string(sampler.filter), to_string(sampler.wrap_u), to_string(sampler.wrap_v));
}

double number_at(const Image& image, std::size_t n) {
  switch (image.format().type) {
    case ChannelType::unorm16: return image.channels<std::uint16_t>(0, 0)[n];
    case ChannelType::half: return half_to_double(image.channels<std::uint16_t>(0, 0)[n]);
    case ChannelType::float32: return static_cast<double>(image.channels<float>(0, 0)[n]);
    default: return 0;
  }
}

}  // namespace

Finding examine_draws(const std::string& path, CallFiles& files) {
  std::vector<validation::VerifyInput> inputs;
  const io::DrawsFile file = load_draws(path, files, inputs);
  const RasterState& state = file.frame.state;
  Finding finding;
  finding.lines.push_back(fmt::format("draws: {} triangles of {} vertices in {} draws, frame {}x{} with guard {}",
                                      grouped(file.list.triangles.size()), grouped(file.list.vertices.size()), file.list.draws.size(),
                                      file.frame.width, file.frame.height, file.frame.guard));
  finding.lines.push_back(fmt::format("state: {} sub-texel bits, snap {}, fill rule {}, half {}, cull {}, depth test {}",
                                      state.subtexel_bits, to_string(state.snap), to_string(state.fill_rule),
                                      to_string(state.half_rounding), name_of(state.cull), state.depth_test ? "on" : "off"));
  Json targets = Json::array(), draws = Json::array(), images = Json::array();
  for (const TargetSpec& target : file.frame.targets) {
    finding.lines.push_back(fmt::format("target {} {}", to_string(target.content), to_string(target.format)));
    targets.push_back({{"content", to_string(target.content)}, {"format", to_string(target.format)}});
  }
  for (const Draw& draw : file.list.draws) {
    Json entry = {{"triangles", draw.triangle_count}, {"shading", name_of(draw.shading)}};
    std::string line = fmt::format("draw {}: {} triangles, {}", draws.size(), grouped(draw.triangle_count), name_of(draw.shading));
    if (draw.shading != Shading::vertex_color) {
      entry["texture"] = draw.texture;
      entry["sampler"] = sampler_json(draw.sampler);
      line += fmt::format(" image {} ({})", draw.texture, sampler_text(draw.sampler));
    }
    if (draw.shading == Shading::indexed) {
      entry["indexing_map"] = draw.indexing_map;
      entry["map_sampler"] = sampler_json(draw.map_sampler);
      line += fmt::format(" through map {} ({})", draw.indexing_map, sampler_text(draw.map_sampler));
    }
    finding.lines.push_back(line);
    draws.push_back(std::move(entry));
  }
  for (std::size_t n = 0; n < file.list.images.size(); ++n) {
    const Image& image = *file.list.images[n];
    const std::string name = file.image_paths[n].filename().string();
    finding.lines.push_back(fmt::format("image {}: {} {}x{} {}", n, name, image.width(), image.height(), to_string(image.format())));
    images.push_back({{"name", name},
                      {"width", image.width()},
                      {"height", image.height()},
                      {"format", to_string(image.format())},
                      {"sha256", image.sha256()}});
  }
  const std::string sha256 = validation::draw_list_sha256(file.list);
  finding.lines.push_back("draw list sha256 " + sha256);
  finding.members["kind"] = "draws";
  finding.members["draws"] = {{"width", file.frame.width},
                              {"height", file.frame.height},
                              {"guard", file.frame.guard},
                              {"vertices", file.list.vertices.size()},
                              {"triangles", file.list.triangles.size()},
                              {"state",
                               {{"subtexel_bits", state.subtexel_bits},
                                {"snap", to_string(state.snap)},
                                {"fill_rule", to_string(state.fill_rule)},
                                {"half_rounding", to_string(state.half_rounding)},
                                {"cull", name_of(state.cull)},
                                {"depth_test", state.depth_test}}},
                              {"targets", std::move(targets)},
                              {"draws", std::move(draws)},
                              {"images", std::move(images)},
                              {"draw_list_sha256", sha256}};
  return finding;
}

void add_depths(Finding& finding, const Image& image) {
  const ChannelType type = image.format().type;
  const bool integers = type == ChannelType::unorm16;
  if (image.format().channels != 1 || (!integers && type != ChannelType::half && type != ChannelType::float32)) return;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  std::size_t samples = 0;
  for (std::size_t n = 0; n < image.texel_count(); ++n) {
    const double value = number_at(image, n);
    if (integers ? value == 0 : !std::isfinite(value)) continue;
    ++samples;
    lowest = std::min(lowest, value), highest = std::max(highest, value);
  }
  const std::size_t none = image.texel_count() - samples;
  const std::string range = samples == 0 ? "none" : fmt::format("{:g} to {:g}", lowest, highest);
  finding.lines.push_back(
      fmt::format("one channel: depths of a range image (etalon bake --spacing) or heights of a terrain (etalon joint): {}; {} of {} "
                  "places without a sample",
                  range, grouped(none), grouped(image.texel_count())));
  finding.members["depths"] = {{"samples", samples},
                               {"none", none},
                               {"lowest", samples == 0 ? Json(nullptr) : Json(lowest)},
                               {"highest", samples == 0 ? Json(nullptr) : Json(highest)}};
}

}  // namespace etalon::cli
