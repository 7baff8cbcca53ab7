#include "tests/bake/fill_fixture.h"

#include <algorithm>
#include <utility>

#include "core/base/rng.h"

namespace etalon::test {

using namespace bake;

namespace {

Atlas atlas_of(const Mesh& mesh, const std::vector<double>& ratios, std::uint64_t seed) {
  Atlas atlas = make_atlas(ratios, 256, 4096);
  Rng rng(seed);
  if (seed != 0)
    for (Tile& tile : atlas.tiles) tile.right_corner = static_cast<int>(rng.below(3));
  (void)mesh;
  return atlas;
}

struct Texel {
  std::uint32_t face;
  int i, j;
};

std::vector<Texel> texels_of(const Atlas& atlas) {
  std::vector<Texel> texels;
  for (std::uint32_t f = 0; f < atlas.tiles.size(); ++f)
    for_each_texel(atlas.tiles[f].size, [&](int i, int j) { texels.push_back({f, i, j}); });
  return texels;
}

TexelColors colors_of(const FillCase& c, const std::vector<std::uint32_t>& hits) {
  TexelColors colors{.color = std::vector<Rgb8>(c.nodes.texel_count()), .hits = std::vector<std::uint32_t>(c.nodes.texel_count())};
  const std::vector<std::uint32_t> node = judge_nodes(c);
  std::vector<bool> hit(node.size());
  for (const std::uint32_t t : hits) hit[node[t]] = true;
  for (std::size_t t = 0; t < node.size(); ++t) {
    colors.hits[t] = hit[node[t]];
    colors.color[t] = {static_cast<std::uint8_t>(node[t] % 251), static_cast<std::uint8_t>(node[t] / 251), 0};
  }
  return colors;
}

std::uint64_t root_rounded_up(unsigned __int128 n) {
  std::uint64_t low = 0, high = std::uint64_t{1} << 32;
  while (low < high) {
    const std::uint64_t middle = (low + high) / 2;
    if (static_cast<unsigned __int128>(middle) * middle >= n)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

std::uint64_t distance(const GridPoint& a, const GridPoint& b) {
  const auto square = [](std::int64_t d) { return static_cast<unsigned __int128>(d * d); };
  return root_rounded_up(square(std::int64_t{a.x} - b.x) + square(std::int64_t{a.y} - b.y) + square(std::int64_t{a.z} - b.z));
}

}  // namespace

FillCase::FillCase(Mesh surface, const std::vector<double>& ratios, const std::vector<std::uint32_t>& hits)
    : mesh(std::move(surface)), atlas(atlas_of(mesh, ratios, 0)), nodes(mesh, atlas), metric(mesh, atlas) {
  colors = colors_of(*this, hits);
}

FillCase::FillCase(Mesh surface, const std::vector<double>& ratios, std::uint64_t seed, std::uint64_t rarity, bool corners)
    : mesh(std::move(surface)), atlas(atlas_of(mesh, ratios, seed)), nodes(mesh, atlas), metric(mesh, atlas) {
  Rng rng(seed);
  std::vector<std::uint32_t> hits;
  const std::vector<Texel> texels = texels_of(atlas);
  for (std::uint32_t t = 0; t < texels.size(); ++t) {
    const auto [f, i, j] = texels[t];
    const int last = atlas.tiles[f].size - 1;
    const bool corner = (i == 0 || i == last) && (j == 0 || j == last);
    if ((corners && corner) || rng.below(rarity) == 0) hits.push_back(t);
  }
  if (hits.empty()) hits.push_back(0);
  colors = colors_of(*this, hits);
}

Mesh mesh_of(const std::vector<Vec3f>& positions, const std::vector<std::array<std::uint32_t, 3>>& faces) {
  Mesh mesh;
  mesh.positions = positions;
  for (std::uint32_t v = 0; v < positions.size(); ++v) mesh.wedges.push_back({.vertex = VertexId(v)});
  for (const auto& face : faces) mesh.faces.push_back({WedgeId(face[0]), WedgeId(face[1]), WedgeId(face[2])});
  return mesh;
}

Mesh relief(int n, std::uint64_t seed, bool flat) {
  Rng rng(seed);
  std::vector<Vec3f> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const float height = rng.uniform(0, 1);
      positions.emplace_back(static_cast<float>(x), static_cast<float>(y), flat ? 0.0f : height);
    }
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (std::uint32_t y = 0; y + 1 < row; ++y)
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x;
      faces.push_back({a, a + 1, a + row + 1});
      faces.push_back({a, a + row + 1, a + row});
    }
  return mesh_of(positions, faces);
}

Mesh fins() {
  return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3f, -1, -0.2f}, {2, 0, 0}, {2, 1, 0}, {3, 0, 0}},
                 {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 5, 6}, {1, 7, 5}});
}

