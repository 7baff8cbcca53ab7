#include "validation/fragments.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace etalon::validation {

namespace {

bool owns_edge(std::int64_t dx, std::int64_t dy, FillRule rule) {
  switch (rule) {
    case FillRule::left_ymin: return dy < 0 || (dy == 0 && dx > 0);
    case FillRule::left_ymax: return dy < 0 || (dy == 0 && dx < 0);
    case FillRule::right_ymin: return dy > 0 || (dy == 0 && dx > 0);
    case FillRule::right_ymax: return dy > 0 || (dy == 0 && dx < 0);
  }
  return false;
}

// Centre of the device's viewport on one axis: the smallest power of two (>= 2) that holds frame and guard, placed by whole texels.
double viewport_center(int frame, int guard) {
  const int extent = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(2, frame + 2 * guard))));
  const int center = extent / 2 - (extent - frame) / 2;
  return center;
}

// With equal w the device is sent w = 1; then ndc, product and sum are all float32 numbers if position and offset from the centre are.
bool positions_are_exact(const TriangleGeometry& g) {
  const auto is_float = [](double a) { return static_cast<double>(static_cast<float>(a)) == a; };
  if (g.w[0] != g.w[1] || g.w[1] != g.w[2]) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!is_float(g.x[i]) || !is_float(g.y[i]) || !is_float(g.x[i] - g.center_x) || !is_float(g.y[i] - g.center_y)) return false;
  }
  return true;
}

}  // namespace

TriangleEvaluator::TriangleEvaluator(const DrawList& list, std::uint32_t triangle, const Frame& frame)
    : id_(triangle), draw_(&list.draw_of(triangle)), half_texel_(1 << (frame.state.subtexel_bits - 1)), shift_(frame.state.subtexel_bits) {
  std::array<RasterVertex, 3> vertex;
  for (std::size_t i = 0; i < 3; ++i) vertex[i] = list.vertices[list.triangles[triangle][i]];
  const auto area = [&] {
    return static_cast<Wide>(static_cast<std::int64_t>(vertex[1].x) - vertex[0].x) *
               (static_cast<std::int64_t>(vertex[2].y) - vertex[0].y) -
           static_cast<Wide>(static_cast<std::int64_t>(vertex[2].x) - vertex[0].x) * (static_cast<std::int64_t>(vertex[1].y) - vertex[0].y);
  };
  const Wide signed_area = area();
  if (signed_area == 0) return;
  if (signed_area < 0 && frame.state.cull == CullMode::clockwise) return;
  if (signed_area > 0 && frame.state.cull == CullMode::counter_clockwise) return;
  draws_ = true;
  if (signed_area < 0) {
    std::swap(vertex[1], vertex[2]);
    order_ = {0, 2, 1};
  }
  const double texel = std::ldexp(1.0, -shift_);
  for (std::size_t i = 0; i < 3; ++i) {
    x_[i] = vertex[i].x;
    y_[i] = vertex[i].y;
    geometry_.x[i] = static_cast<double>(vertex[i].x) * texel;
    geometry_.y[i] = static_cast<double>(vertex[i].y) * texel;
    geometry_.w[i] = static_cast<double>(vertex[i].w);
    z_[i] = static_cast<double>(canonical(vertex[i].z));
    u_[i] = static_cast<double>(canonical(vertex[i].uv.x));
    v_[i] = static_cast<double>(canonical(vertex[i].uv.y));
    for (int c = 0; c < 4; ++c) color_[static_cast<std::size_t>(c)][i] = static_cast<double>(canonical(vertex[i].color[c]));
  }
  geometry_.center_x = viewport_center(frame.width, frame.guard);
  geometry_.center_y = viewport_center(frame.height, frame.guard);
  geometry_.exact_positions = positions_are_exact(geometry_);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    dx_[i] = x_[b] - x_[a];
    dy_[i] = y_[b] - y_[a];
    owns_[i] = owns_edge(dx_[i], dy_[i], frame.state.fill_rule);
  }
  const auto texel_of = [this](std::int64_t position) { return static_cast<int>(position >> shift_); };
  x0_ = std::clamp(texel_of(std::min({x_[0], x_[1], x_[2]})), 0, frame.width);
  x1_ = std::clamp(texel_of(std::max({x_[0], x_[1], x_[2]})) + 1, 0, frame.width);
  y0_ = std::clamp(texel_of(std::min({y_[0], y_[1], y_[2]})), 0, frame.height);
  y1_ = std::clamp(texel_of(std::max({y_[0], y_[1], y_[2]})) + 1, 0, frame.height);
}

