#include "core/procedural/iso_lattice.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::procedural {

namespace {

constexpr int kBlock = 8;          ///< cubes on a side of a block
constexpr int kSide = kBlock + 1;  ///< corners on a side of a block; and the centres, those of the next block's first cubes included
constexpr int kPoints = kSide * kSide * kSide;

/// A lattice point in half cubes: all three even (a corner) or all three odd (a centre).
struct Point {
  std::int64_t x, y, z;
};

using EdgeKey = std::uint64_t;  // 8·(number of the lower end) + way: below 2^54, since a side has at most 2·50,000 + 32 half cubes

class Marcher {
 public:
  explicit Marcher(const IsoLattice& lattice) : lattice_(lattice) {
    for (int k = 0; k < 3; ++k) {
      const double extent = lattice.hi[k] - lattice.lo[k];
      if (!(extent > 0) || !(lattice.spacing > 0) || extent / lattice.spacing > 50'000)
        throw InputError("implicit mesh: expected a box of at most 50000 lattice cubes a side");
      blocks_[k] = static_cast<std::int64_t>(extent / (lattice.spacing * kBlock)) + 2;
    }
    if (blocks_[0] * blocks_[1] * blocks_[2] > (std::int64_t{1} << 31)) throw InputError("implicit mesh: too many lattice blocks");
    visited_.assign(static_cast<std::size_t>(blocks_[0] * blocks_[1] * blocks_[2]), 0);
  }

  IsoTriangles run() {
    std::vector<std::size_t> wave{seed_block()};
    visited_[wave.front()] = 1;
    std::vector<Found> all;
    while (!wave.empty()) {
      std::vector<Found> found(wave.size());
      parallel_for(wave.size(), [&](std::size_t i) { found[i] = march_block(wave[i]); });
      std::vector<std::size_t> next;
      for (std::size_t i = 0; i < wave.size(); ++i) spread(wave[i], found[i].exits, next);
      for (Found& block : found)
        if (!block.corners.empty()) all.push_back(std::move(block));
      std::sort(next.begin(), next.end());
      wave = std::move(next);
    }
    return joined(all);
  }

 private:
  /// What one block holds: corners of triangles as edge keys, three a triangle, and the faces through which the surface leaves.
  struct Found {
    std::size_t block = 0;
    std::vector<EdgeKey> corners;
    unsigned exits = 0;  // bits −x, +x, −y, +y, −z, +z
  };

  [[nodiscard]] Vec3d place(const Point& p) const {
    const double h = 0.5 * lattice_.spacing;
    return {lattice_.lo.x + h * static_cast<double>(p.x), lattice_.lo.y + h * static_cast<double>(p.y),
            lattice_.lo.z + h * static_cast<double>(p.z)};
  }
  [[nodiscard]] Point origin_of(std::size_t block) const {
    const auto b = static_cast<std::int64_t>(block);
    return {2 * kBlock * (b % blocks_[0]), 2 * kBlock * (b / blocks_[0] % blocks_[1]), 2 * kBlock * (b / (blocks_[0] * blocks_[1]))};
  }

  [[nodiscard]] std::size_t seed_block() const {
    const double step = 0.25 * lattice_.spacing;
    Vec3d p = lattice_.seed;
    while (p.x < lattice_.hi.x && lattice_.field(p) < 0) p.x += step;
    if (!(p.x > lattice_.seed.x) || !(p.x < lattice_.hi.x)) throw InputError("implicit mesh: no surface between the seed and the box");
    std::int64_t at[3];
    for (int k = 0; k < 3; ++k) {
      const auto cube = static_cast<std::int64_t>(std::floor((p[k] - lattice_.lo[k]) / lattice_.spacing));
      at[k] = std::clamp<std::int64_t>(cube / kBlock, 0, blocks_[k] - 1);
    }
    return static_cast<std::size_t>((at[2] * blocks_[1] + at[1]) * blocks_[0] + at[0]);
  }

  void spread(std::size_t block, unsigned exits, std::vector<std::size_t>& next) {
    const auto b = static_cast<std::int64_t>(block);
    const std::int64_t at[3] = {b % blocks_[0], b / blocks_[0] % blocks_[1], b / (blocks_[0] * blocks_[1])};
    const std::int64_t stride[3] = {1, blocks_[0], blocks_[0] * blocks_[1]};
    for (unsigned side = 0; side < 6; ++side) {
      if (!((exits >> side) & 1u)) continue;
      const unsigned axis = side / 2;
      const std::int64_t step = side % 2 == 0 ? -1 : 1;
      if (at[axis] + step < 0 || at[axis] + step >= blocks_[axis]) throw InputError("implicit mesh: the surface leaves its box");
      const auto neighbor = static_cast<std::size_t>(b + step * stride[axis]);
      if (visited_[neighbor]) continue;
      visited_[neighbor] = 1;
      next.push_back(neighbor);
    }
  }

  // An edge joins two points that differ by (2, 0, 0), (0, 2, 0), (0, 0, 2) or (±1, ±1, ±1): its lower end by (z, y, x), and the way.
  [[nodiscard]] EdgeKey key_of(Point a, Point b) const {
    if (std::array{b.z, b.y, b.x} < std::array{a.z, a.y, a.x}) std::swap(a, b);
    const std::int64_t nx = 2 * kBlock * blocks_[0] + 2, ny = 2 * kBlock * blocks_[1] + 2;
    const auto lower = static_cast<std::uint64_t>((a.z * ny + a.y) * nx + a.x);
    const std::int64_t dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
    std::uint64_t way = 0;  // 0 x, 1 y, 2 z; 3..6: z up, signs of y and x
    if (dz == 1)
      way = 3 + (dy > 0 ? 2u : 0u) + (dx > 0 ? 1u : 0u);
    else
      way = dx == 2 ? 0 : (dy == 2 ? 1 : 2);
    return lower * 8 + way;
  }

  [[nodiscard]] Vec3d crossing(EdgeKey key) const {
    const std::int64_t nx = 2 * kBlock * blocks_[0] + 2, ny = 2 * kBlock * blocks_[1] + 2;
    const auto lower = static_cast<std::int64_t>(key / 8);
    const auto way = static_cast<int>(key % 8);
    const Point a{lower % nx, lower / nx % ny, lower / (nx * ny)};
    Point b = a;
    if (way < 3)
      (way == 0 ? b.x : (way == 1 ? b.y : b.z)) += 2;
    else
      b = {a.x + ((way - 3) & 1 ? 1 : -1), a.y + ((way - 3) & 2 ? 1 : -1), a.z + 1};
    Vec3d p = place(a), q = place(b);
    double fp = lattice_.field(p), fq = lattice_.field(q);
    for (int i = 0; i < 3; ++i) {
      const double t = std::fmin(0.98, std::fmax(0.02, fp / (fp - fq)));
      const Vec3d m = mix(p, q, t);
      const double fm = lattice_.field(m);
      if ((fm < 0) == (fp < 0))
        p = m, fp = fm;
      else
        q = m, fq = fm;
    }
    return mix(p, q, clamp01(fp / (fp - fq)));
  }

  Found march_block(std::size_t block) const {
    Found result;
    result.block = block;
    const Point o = origin_of(block);
    std::vector<double> value[2];  // of corners, of centres
    for (int kind = 0; kind < 2; ++kind) {
      value[kind].resize(kPoints);
      for (int k = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j)
          for (int i = 0; i < kSide; ++i)
            value[kind][static_cast<std::size_t>((k * kSide + j) * kSide + i)] =
                lattice_.field(place({o.x + 2 * i + kind, o.y + 2 * j + kind, o.z + 2 * k + kind}));
    }
    result.exits = exits_of(value);
    for (int k = 0; k < kBlock; ++k)
      for (int j = 0; j < kBlock; ++j)
        for (int i = 0; i < kBlock; ++i)
          for (int axis = 0; axis < 3; ++axis) march_face(result.corners, value, o, {i, j, k}, axis);
    return result;
  }

  [[nodiscard]] static double at(const std::vector<double> (&value)[2], int kind, int i, int j, int k) {
    return value[kind][static_cast<std::size_t>((k * kSide + j) * kSide + i)];
  }

  /// The surface goes on in the next block where points of the two layers along its face differ in sign: every tetrahedron that shares a
  /// triangle with one of the next block has three points there.
  [[nodiscard]] static unsigned exits_of(const std::vector<double> (&value)[2]) {
    unsigned exits = 0;
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      bool inside = false, outside = false;
      for (int kind = 0; kind < 2; ++kind)
        for (int a = 0; a < kSide; ++a)
          for (int b = 0; b < kSide; ++b)
            for (int layer = 0; layer < 2; ++layer) {
              // −: corners 0, centres 0 (and corners 1, centres 1: a little more than needed); +: the last two of each.
              const int depth = side % 2 == 0 ? layer : kSide - 1 - layer;
              int c[3];
              c[axis] = depth, c[(axis + 1) % 3] = a, c[(axis + 2) % 3] = b;
              (at(value, kind, c[0], c[1], c[2]) < 0 ? inside : outside) = true;
            }
      if (inside && outside) exits |= 1u << side;
    }
    return exits;
  }