std::vector<std::uint32_t> judge_nodes(const FillCase& c) {
  // What a texel covers: vertices, and pieces [k, k + 1] / d of edges from the lower vertex.
  struct Piece {
    std::uint32_t low, high;  // vertices; equal: the vertex itself
    double from, to;
    std::uint32_t texel;
  };
  std::vector<Piece> pieces;
  const std::vector<Texel> texels = texels_of(c.atlas);
  for (std::uint32_t t = 0; t < texels.size(); ++t) {
    const auto [f, i, j] = texels[t];
    const Tile& tile = c.atlas.tiles[f];
    const double d = tile.size;
    const std::uint32_t v[3] = {c.mesh.vertex(FaceId(f), tile.right_corner).index,
                                c.mesh.vertex(FaceId(f), (tile.right_corner + 1) % 3).index,
                                c.mesh.vertex(FaceId(f), (tile.right_corner + 2) % 3).index};
    const int last = tile.size - 1;
    if (i == 0 && j == 0) pieces.push_back({v[0], v[0], 0, 1, t});
    if (i == last) pieces.push_back({v[1], v[1], 0, 1, t});
    if (j == last) pieces.push_back({v[2], v[2], 0, 1, t});
    const auto side = [&](std::uint32_t from, std::uint32_t to, int k) {
      if (from < to) pieces.push_back({from, to, k / d, (k + 1) / d, t});
      if (from > to) pieces.push_back({to, from, 1 - (k + 1) / d, 1 - k / d, t});
    };
    if (j == 0) side(v[0], v[1], i);
    if (i == 0) side(v[0], v[2], j);
    if (i + j == last) side(v[1], v[2], j);
  }
  std::vector<std::uint32_t> node(texels.size());
  for (std::uint32_t t = 0; t < node.size(); ++t) node[t] = t;
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < pieces.size(); ++a)
      for (std::size_t b = a + 1; b < pieces.size() && pieces[b].low == pieces[a].low && pieces[b].high == pieces[a].high; ++b) {
        if (!(std::max(pieces[a].from, pieces[b].from) < std::min(pieces[a].to, pieces[b].to))) continue;
        std::uint32_t& p = node[pieces[a].texel];
        std::uint32_t& q = node[pieces[b].texel];
        if (p == q) continue;
        p = q = std::min(p, q);
        changed = true;
      }
  }
  return node;
}

SurfaceFill judge_fill(const FillCase& c) {
  const std::vector<Texel> texels = texels_of(c.atlas);
  const std::vector<std::uint32_t> node = judge_nodes(c);
  std::vector<GridPoint> centers;
  for (const auto& [f, i, j] : texels) centers.push_back(c.metric.plane(f).center(i, j));
  using Key = std::pair<std::uint64_t, std::uint32_t>;
  std::vector<Key> best(texels.size(), {kNoDistance, kNoGroup});  // by node
  for (std::uint32_t t = 0; t < texels.size(); ++t)
    if (c.colors.hits[t] > 0) best[node[t]] = {0, node[t]};
  std::vector<bool> done(texels.size());
  while (true) {
    std::uint32_t next = kNoGroup;
    for (std::uint32_t n = 0; n < best.size(); ++n)
      if (node[n] == n && !done[n] && best[n].first != kNoDistance && (next == kNoGroup || best[n] < best[next])) next = n;
    if (next == kNoGroup) break;
    done[next] = true;
    for (std::uint32_t t = 0; t < texels.size(); ++t)
      for (std::uint32_t u = 0; node[t] == next && u < texels.size(); ++u)
        if (texels[u].face == texels[t].face)
          best[node[u]] = std::min(best[node[u]], Key{best[next].first + distance(centers[t], centers[u]), best[next].second});
  }
  SurfaceFill fill;
  for (std::uint32_t t = 0; t < texels.size(); ++t) {
    fill.distance.push_back(best[node[t]].first);
    fill.source.push_back(best[node[t]].second);
  }
  return fill;
}

}  // namespace etalon::test
