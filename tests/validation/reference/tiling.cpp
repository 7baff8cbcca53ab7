#include "tests/validation/reference/tiling.h"

#include <algorithm>

#include "tests/validation/reference/random_values.h"

namespace etalon::validation::reference {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Sub-texels of the rectangle that the tiling fills: the frame and its guard.
struct Canvas {
  std::int64_t lo, hi;
  std::int64_t texel;
};

std::uint32_t add_vertex(DrawList& list, std::int64_t x, std::int64_t y) {
  RasterVertex v;
  v.x = static_cast<std::int32_t>(x), v.y = static_cast<std::int32_t>(y);
  list.vertices.push_back(v);
  return static_cast<std::uint32_t>(list.vertices.size() - 1);
}

std::vector<std::int64_t> sorted_positions(Rng& rng, const Canvas& canvas, std::uint64_t count) {
  std::vector<std::int64_t> positions{canvas.lo, canvas.hi};
  while (positions.size() < count) positions.push_back(rng.between(canvas.lo, canvas.hi));
  std::sort(positions.begin(), positions.end());
  return positions;
}

// The outline is convex and the centre inside, so every triangle (centre, p_n, p_n+1) is counter-clockwise or without area.
void add_fan(Rng& rng, const Canvas& canvas, DrawList& list) {
  const std::int64_t size = canvas.hi - canvas.lo;
  Canvas middle{canvas.lo + size / 4, canvas.hi - size / 4, canvas.texel};
  std::int64_t x = rng.between(middle.lo, middle.hi), y = rng.between(middle.lo, middle.hi);
  if (rng.coin()) x = x / canvas.texel * canvas.texel + canvas.texel / 2, y = y / canvas.texel * canvas.texel + canvas.texel / 2;
  const std::uint32_t centre = add_vertex(list, x, y);
  std::vector<std::uint32_t> outline;
  const std::uint64_t points = 2 + rng.below(60);
  for (int side = 0; side < 4; ++side) {
    const std::vector<std::int64_t> along = sorted_positions(rng, canvas, points);
    for (std::size_t n = 0; n + 1 < along.size(); ++n) {
      const std::int64_t forward = along[n], backward = canvas.lo + canvas.hi - along[n];
      outline.push_back(side == 0   ? add_vertex(list, forward, canvas.lo)
                        : side == 1 ? add_vertex(list, canvas.hi, forward)
                        : side == 2 ? add_vertex(list, backward, canvas.hi)
                                    : add_vertex(list, canvas.lo, backward));
    }
  }
  for (std::size_t n = 0; n < outline.size(); ++n) list.triangles.push_back({centre, outline[n], outline[(n + 1) % outline.size()]});
}

// Two lines, left to right along both, taking the next point of either line at random.
void add_strip(Rng& rng, const Canvas& canvas, DrawList& list) {
  const std::uint64_t points = 2 + rng.below(rng.coin() ? 30 : 2000);
  const std::vector<std::int64_t> low = sorted_positions(rng, canvas, points), high = sorted_positions(rng, canvas, points);
  const bool upright = rng.coin();
  const auto vertex = [&](std::int64_t along, bool at_high) {
    const std::int64_t across = at_high ? canvas.hi : canvas.lo;
    return upright ? add_vertex(list, across, canvas.lo + canvas.hi - along) : add_vertex(list, along, across);
  };
  std::size_t a = 0, b = 0;
  std::uint32_t va = vertex(low[0], false), vb = vertex(high[0], true);
  while (a + 1 < low.size() || b + 1 < high.size()) {
    const bool advance_low = b + 1 == high.size() || (a + 1 < low.size() && rng.coin());
    const std::uint32_t next = advance_low ? vertex(low[++a], false) : vertex(high[++b], true);
    list.triangles.push_back({va, next, vb});
    (advance_low ? va : vb) = next;
  }
}

// Corners move by less than a quarter of a cell: with c = cell side the area is at least (c/2)² − (c/2)² = 0.
void add_grid(Rng& rng, const Canvas& canvas, DrawList& list) {
  const std::int64_t size = canvas.hi - canvas.lo;
  const std::int64_t cell = std::max<std::int64_t>(canvas.texel * (1 + static_cast<std::int64_t>(rng.below(24))) / 2, size / 200);
  const bool on_centres = one_in(rng, 3);
  const std::int64_t origin = canvas.lo + (on_centres ? canvas.texel / 2 : 0);
  const std::int64_t step = on_centres ? std::max<std::int64_t>(cell / canvas.texel, 1) * canvas.texel : std::max<std::int64_t>(cell, 4);
  const std::int64_t jitter = on_centres ? 0 : (step - 1) / 4;
  // The outermost corners may move inwards too: the canvas reaches far enough beyond the frame.
  const auto cells = static_cast<std::uint32_t>((canvas.hi - jitter - origin) / step);
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      add_vertex(list, std::max(canvas.lo, origin + i * step + rng.between(-jitter, jitter)),
                 std::max(canvas.lo, origin + j * step + rng.between(-jitter, jitter)));
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t v00 = j * (cells + 1) + i, v10 = v00 + 1, v01 = v00 + cells + 1, v11 = v01 + 1;
      if (rng.coin()) {
        list.triangles.push_back({v00, v10, v11});
        list.triangles.push_back({v00, v11, v01});
      } else {
        list.triangles.push_back({v00, v10, v01});
        list.triangles.push_back({v10, v11, v01});
      }
    }
}