std::array<TriangleEvaluator::Wide, 3> TriangleEvaluator::edges(int i, int j) const {
  const std::int64_t px = (static_cast<std::int64_t>(i) << shift_) + half_texel_;
  const std::int64_t py = (static_cast<std::int64_t>(j) << shift_) + half_texel_;
  std::array<Wide, 3> e;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3;
    e[k] = static_cast<Wide>(dx_[k]) * (py - y_[a]) - static_cast<Wide>(dy_[k]) * (px - x_[a]);
  }
  return e;
}

bool TriangleEvaluator::covers(int i, int j) const {
  if (!draws_) return false;
  const auto e = edges(i, j);
  for (std::size_t k = 0; k < 3; ++k) {
    if (e[k] < 0 || (e[k] == 0 && !owns_[k])) return false;
  }
  return true;
}

bool TriangleEvaluator::touches(int i, int j) const {
  if (!draws_) return false;
  const auto e = edges(i, j);
  return e[0] >= 0 && e[1] >= 0 && e[2] >= 0 && (e[0] == 0 || e[1] == 0 || e[2] == 0);
}

Sample TriangleEvaluator::sample(int i, int j) const {
  Sample s;
  s.x = i + 0.5;
  s.y = j + 0.5;
  const auto e = edges(i, j);
  for (std::size_t k = 0; k < 3; ++k) s.edge[k] = static_cast<double>(e[k]);
  const double sum = s.edge[0] + s.edge[1] + s.edge[2];
  const auto& w = geometry_.w;
  const std::array<double, 3> n{s.edge[0] * (w[1] * w[2]), s.edge[1] * (w[2] * w[0]), s.edge[2] * (w[0] * w[1])};
  const double total = n[0] + n[1] + n[2];
  s.q = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    s.linear[k] = s.edge[k] / sum;
    s.weight[k] = n[k] / total;
    s.q += s.linear[k] / w[k];
  }
  return s;
}

double TriangleEvaluator::edge_margin(const Sample& s) const {
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < 3; ++k) {
    const double dx = static_cast<double>(dx_[k]), dy = static_cast<double>(dy_[k]);
    nearest = std::min(nearest, s.edge[k] / std::sqrt(dx * dx + dy * dy));
  }
  return nearest;
}

double TriangleEvaluator::linear(const Sample& s, const std::array<double, 3>& a) const {
  return s.linear[0] * a[0] + s.linear[1] * a[1] + s.linear[2] * a[2];
}

double TriangleEvaluator::perspective(const Sample& s, const std::array<double, 3>& a) const {
  return s.weight[0] * a[0] + s.weight[1] * a[1] + s.weight[2] * a[2];
}

TriangleGrid::TriangleGrid(const DrawList& list, const Frame& frame) : columns_((frame.width + kTile - 1) / kTile) {
  const std::size_t rows = static_cast<std::size_t>((frame.height + kTile - 1) / kTile);
  first_.assign(static_cast<std::size_t>(columns_) * rows + 1, 0);
  // A tile is skipped where one edge has all four of its corners outside: exact in double up to rounding, so the test keeps a texel of slack.
  const auto visit = [&](const auto& body) {
    for (std::uint32_t t = 0; t < list.triangles.size(); ++t) {
      const TriangleEvaluator e(list, t, frame);
      if (!e.draws()) continue;
      const auto [x0, y0, x1, y1] = e.box();
      if (x0 >= x1 || y0 >= y1) continue;
      const auto& g = e.geometry();
      for (int row = y0 / kTile; row <= (y1 - 1) / kTile; ++row) {
        for (int column = x0 / kTile; column <= (x1 - 1) / kTile; ++column) {
          bool outside = false;
          for (std::size_t k = 0; k < 3 && !outside; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            const double dx = g.x[b] - g.x[a], dy = g.y[b] - g.y[a];
            const double corner_x = dy > 0 ? column * kTile - 1.0 : (column + 1) * kTile + 1.0;
            const double corner_y = dx > 0 ? (row + 1) * kTile + 1.0 : row * kTile - 1.0;
            outside = dx * (corner_y - g.y[a]) - dy * (corner_x - g.x[a]) < 0;
          }
          if (!outside) body(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column), t);
        }
      }
    }
  };
  visit([this](std::size_t tile, std::uint32_t) { ++first_[tile + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  entries_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  visit([&](std::size_t tile, std::uint32_t t) { entries_[next[tile]++] = t; });
}

}  // namespace etalon::validation
