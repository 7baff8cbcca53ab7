#include "gpu/probe.h"

#include <array>
#include <cstdint>

#include <fmt/core.h>

namespace etalon::gpu {

namespace {

// The lattice of the fill-rule probe: all triangles between nine sample points of an 8 × 8 cell, so that horizontal, vertical and
// slanted edges, left and right ones, pass through samples.
constexpr int kLatticeSize = 8;
constexpr std::array<FillRule, 4> kFillRules{FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax};

struct LatticePoint {
  int x;  ///< half texels: odd coordinates are samples
  int y;
};
using LatticeTriangle = std::array<LatticePoint, 3>;

constexpr std::array<LatticePoint, 9> kLatticePoints{{{1, 1}, {7, 1}, {15, 1}, {1, 7}, {7, 7}, {15, 7}, {1, 15}, {7, 15}, {15, 15}}};

std::string text(const gl::Api& gl, gl::Enum name) {
  const auto* value = reinterpret_cast<const char*>(gl.get_string(name));
  return value != nullptr ? value : "";
}

/// "4.5 (Core Profile) Mesa 22.3.6" → "22.3.6".
std::string mesa_version_in(const std::string& version) {
  const std::string mark = "Mesa ";
  const std::size_t at = version.find(mark);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + mark.size();
  return version.substr(begin, version.find(' ', begin) - begin);
}

DrawList one_draw(std::vector<RasterVertex> vertices) {
  DrawList list;
  list.vertices = std::move(vertices);
  for (std::uint32_t i = 0; i + 2 < list.vertices.size(); i += 3) list.triangles.push_back({i, i + 1, i + 2});
  list.draws.push_back({.first_triangle = 0, .triangle_count = static_cast<std::uint32_t>(list.triangles.size())});
  return list;
}

HalfRounding probe_half_rounding(GlPipeline& pipeline) {
  // Halves near 1 are 2^-10 apart: 1 + 3/4·2^-10 is 1 when truncated and the next half when rounded; a device's interpolation error of a
  // constant (some 2^-24) is far below the quarter step to the nearest decision.
  const float value = 1.0f + 0.75f * 0x1p-10f;
  constexpr int kOneTexel = 1 << 8;
  std::vector<RasterVertex> vertices;
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{4 * kOneTexel, 0}, std::pair{0, 4 * kOneTexel}}) {
    vertices.push_back({.x = x, .y = y, .z = 0, .w = 1, .uv = {0, 0}, .color = {value, value, value, value}});
  }
  Frame frame;
  frame.width = frame.height = 4;
  frame.guard = 2;
  frame.targets = {{.content = TargetContent::color, .format = {ChannelType::half, 1}}};
  const Image image = pipeline.draw(one_draw(std::move(vertices)), frame).front();
  constexpr std::uint16_t kHalfOne = 0x3C00;
  return *image.channels<std::uint16_t>(0, 0) == kHalfOne ? HalfRounding::toward_zero : HalfRounding::nearest_even;
}

bool owns_edge(FillRule rule, int dx, int dy) {
  const bool left = rule == FillRule::left_ymin || rule == FillRule::left_ymax;
  const bool ymin = rule == FillRule::left_ymin || rule == FillRule::right_ymin;
  if (dy != 0) return left ? dy < 0 : dy > 0;
  return ymin ? dx > 0 : dx < 0;
}

bool covers(LatticeTriangle t, FillRule rule, int column, int row) {
  const auto cross = [](LatticePoint a, LatticePoint b, LatticePoint p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  if (cross(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
  const LatticePoint sample{2 * column + 1, 2 * row + 1};
  for (int i = 0; i < 3; ++i) {
    const LatticePoint a = t[static_cast<std::size_t>(i)];
    const LatticePoint b = t[static_cast<std::size_t>((i + 1) % 3)];
    const int e = cross(a, b, sample);
    if (e < 0 || (e == 0 && !owns_edge(rule, b.x - a.x, b.y - a.y))) return false;
  }
  return true;
}

std::vector<LatticeTriangle> lattice_triangles() {
  std::vector<LatticeTriangle> triangles;
  for (std::size_t i = 0; i < kLatticePoints.size(); ++i) {
    for (std::size_t j = i + 1; j < kLatticePoints.size(); ++j) {
      for (std::size_t k = j + 1; k < kLatticePoints.size(); ++k) {
        const LatticeTriangle t{kLatticePoints[i], kLatticePoints[j], kLatticePoints[k]};
        if ((t[1].x - t[0].x) * (t[2].y - t[0].y) != (t[1].y - t[0].y) * (t[2].x - t[0].x)) triangles.push_back(t);
      }
    }
  }
  return triangles;
}

/// Each triangle in a cell of its own, all in one frame.
std::optional<FillRule> probe_fill_rule(GlPipeline& pipeline) {
  constexpr int kHalfTexel = 1 << 7;
  const std::vector<LatticeTriangle> triangles = lattice_triangles();
  const int columns = 16;
  const int rows = static_cast<int>(triangles.size() + columns - 1) / columns;
  const auto origin = [&](std::size_t t) {
    return std::pair{static_cast<int>(t) % columns * kLatticeSize, static_cast<int>(t) / columns * kLatticeSize};
  };
  std::vector<RasterVertex> vertices;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [x0, y0] = origin(t);
    for (const LatticePoint p : triangles[t]) {
      vertices.push_back({.x = (2 * x0 + p.x) * kHalfTexel, .y = (2 * y0 + p.y) * kHalfTexel});
    }
  }
  Frame frame;
  frame.width = columns * kLatticeSize;
  frame.height = rows * kLatticeSize;
  frame.guard = 16;
  frame.targets = {{.content = TargetContent::triangle_id, .format = kR32ui}};
  const Image ids = pipeline.draw(one_draw(std::move(vertices)), frame).front();

  for (const FillRule rule : kFillRules) {
    bool agrees = true;
    for (std::size_t t = 0; t < triangles.size() && agrees; ++t) {
      const auto [x0, y0] = origin(t);
      for (int row = 0; row < kLatticeSize; ++row) {
        for (int column = 0; column < kLatticeSize; ++column) {
          const bool drawn = *ids.channels<std::uint32_t>(x0 + column, y0 + row) == t;
          agrees = agrees && drawn == covers(triangles[t], rule, column, row);
        }
      }
    }
    if (agrees) return rule;
  }
  return std::nullopt;
}

}  // namespace

std::string DeviceInfo::name() const {
  return mesa_version.empty() ? fmt::format("{}, OpenGL {}", renderer, version) : fmt::format("{}, Mesa {}", renderer, mesa_version);
}

DeviceInfo probe(Context& context, GlPipeline& pipeline) {
  context.make_current();
  const gl::Api& gl = context.gl();
  DeviceInfo info;
  info.renderer = text(gl, gl::kRenderer);
  info.vendor = text(gl, gl::kVendor);
  info.version = text(gl, gl::kVersion);
  info.mesa_version = mesa_version_in(info.version);
  info.origin = context.origin();
  gl.get_integerv(gl::kSubpixelBits, &info.subtexel_bits);
  info.half_rounding = probe_half_rounding(pipeline);
  info.fill_rule = probe_fill_rule(pipeline);
  if (info.renderer.rfind("llvmpipe", 0) == 0) info.snap = SnapRounding::nearest_even;
  info.limits = pipeline.limits();
  return info;
}

DeviceInfo probe(Context& context) {
  GlPipeline pipeline(context);
  return probe(context, pipeline);
}

}  // namespace etalon::gpu