std::int64_t doubled_area(const DrawList& list, const Triangle& t) {
  const RasterVertex &a = list.vertices[t[0]], &b = list.vertices[t[1]], &c = list.vertices[t[2]];
  return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) - (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

void add_subdivision(Rng& rng, const Canvas& canvas, DrawList& list) {
  const std::uint32_t v0 = add_vertex(list, canvas.lo, canvas.lo), v1 = add_vertex(list, canvas.hi, canvas.lo);
  const std::uint32_t v2 = add_vertex(list, canvas.hi, canvas.hi), v3 = add_vertex(list, canvas.lo, canvas.hi);
  list.triangles = {{v0, v1, v2}, {v0, v2, v3}};
  const std::uint64_t points = 20 + rng.below(2000);
  const bool on_centres = one_in(rng, 3);
  for (std::uint64_t n = 0; n < points; ++n) {
    const std::size_t t = rng.below(list.triangles.size());
    const Triangle old = list.triangles[t];
    const double r = rng.unit(), s = rng.unit() * (1 - r);
    const auto inside = [r, s](std::int64_t a, std::int64_t b, std::int64_t c) {
      return a + static_cast<std::int64_t>(r * static_cast<double>(b - a) + s * static_cast<double>(c - a));
    };
    const RasterVertex &a = list.vertices[old[0]], &b = list.vertices[old[1]], &c = list.vertices[old[2]];
    std::int64_t x = inside(a.x, b.x, c.x), y = inside(a.y, b.y, c.y);
    if (on_centres)
      x = (x >> 1 << 1) / canvas.texel * canvas.texel + canvas.texel / 2, y = y / canvas.texel * canvas.texel + canvas.texel / 2;
    if (x < canvas.lo || x > canvas.hi || y < canvas.lo || y > canvas.hi) continue;
    const std::uint32_t p = add_vertex(list, x, y);
    const Triangle parts[3] = {{old[0], old[1], p}, {old[1], old[2], p}, {old[2], old[0], p}};
    if (std::any_of(std::begin(parts), std::end(parts), [&](const Triangle& part) { return doubled_area(list, part) < 0; })) continue;
    list.triangles[t] = parts[0];
    list.triangles.push_back(parts[1]);
    list.triangles.push_back(parts[2]);
  }
}

}  // namespace

Scene random_tiling(std::uint64_t seed, TilingKind kind, int size) {
  Rng rng(seed * 4 + static_cast<std::uint64_t>(kind));
  Scene scene;
  Frame& frame = scene.frame;
  frame.width = frame.height = size;
  frame.guard = std::min(std::max(64, size), (16384 - size) / 2);
  frame.state = random_state(rng);
  frame.state.cull = CullMode::none;
  frame.state.depth_test = false;
  frame.targets = {{TargetContent::triangle_id, kR32ui, {}}};
  const std::int64_t texel = std::int64_t{1} << frame.state.subtexel_bits;
  // A grid loses up to 1½ cells at its border, and a cell is at most 12 texels or 1/200 of the canvas.
  const Canvas canvas{-frame.guard * texel, (size + frame.guard) * texel, texel};
  switch (kind) {
    case TilingKind::fan: add_fan(rng, canvas, scene.list); break;
    case TilingKind::strip: add_strip(rng, canvas, scene.list); break;
    case TilingKind::grid: add_grid(rng, canvas, scene.list); break;
    case TilingKind::subdivision: add_subdivision(rng, canvas, scene.list); break;
  }
  for (Triangle& triangle : scene.list.triangles)
    if (rng.coin()) std::swap(triangle[1], triangle[2]);
  Draw draw;
  draw.triangle_count = static_cast<std::uint32_t>(scene.list.triangles.size());
  scene.list.draws.push_back(draw);
  return scene;
}

const char* to_string(TilingKind kind) {
  switch (kind) {
    case TilingKind::fan: return "fan";
    case TilingKind::strip: return "strip";
    case TilingKind::grid: return "grid";
    case TilingKind::subdivision: return "subdivision";
  }
  return "";
}

}  // namespace etalon::validation::reference