  /// The four tetrahedra around the edge from a cube's centre to the next one's along `axis`, one for each edge of the face between.
  void march_face(std::vector<EdgeKey>& corners, const std::vector<double> (&value)[2], const Point& o, const std::array<int, 3>& cube,
                  int axis) const {
    std::array<int, 3> next = cube;
    ++next[static_cast<std::size_t>(axis)];
    const auto point = [&](const std::array<int, 3>& c, int kind) {
      return Point{o.x + 2 * c[0] + kind, o.y + 2 * c[1] + kind, o.z + 2 * c[2] + kind};
    };
    const double f0 = at(value, 1, cube[0], cube[1], cube[2]), f1 = at(value, 1, next[0], next[1], next[2]);
    const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
    static constexpr int kRing[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    std::array<int, 3> ring[5];
    double fr[5];
    for (int r = 0; r < 5; ++r) {
      ring[r] = next;
      ring[r][u] += kRing[r][0], ring[r][v] += kRing[r][1];
      fr[r] = at(value, 0, ring[r][0], ring[r][1], ring[r][2]);
    }
    for (int r = 0; r < 4; ++r) {
      // Positively oriented: axis, then counter-clockwise around it.
      const std::array<Point, 4> p{point(cube, 1), point(next, 1), point(ring[r], 0), point(ring[r + 1], 0)};
      march_tetrahedron(corners, p, {f0, f1, fr[r], fr[r + 1]});
    }
  }

  void march_tetrahedron(std::vector<EdgeKey>& corners, const std::array<Point, 4>& p, const std::array<double, 4>& f) const {
    std::array<std::size_t, 4> in{}, out{};
    std::size_t n_in = 0, n_out = 0;
    for (std::size_t i = 0; i < 4; ++i) (f[i] < 0 ? in[n_in++] : out[n_out++]) = i;
    if (n_in == 0 || n_out == 0) return;
    const auto edge = [&](std::size_t a, std::size_t b) { return key_of(p[a], p[b]); };
    // Whether the order of the four points (inside ones first) is an even permutation: then the triangle as written looks outward.
    std::array<std::size_t, 4> order{};
    std::copy(in.begin(), in.begin() + n_in, order.begin());
    std::copy(out.begin(), out.begin() + n_out, order.begin() + static_cast<std::ptrdiff_t>(n_in));
    bool even = true;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        if (order[i] > order[j]) even = !even;
    const auto emit = [&](EdgeKey a, EdgeKey b, EdgeKey c) {
      corners.push_back(a);
      corners.push_back(even ? b : c);
      corners.push_back(even ? c : b);
    };
    if (n_in == 1) {
      emit(edge(in[0], out[0]), edge(in[0], out[1]), edge(in[0], out[2]));
    } else if (n_in == 3) {
      emit(edge(in[0], out[0]), edge(in[1], out[0]), edge(in[2], out[0]));
    } else {
      const EdgeKey a = edge(in[0], out[0]), b = edge(in[0], out[1]), c = edge(in[1], out[1]), d = edge(in[1], out[0]);
      emit(a, b, c);
      emit(a, c, d);
    }
  }

  IsoTriangles joined(std::vector<Found>& all) const {
    std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.block < b.block; });
    std::vector<EdgeKey> keys;
    for (const Found& block : all) keys.insert(keys.end(), block.corners.begin(), block.corners.end());
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    IsoTriangles result;
    result.positions.resize(keys.size());
    parallel_for_blocks(keys.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) result.positions[i] = crossing(keys[i]);
    });
    std::vector<std::size_t> starts{0};
    for (const Found& block : all) starts.push_back(starts.back() + block.corners.size() / 3);
    result.faces.resize(starts.back());
    parallel_for(all.size(), [&](std::size_t b) {
      const std::vector<EdgeKey>& corners = all[b].corners;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto it = std::lower_bound(keys.begin(), keys.end(), corners[i]);
        result.faces[starts[b] + i / 3][i % 3] = static_cast<std::uint32_t>(it - keys.begin());
      }
    });
    return result;
  }

  IsoLattice lattice_;
  std::int64_t blocks_[3] = {0, 0, 0};
  std::vector<std::uint8_t> visited_;
};

}  // namespace

IsoTriangles march_lattice(const IsoLattice& lattice) { return Marcher(lattice).run(); }

}  // namespace etalon::procedural
