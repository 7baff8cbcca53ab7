#include "validation/studies/soucy_study.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "validation/studies/soucy_scans.h"

namespace etalon::validation {
namespace {

void require_scan(const SoucyScan& scan) {
  double before = 0;
  for (const double tolerance : scan.tolerances) {
    if (!(tolerance > before))
      throw InputError(fmt::format("{}: expected tolerances above 0, each larger than the one before, got {}", scan.name, tolerance));
    before = tolerance;
  }
  if (scan.tolerances.empty()) throw InputError(scan.name + ": expected a tolerance, got none");
}

/// InputErrors with the subject's name in front.
template <class Work>
auto naming(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

}  // namespace

const SoucyMapping& SoucyScanResult::of(std::size_t level, SoucyPattern pattern, int map_size) const {
  for (const SoucyMapping& mapping : mappings)
    if (mapping.level == level && mapping.pattern == pattern && mapping.map_size == map_size) return mapping;
  throw InputError(fmt::format("{}: no mapping of level {}, {}, {}", name, level, to_string(pattern), map_size));
}

std::uint64_t SoucyStudyResult::unexplained() const {
  std::uint64_t sum = 0;
  for (const CheckedDrawing::Group& group : drawings) sum += group.counts[TexelClass::unexplained];
  return sum;
}

std::uint64_t wrong_mean_count(const Mesh& scan, const bake::BakeResult& baked) {
  const Mesh& mesh = baked.simplified.mesh;
  const std::vector<Landing>& landings = baked.simplified.landings;
  ETALON_CHECK(landings.size() == scan.vertex_count(), "the scan that was baked, welded");
  const bake::TexelNodes nodes(mesh, baked.atlas);
  std::vector<std::array<std::uint64_t, 4>> sums(nodes.texel_count());  // by node: channels, hits
  for (std::size_t v = 0; v < landings.size(); ++v) {
    if (!landings[v].face.valid()) continue;
    const std::uint32_t f = landings[v].face.index;
    const auto [i, j] = baked.atlas.tiles[f].nearest_texel(landings[v].weights);
    auto& sum = sums[nodes.node_of(nodes.texel(f, baked.atlas.tiles[f].size, i, j))];
    for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)] += bake::color_byte(scan.colors[v][c]);
    ++sum[3];
  }
  std::uint64_t wrong = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const bake::Tile& tile = baked.atlas.tiles[f];
    bake::for_each_texel(tile.size, [&](int i, int j) {
      const auto& sum = sums[nodes.node_of(nodes.texel(f, tile.size, i, j))];
      if (sum[3] == 0) return;
      const auto [x, y] = tile.place(i, j);
      bool right = true;
      for (std::size_t c = 0; c < 3; ++c)
        right = right && baked.texture.channels<std::uint8_t>(x, y)[c] == (2 * sum[c] + sum[3]) / (2 * sum[3]);
      wrong += !right;
    });
  }
  return wrong;
}

SoucyStudyResult run_soucy_study(const std::vector<SoucyScan>& scans, const std::vector<SoucyModel>& models, Renderer& exact,
                                 const SoucyStudyOptions& options) {
  SoucyStudyResult result;
  result.exact_name = exact.name();
  if (options.device != nullptr) result.device_name = options.device->name();
  result.map_sizes = options.map_sizes, result.views_px = options.views_px, result.view_count = options.view_count;
  int total = 0, done = 0;
  for (const SoucyScan& scan : scans) {
    require_scan(scan);
    total += scan_steps(scan, options);
    result.inputs.insert(result.inputs.end(), scan.inputs.begin(), scan.inputs.end());
  }
  for (const SoucyModel& model : models) {
    if (model.mesh.colors.empty()) throw InputError(model.name + ": expected vertex colours, got none");
    total += model_steps(model, options);
    result.inputs.insert(result.inputs.end(), model.inputs.begin(), model.inputs.end());
  }
  CheckedDrawing drawing(exact, options.device, options.device_model);
  const SoucyTools tools{drawing, options, [&](const std::string& label) {
                           if (options.progress) options.progress(label, done, total);
                           ++done;
                         }};
  for (const SoucyScan& scan : scans) {
    result.scans.push_back(naming(scan.name, [&] { return study_scan(scan, tools); }));
    if (options.on_scan) options.on_scan(result.scans.back());
  }
  for (const SoucyModel& model : models) {
    result.models.push_back(naming(model.name, [&] { return study_model(model, tools); }));
    if (options.on_model) options.on_model(result.models.back());
  }
  result.drawings = drawing.groups();
  return result;
}

}  // namespace etalon::validation
