#include "validation/reference/surface_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace etalon::validation::reference {
namespace {

using Point = std::array<double, 3>;

Point wide(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double times(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double apart2(const Point& a, const Point& b) { return times(minus(a, b), minus(a, b)); }

/// At right angles to both, as long as their parallelogram is large.
Point across(const Point& s, const Point& t) { return {s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]}; }

double area(const Point& a, const Point& b, const Point& c) {
  const Point n = across(minus(b, a), minus(c, a));
  return 0.5 * std::sqrt(times(n, n));
}

/// How far along from a to b the point nearest to p is: 0 to 1.
double along_edge(const Point& p, const Point& a, const Point& b) {
  const double t = times(minus(b, a), minus(p, a)), whole = times(minus(b, a), minus(b, a));
  if (t <= 0 || whole <= 0) return 0;
  if (t >= whole) return 1;
  return t / whole;
}

struct Candidate {
  Point weights{}, point{};
  double distance2 = std::numeric_limits<double>::infinity();
};

Candidate weighted(const Point& p, const std::array<Point, 3>& corner, const Point& w) {
  const Point s = minus(corner[1], corner[0]), t = minus(corner[2], corner[0]);
  Candidate c{.weights = w};
  for (std::size_t k = 0; k < 3; ++k) c.point[k] = corner[0][k] + (w[1] * s[k] + w[2] * t[k]);
  c.distance2 = apart2(p, c.point);
  return c;
}

Candidate nearest_of_triangle(const Point& p, const std::array<Point, 3>& corner) {
  const auto& [a, b, c] = corner;
  const auto at_corner = [&](std::size_t i) {
    Candidate result{.point = corner[i], .distance2 = apart2(p, corner[i])};
    result.weights[i] = 1;
    return result;
  };
  // Seen from corner i: how far p is along the two sides that leave a.
  std::array<double, 3> along_b, along_c;
  for (std::size_t i = 0; i < 3; ++i) {
    along_b[i] = times(minus(b, a), minus(p, corner[i]));
    along_c[i] = times(minus(c, a), minus(p, corner[i]));
  }
  if (along_b[0] <= 0 && along_c[0] <= 0) return at_corner(0);
  if (along_b[1] >= 0 && along_c[1] <= along_b[1]) return at_corner(1);
  if (along_c[2] >= 0 && along_b[2] <= along_c[2]) return at_corner(2);
  const Point n = across(minus(b, a), minus(c, a));
  const double of_a = times(n, across(minus(c, b), minus(p, b))), of_b = times(n, across(minus(p, a), minus(c, a))),
               of_c = times(n, across(minus(b, a), minus(p, a)));
  const double all = of_a + of_b + of_c;
  const double least_area2 = 0x1p-48 * (times(minus(b, a), minus(b, a)) * times(minus(c, a), minus(c, a)));
  if (of_a > 0 && of_b > 0 && of_c > 0 && all > least_area2) {
    const double v = of_b / all, w = of_c / all;
    return weighted(p, corner, {1 - v - w, v, w});
  }
  const double on_ab = along_edge(p, a, b), on_bc = along_edge(p, b, c), on_ca = along_edge(p, c, a);
  Candidate best = weighted(p, corner, {1 - on_ab, on_ab, 0});
  for (const Point& weights : {Point{0, 1 - on_bc, on_bc}, Point{on_ca, 0, 1 - on_ca}})
    if (const Candidate other = weighted(p, corner, weights); other.distance2 < best.distance2) best = other;
  return best;
}

struct Sample {
  Point point{}, color{};
};

/// The samples of a surface, in order.
class Sampler {
 public:
  Sampler(const JudgedSurface& surface, std::uint64_t target) : surface_(surface) {
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    double whole_area = 0;
    for (const auto& face : surface.faces) {
      whole_area += area_of(face);
      for (std::size_t k = 0; k < 3; ++k) {
        vertices.insert(face[k]);
        if (face[k] != face[(k + 1) % 3]) edges.insert(std::minmax({face[k], face[(k + 1) % 3]}));
      }
    }
    for (const std::uint32_t v : vertices) add({v, v, v}, {1, 0, 0});
    on_vertices = samples.size();
    if (on_vertices >= target || !(whole_area > 0)) return;

    const double per_length = std::sqrt(static_cast<double>(target - on_vertices) / whole_area);
    double length = 0;
    std::uint64_t before = 0;
    for (const auto& [low, high] : edges) {
      length += std::sqrt(apart2(wide(surface.positions[low]), wide(surface.positions[high])));
      const auto until = static_cast<std::uint64_t>(length * per_length);
      for (std::uint64_t i = 1; i <= until - before; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(until - before + 1);
        add({low, high, high}, {1 - t, t, 0});
      }
      before = until;
    }
    on_edges = samples.size() - on_vertices;
    if (samples.size() >= target) return;

    const double per_area = static_cast<double>(target - samples.size()) / whole_area;
    double sum = 0;
    std::uint64_t number = 0;
    for (const auto& face : surface.faces) {
      sum += area_of(face);
      for (; number < static_cast<std::uint64_t>(sum * per_area); ++number) add(face, inside(number));
    }
    on_faces = number;
  }

  std::vector<Sample> samples;
  std::uint64_t on_vertices = 0, on_edges = 0, on_faces = 0;

 private:
  [[nodiscard]] double area_of(const std::array<std::uint32_t, 3>& f) const {
    return area(wide(surface_.positions[f[0]]), wide(surface_.positions[f[1]]), wide(surface_.positions[f[2]]));
  }

  static double fraction(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; }
  // Point `number` of the sequence R2, folded onto the triangle.
  static Point inside(std::uint64_t number) {
    const double u = fraction(number * 0xC13FA9A902A6328Full), v = fraction(number * 0x91E10DA5C79E7B1Dull);
    if (u + v > 1) return {1 - (1 - u) - (1 - v), 1 - u, 1 - v};
    return {1 - u - v, u, v};
  }

  void add(const std::array<std::uint32_t, 3>& v, const Point& w) {
    Sample sample;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto mix = [&](const auto& at) {
        return w[0] * static_cast<double>(at[v[0]][k]) + w[1] * static_cast<double>(at[v[1]][k]) + w[2] * static_cast<double>(at[v[2]][k]);
      };
      sample.point[k] = mix(surface_.positions);
      if (!surface_.colors.empty()) sample.color[k] = mix(surface_.colors);
    }
    samples.push_back(sample);
  }

  const JudgedSurface& surface_;
};

double colour_apart2(const JudgedSurface& surface, const JudgedPoint& found, const Point& color) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto of = [&](std::size_t corner) { return static_cast<double>(surface.colors[surface.faces[found.face][corner]][k]); };
    const double d = found.weights[0] * of(0) + found.weights[1] * of(1) + found.weights[2] * of(2) - color[k];
    sum += d * d;
  }
  return sum;
}

