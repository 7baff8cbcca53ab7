#include "raster/cpu_map.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/float_environment.h"
#include "core/base/parallel.h"
#include "raster/fast/tile_shader.h"

namespace etalon::raster {
namespace {

// A group's part of one tile.
struct GroupTile {
  Tile tile;
  std::uint32_t first_triangle, end_triangle;
};

class CpuMap : public ResidentMap {
 public:
  CpuMap(Image map, const MapState& state)
      : frame_(map_frame(map.width(), map.height(), map.format(), state)), map_(std::make_shared<Image>(std::move(map))), drawn_{*map_} {
    list_ = map_pass_list({}, map_, state.filter);
    validate(list_, frame_);  // looks at the map once: lookups do not leave the range of its texels
    largest_ = fast::largest_texels(list_);
  }

  void apply(std::span<const MapPass> passes) override {
    const DefaultFloatEnvironment environment;
    for (const MapPass& pass : passes) apply(pass);
  }

  Image read_back() override { return *map_; }
  std::uint64_t texels_written() const override { return written_; }

 private:
  void apply(const MapPass& pass) {
    list_.vertices = pass.vertices, list_.triangles = pass.triangles;
    list_.draws[0].triangle_count = static_cast<std::uint32_t>(pass.triangles.size());
    validate_groups(pass);
    validate_geometry(list_, frame_);
    const std::vector<GroupTile> tiles = tiles_of(pass);
    ids_.resize(std::max(ids_.size(), pass.triangles.size()));
    std::iota(ids_.begin(), ids_.end(), 0u);
    const fast::RunContext context = {list_, frame_, *fast::kernels_for(simd_level()), fast::plane_layout(list_, frame_), largest_, {}};
    std::vector<std::vector<fast::CoveredRun>> covered(tiles.size());
    parallel_for(tiles.size(), [&](std::size_t n) {
      const GroupTile& t = tiles[n];
      const std::span<const std::uint32_t> ids(ids_.data() + t.first_triangle, t.end_triangle - t.first_triangle);
      (void)fast::draw_tile(context, t.tile, ids, drawn_, &covered[n]);
    });
    parallel_for(tiles.size(), [&](std::size_t n) { copy_back(covered[n]); });
    for (const auto& runs : covered)
      for (const fast::CoveredRun& run : runs) written_ += static_cast<std::uint64_t>(run.texels);
  }

  // The bounding box of each group, in tiles.
  std::vector<GroupTile> tiles_of(const MapPass& pass) const {
    std::vector<GroupTile> tiles;
    std::uint32_t first = 0;
    for (const std::uint32_t end : pass.group_ends) {
      const auto box = texel_box(pass, first, end);
      for (int y = box.y0; y < box.y1; y += kTileSize)
        for (int x = box.x0; x < box.x1; x += kTileSize)
          tiles.push_back({{x, y, std::min(kTileSize, box.x1 - x), std::min(kTileSize, box.y1 - y)}, first, end});
      first = end;
    }
    return tiles;
  }

  struct TexelBox {
    int x0, x1, y0, y1;  // half open
  };
  TexelBox texel_box(const MapPass& pass, std::uint32_t first, std::uint32_t end) const {
    const int bits = frame_.state.subtexel_bits;
    TexelBox box{frame_.width, 0, frame_.height, 0};
    for (std::uint32_t t = first; t < end; ++t)
      for (const std::uint32_t corner : pass.triangles[t]) {
        const RasterVertex& v = pass.vertices[corner];
        box.x0 = std::min(box.x0, v.x >> bits), box.x1 = std::max(box.x1, (v.x >> bits) + 1);
        box.y0 = std::min(box.y0, v.y >> bits), box.y1 = std::max(box.y1, (v.y >> bits) + 1);
      }
    return {std::max(box.x0, 0), std::min(box.x1, frame_.width), std::max(box.y0, 0), std::min(box.y1, frame_.height)};
  }

  void copy_back(const std::vector<fast::CoveredRun>& runs) {
    const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(map_->format()));
    for (const fast::CoveredRun& run : runs)
      std::memcpy(map_->texel(run.x, run.y), drawn_[0].texel(run.x, run.y), static_cast<std::size_t>(run.texels) * texel_bytes);
  }

  Frame frame_;
  std::shared_ptr<Image> map_;
  std::vector<Image> drawn_;  // where passes draw; defined only where the last one covered
  DrawList list_;             // of the pass at hand
  std::vector<double> largest_;
  std::vector<std::uint32_t> ids_;
  std::uint64_t written_ = 0;
};

}  // namespace

std::unique_ptr<ResidentMap> make_cpu_map(Image map, const MapState& state) { return std::make_unique<CpuMap>(std::move(map), state); }

}  // namespace etalon::raster
