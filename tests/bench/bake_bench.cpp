#include "tests/bench/bake_bench.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/bake/bake.h"
#include "core/base/parallel.h"
#include "core/io/mesh_file.h"
#include "raster/cpu_renderer.h"
#include "tests/bench/child.h"
#include "tests/bench/simplify_way.h"
#include "tests/bench/timing.h"
#include "tests/support/skip.h"

namespace etalon::bench {
namespace {

constexpr int kViews = 24;
/// Binary PLY: 15 bytes a coloured vertex, 13 a face, and two faces a vertex.
constexpr double kBytesPerFace = 15.0 / 2 + 13;

std::optional<Mesh> real_scan(const std::string& path) {
  const auto file = test::data_file(path);
  if (!file) return std::nullopt;
  return io::read_mesh(*file).mesh;
}

bake::BakeResult baked(const Mesh& scan, int map) {
  return bake::bake_scan(scan, {.target_faces = kBakedFaces, .width = map, .height = map});
}

std::uint64_t written_bytes(const std::filesystem::path& path, const Mesh& mesh, const std::shared_ptr<const Image>& texture) {
  std::vector<io::Material> materials;
  if (texture) materials.push_back({.name = "baked", .texture_path = {}, .texture = *texture, .lookup = io::TextureLookup::nearest});
  io::write_mesh(path, mesh, materials);
  std::uint64_t bytes = 0;
  for (const auto& file : io::mesh_output_files(path, materials)) bytes += std::filesystem::file_size(file);
  return bytes;
}

}  // namespace

std::vector<BakeScan> bake_scans() {
  return {{"head", "Lee Perry-Smith's head, 282,944 faces", real_scan("lee_perry_smith/lee_perry_smith_283k.ply")},
          {"carton", "the milk carton, 475,306 faces", real_scan("milk_carton/milk_carton_grid.ply")}};
}

double BakeTime::own_seconds() const {
  std::vector<double> own;
  for (std::size_t i = 0; i < bake.size(); ++i) own.push_back(std::max(0.0, bake[i] - simplify[i]));
  return median(own);
}

BakeTime measure_bake_time(const std::string& title, const Mesh& scan, int map, int rounds) {
  BakeTime time{.title = title, .faces_in = scan.face_count(), .vertices_in = scan.vertex_count(), .map = map};
  const int threads = thread_count();
  set_thread_count(1);
  for (int round = 0; round < rounds; ++round) {
    double start = process_cpu_seconds();
    (void)simplify::simplify_mesh(scan, {.target_faces = kBakedFaces});
    time.simplify.push_back(process_cpu_seconds() - start);
    start = process_cpu_seconds();
    (void)baked(scan, map);
    time.bake.push_back(process_cpu_seconds() - start);
  }
  set_thread_count(threads);
  return time;
}

DenseViews::DenseViews(const Mesh& scan) : box_(bounding_box(scan)) {
  raster::CpuRenderer renderer;
  for (int n = 0; n < kViews; ++n)
    views_.push_back(
        validation::draw_view(renderer, scan, {.camera = view_of_24(box_, n), .width = kBakeViews_px, .height = kBakeViews_px}));
}

ViewQuality DenseViews::compare(const std::string& title, const Mesh& mesh, const std::shared_ptr<const Image>& texture,
                                Filter filter) const {
  raster::CpuRenderer renderer;
  validation::PictureSums sums;
  for (int n = 0; n < kViews; ++n) {
    const Camera camera = view_of_24(box_, n);
    const auto view = texture ? validation::draw_textured(renderer, {.mesh = &mesh, .texture = texture, .map = {}, .filter = filter},
                                                          camera, kBakeViews_px, kBakeViews_px)
                              : validation::draw_view(renderer, mesh, {.camera = camera, .width = kBakeViews_px, .height = kBakeViews_px});
    sums.add(views_[static_cast<std::size_t>(n)], view);
  }
  return {.title = title,
          .faces = mesh.face_count(),
          .frame_db = sums.whole_db().value_or(0),
          .both_db = sums.masked_db().value_or(0),
          .outline_share = sums.sse == 0 ? 0 : static_cast<double>(sums.sse - sums.common_sse) / static_cast<double>(sums.sse)};
}

BakeQuality measure_bake_quality(const BakeScan& scan) {
  BakeQuality quality{.title = scan.title};
  const ScratchDirectory scratch;
  const DenseViews dense(*scan.mesh);
  for (const int map : {512, 1024}) {
    const bake::BakeResult result = baked(*scan.mesh, map);
    const auto texture = std::make_shared<const Image>(result.texture);
    if (quality.rows.empty()) {
      quality.rows.push_back(dense.compare("vertex colours, the same triangles", result.simplified.mesh, nullptr));
      quality.rows.back().bytes = written_bytes(scratch / "plain.ply", result.simplified.mesh, nullptr);
    }
    quality.rows.push_back(dense.compare(fmt::format("baked, {}²", map), result.mesh, texture));
    quality.rows.back().bytes = written_bytes(scratch / "baked.ply", result.mesh, texture);
    const auto share = [&](std::uint64_t texels) { return static_cast<double>(texels) / static_cast<double>(result.texels.inside); };
    quality.shares.push_back({map, share(result.texels.hit), share(result.texels.averaged), share(result.texels.filled)});
  }
  const std::size_t rows = quality.rows.size();
  for (std::size_t r = 1; r < rows; ++r) {
    const auto faces = static_cast<std::size_t>(static_cast<double>(quality.rows[r].bytes) / kBytesPerFace);
    const Mesh mesh = simplify::simplify_mesh(*scan.mesh, {.target_faces = faces}).mesh;
    quality.rows.push_back(dense.compare(fmt::format("vertex colours in the bytes of “{}”", quality.rows[r].title), mesh, nullptr));
    quality.rows.back().bytes = written_bytes(scratch / "equal.ply", mesh, nullptr);
  }
  const Mesh best = simplify::simplify_mesh(*scan.mesh, {.metric = simplify::MetricName::hoppe,
                                                         .collapse = simplify::CollapseKind::full,
                                                         .target_faces = kBakedFaces,
                                                         .attribute_weight = 0.05})
                        .mesh;
  quality.rows.push_back(dense.compare("vertex colours, `hoppe` full-edge, weight 0.05", best, nullptr));
  return quality;
}

}  // namespace etalon::bench