/// Sums of 4096 samples each, then the sum of these.
class BlockedSum {
 public:
  void add(double x) {
    block_ += x;
    if (++count_ % 4096 == 0) close();
  }
  double total() {
    close();
    return total_;
  }

 private:
  void close() {
    total_ += block_;
    block_ = 0;
  }
  double block_ = 0, total_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace

JudgedPoint judge_nearest(const JudgedSurface& surface, const Point& p) {
  JudgedPoint best{.distance2 = std::numeric_limits<double>::infinity()};
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto& face = surface.faces[f];
    const Candidate found =
        nearest_of_triangle(p, {wide(surface.positions[face[0]]), wide(surface.positions[face[1]]), wide(surface.positions[face[2]])});
    if (found.distance2 < best.distance2) best = {f, found.weights, found.point, found.distance2};
  }
  return best;
}

JudgedDistance judge_distance(const JudgedSurface& from, const JudgedSurface& to, std::uint64_t target) {
  const Sampler sampler(from, target);
  JudgedDistance result{.samples = sampler.samples.size(),
                        .vertex_samples = sampler.on_vertices,
                        .edge_samples = sampler.on_edges,
                        .face_samples = sampler.on_faces,
                        .has_colors = !from.colors.empty() && !to.colors.empty()};
  BlockedSum distances, squares, colours, colour_squares;
  double most2 = -1;
  for (const Sample& sample : sampler.samples) {
    const JudgedPoint found = judge_nearest(to, sample.point);
    distances.add(std::sqrt(found.distance2));
    squares.add(found.distance2);
    if (found.distance2 > most2) {
      most2 = found.distance2;
      result.max_at = sample.point;
    }
    if (!result.has_colors) continue;
    const double colour2 = colour_apart2(to, found, sample.color);
    colours.add(std::sqrt(colour2));
    colour_squares.add(colour2);
    result.colour_max = std::max(result.colour_max, std::sqrt(colour2));
  }
  const auto count = static_cast<double>(result.samples);
  result.mean = distances.total() / count;
  result.rms = std::sqrt(squares.total() / count);
  result.max = std::sqrt(most2);
  if (result.has_colors) {
    result.colour_mean = colours.total() / count;
    result.colour_rms = std::sqrt(colour_squares.total() / count);
  }
  return result;
}

}  // namespace etalon::validation::reference
