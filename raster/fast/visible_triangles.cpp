#include "raster/fast/visible_triangles.h"

#include <algorithm>

namespace etalon::raster::fast {

void VisibleTriangles::find(const DrawList& list, const Tile& tile, const TileSamples& samples, std::span<const std::uint32_t> ids,
                            const Kernels& kernels) {
  const auto texels = static_cast<std::size_t>(tile.height) * kTileSize;
  std::vector<std::uint32_t> number_of(ids.size() + 1, 0);  // by slot; first only whether it is seen
  kernels.mark(samples.slot, texels, number_of.data());
  number_of[kNoSlot] = 0;
  id.assign(1, kNoTriangle), draw.assign(1, nullptr);
  const Draw* current = nullptr;
  for (std::size_t slot = 1; slot <= ids.size(); ++slot) {
    if (number_of[slot] == 0) continue;
    const std::uint32_t t = ids[slot - 1];
    if (current == nullptr || t - current->first_triangle >= current->triangle_count) current = &list.draw_of(t);
    number_of[slot] = static_cast<std::uint32_t>(id.size());
    id.push_back(t), draw.push_back(current);
  }
  kernels.renumber(samples.slot, texels, number_of.data(), number);
  std::fill_n(number + texels, kTileSlack, 0u);
}

void VisibleTriangles::make_planes(const DrawList& list, const Frame& frame, const Tile& tile, const PlaneLayout& layout,
                                   const Kernels& kernels) {
  if (layout.stride() == kFirstPlane) return;
  const auto stride = static_cast<std::size_t>(layout.stride());
  const std::size_t count = id.size();
  planes = std::make_unique_for_overwrite<double[]>((1 + (count - 1 + kBatch - 1) / kBatch * kBatch) * stride);
  std::fill_n(planes.get(), stride, 0.0);
  planes[kQ] = 1, planes[kErrorU] = planes[kErrorV] = kExactPlane;  // no lane is left undecided on its account
  if (frame.state.subtexel_bits > kMostEdgeBits) {
    for (std::size_t n = 1; n < count; ++n) perspective |= fast::make_planes(list, id[n], frame, tile, layout, planes.get() + n * stride);
    return;
  }
  const bool uv = layout.has(kPlaneU), color = layout.has(kPlaneRed);
  const TileFrame tile_frame = tile_frame_of(frame, tile);
  PlaneBatch batch{};
  for (std::size_t n = 1; n < count; n += kBatch) {
    for (std::size_t t = 0; t < std::min<std::size_t>(kBatch, count - n); ++t) {
      const auto& corner = list.triangles[id[n + t]];
      for (std::size_t k = 0; k < 3; ++k) {
        const RasterVertex& v = list.vertices[corner[k]];
        batch.x[k][t] = v.x, batch.y[k][t] = v.y, batch.w[k][t] = v.w;
        if (uv) batch.attribute[kPlaneU][k][t] = v.uv.x, batch.attribute[kPlaneV][k][t] = v.uv.y;
        if (!color) continue;
        for (int c = 0; c < 4; ++c) batch.attribute[kPlaneRed + c][k][t] = v.color[c];
      }
    }
    perspective |= kernels.make_planes(batch, tile_frame, layout, planes.get() + n * stride);
  }
}

}  // namespace etalon::raster::fast
