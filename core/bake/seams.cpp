#include "core/bake/seams.h"

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "core/mesh/adjacency.h"

namespace etalon::bake {
namespace {

// The least and the largest value of each channel seen at one place.
struct Range {
  std::array<int, 3> low{255, 255, 255}, high{0, 0, 0};
  void add(const Image& image, const TexelPlace& place) {
    const std::uint8_t* const c = image.channels<std::uint8_t>(place.x, place.y);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], int{c[k]});
      high[k] = std::max(high[k], int{c[k]});
    }
  }
  [[nodiscard]] int width() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 0}); }
};

}  // namespace

int largest_seam_residual(const Mesh& mesh, const Atlas& atlas, const Image& image) {
  ETALON_CHECK(image.format().type == ChannelType::unorm8 && image.format().channels >= 3, to_string(image.format()));
  const Adjacency adjacency(mesh);
  int residual = 0;
  for (std::uint32_t e = 0; e < adjacency.edge_count(); ++e) {
    const auto sides = adjacency.half_edges(EdgeId(e));
    int finest = 2;
    for (const HalfEdgeId h : sides) finest = std::max(finest, atlas.tiles[Adjacency::face(h).index].size);
    for (int step = 0; step < finest; ++step) {
      Range range;
      for (const HalfEdgeId h : sides) {
        const Tile& tile = atlas.tiles[Adjacency::face(h).index];
        // In the middle of the step-th piece, seen from the vertex of lower index.
        const int a = Adjacency::corner(h), b = (a + 1) % 3;
        const bool along = adjacency.start(h) < adjacency.end(h);
        const double t = (step + 0.5) / finest;
        Vec3d weights{0, 0, 0};
        weights[a] = along ? 1 - t : t;
        weights[b] = along ? t : 1 - t;
        const auto [i, j] = tile.nearest_texel(weights);
        range.add(image, tile.place(i, j));
      }
      residual = std::max(residual, range.width());
    }
  }
  std::vector<Range> at_vertex(mesh.vertex_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    for (int c = 0; c < 3; ++c) {
      const auto [i, j] = atlas.tiles[f].corner_texel(c);
      at_vertex[mesh.vertex(FaceId(f), c).index].add(image, atlas.tiles[f].place(i, j));
    }
  for (const Range& range : at_vertex) residual = std::max(residual, range.width());
  return residual;
}

}  // namespace etalon::bake
