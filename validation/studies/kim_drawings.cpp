#include "validation/studies/kim_drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/simplify/kim_metric.h"
#include "validation/studies/svg.h"

namespace etalon::validation {

namespace {

std::string rgb(const Vec4f& c) {
  const auto byte = [](float x) { return static_cast<int>(x * 255 + 0.5f); };
  return fmt::format("rgb({},{},{})", byte(c.x), byte(c.y), byte(c.z));
}

Mesh flat_mesh(const std::vector<Vec2f>& places, const std::vector<std::array<std::uint32_t, 3>>& faces, const std::vector<Vec4f>& colors) {
  Mesh mesh;
  for (const Vec2f& p : places) mesh.positions.push_back({p.x, p.y, 0});
  for (std::uint32_t v = 0; v < places.size(); ++v) mesh.wedges.push_back({VertexId(v), {0, 0}});
  for (const auto& f : faces) mesh.faces.push_back({WedgeId(f[0]), WedgeId(f[1]), WedgeId(f[2])});
  mesh.colors = colors;
  return mesh;
}

/// Corners of the unit hexagon: √3/2 rounded, no trigonometry.
constexpr float kHalfRoot3 = 0.8660254f;
const std::vector<Vec2f> kHexagon{
    {0, 0}, {1, 0}, {0.5f, kHalfRoot3}, {-0.5f, kHalfRoot3}, {-1, 0}, {-0.5f, -kHalfRoot3}, {0.5f, -kHalfRoot3}};

const Vec4f kRed{0.86f, 0.16f, 0.14f, 1}, kWhite{1, 1, 1, 1}, kBlack{0.07f, 0.07f, 0.09f, 1}, kRose{0.95f, 0.70f, 0.68f, 1};

std::string fan_drawing(const Mesh& mesh, double x, double y, double size) {
  std::string svg;
  const auto at = [&](std::uint32_t v) { return Vec2d(x + size * mesh.positions[v].x, y - size * mesh.positions[v].y); };
  for (std::uint32_t v = 1; v <= 6; ++v) {
    const Vec2d a = at(v), b = at(v % 6 + 1), c = at(0);
    svg +=
        fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" fill=\"none\" class=\"axis\"/>", a.x, a.y, b.x, b.y, c.x, c.y);
  }
  for (std::uint32_t v = 0; v <= 6; ++v) {
    const Vec2d p = at(v);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" class=\"axis\"/>", p.x, p.y, v == 0 ? 13 : 10,
                       rgb(mesh.colors[v]));
  }
  return svg;
}

}  // namespace

Mesh color_fan(const std::vector<Vec4f>& colors) {
  return flat_mesh(kHexagon, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}}, colors);
}

double visual_importance(const Mesh& source, std::uint32_t vertex) {
  const simplify::CollapseMesh mesh(source, {});
  const simplify::UnitPositions positions = simplify::unit_positions(mesh);
  return simplify::KimMetric(mesh, positions, {}, {}).importance(vertex);
}

CollapsePatch collapse_patch() {
  // Rows of a triangular lattice; odd rows are shifted by half an edge.
  constexpr std::uint32_t kColumns = 7, kRows = 5;
  std::vector<Vec2f> places;
  std::vector<Vec4f> colors;
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      places.push_back({static_cast<float>(c) + (r % 2 ? 0.5f : 0.0f), kHalfRoot3 * static_cast<float>(r)});
      colors.push_back((r + c) % 3 == 0 ? kRed : (r + c) % 3 == 1 ? kWhite : kRose);
    }
  for (std::uint32_t r = 0; r + 1 < kRows; ++r)
    for (std::uint32_t c = 0; c + 1 < kColumns; ++c) {
      const std::uint32_t a = r * kColumns + c, b = a + 1, d = a + kColumns, e = d + 1;
      if (r % 2 == 0) {
        faces.push_back({a, b, d});
        faces.push_back({b, e, d});
      } else {
        faces.push_back({a, b, e});
        faces.push_back({a, e, d});
      }
    }
  CollapsePatch patch;
  patch.mesh = flat_mesh(places, faces, colors);
  patch.v0 = 2 * kColumns + 2;
  patch.v1 = patch.v0 + 1;
  simplify::CollapseMesh mesh(patch.mesh, {});
  mesh.collapse(patch.v0, mesh.find_edge(patch.v0, patch.v1));
  patch.changed.assign(faces.size(), true);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (!mesh.face_alive(f)) continue;
    const std::array<std::uint32_t, 3> now{mesh.start(4 * f), mesh.start(4 * f + 1), mesh.start(4 * f + 2)};
    patch.changed[f] = now != faces[f];
    patch.after.push_back(now);
    patch.source.push_back(f);
  }
  return patch;
}

std::string importance_drawing() {
  struct Example {
    const char* name;
    std::vector<Vec4f> colors;
  };
  const std::vector<Example> examples{
      {"(a) white among black", {kWhite, kBlack, kBlack, kBlack, kBlack, kBlack, kBlack}},
      {"(b) red among black", {kRed, kBlack, kBlack, kBlack, kBlack, kBlack, kBlack}},
      {"one neighbour differs", {kRed, kBlack, kRed, kRed, kRed, kRed, kRed}},
      {"all alike", {kRed, kRed, kRed, kRed, kRed, kRed, kRed}},
  };
  std::string svg = svg_open(1000, 270, "visual importance of four vertices");
  double x = 130;
  for (const Example& example : examples) {
    const Mesh mesh = color_fan(example.colors);
    svg += fan_drawing(mesh, x, 115, 78) + svg_text(x, 225, example.name, "middle", "faint") +
           svg_text(x, 250, fmt::format("I(v0) = {:.4g}", visual_importance(mesh, 0)), "middle");
    x += 246;
  }
  return svg + "</svg>";
}

std::string collapse_drawing() {
  const CollapsePatch patch = collapse_patch();
  std::string svg = svg_open(1000, 330, "the area of colour change by a half-edge collapse");
  const auto at = [&](std::uint32_t v, double x) {
    return Vec2d(x + 60 * patch.mesh.positions[v].x, 270 - 60 * patch.mesh.positions[v].y);
  };
  const auto triangle = [&](const std::array<std::uint32_t, 3>& f, double x, bool changed) {
    const Vec2d a = at(f[0], x), b = at(f[1], x), c = at(f[2], x);
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" fill=\"{}\" class=\"axis\"/>", a.x, a.y, b.x, b.y, c.x, c.y,
                       changed ? "rgb(128 128 128 / .55)" : "none");
  };
  for (std::uint32_t f = 0; f < patch.mesh.face_count(); ++f)
    triangle({patch.mesh.vertex(FaceId(f), 0).index, patch.mesh.vertex(FaceId(f), 1).index, patch.mesh.vertex(FaceId(f), 2).index}, 30,
             patch.changed[f]);
  for (std::size_t i = 0; i < patch.after.size(); ++i) triangle(patch.after[i], 530, patch.changed[patch.source[i]]);
  for (std::uint32_t v = 0; v < patch.mesh.vertex_count(); ++v)
    for (const double x : {30.0, 530.0}) {
      if (v == patch.v0 && x > 100) continue;
      const Vec2d p = at(v, x);
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"{}\" class=\"axis\"/>", p.x, p.y, rgb(patch.mesh.colors[v]));
    }
  const Vec2d v0 = at(patch.v0, 30), v1 = at(patch.v1, 30), left = at(patch.v1, 530);
  svg += svg_text(v0.x - 10, v0.y - 12, "v0", "end") + svg_text(v1.x + 10, v1.y - 12, "v1") + svg_text(left.x + 10, left.y - 12, "v1");
  svg += svg_text(250, 318, "before: the faces of v0", "middle", "faint") +
         svg_text(750, 318, "after v0 → v1: those that are left of them", "middle", "faint");
  return svg + "</svg>";
}

std::string sweep_drawing(const std::vector<KimSubjectResult>& subjects) {
  struct Curve {
    const char* name;
    const char* color;
    double KimSweepPoint::*value;
    double KimOutcome::*base;
  };
  static constexpr Curve kCurves[] = {{"Metro mean", "#0072b2", &KimSweepPoint::mean, &KimOutcome::mean},
                                      {"Metro RMS", "#e69f00", &KimSweepPoint::rms, &KimOutcome::rms},
                                      {"image RMS", "#009e73", &KimSweepPoint::image_rms, &KimOutcome::image_rms}};
  std::vector<const KimSubjectResult*> shown;
  for (const KimSubjectResult& subject : subjects)
    if (!subject.sweep.empty()) shown.push_back(&subject);
  if (shown.empty()) return "";
  constexpr int kWidth = 1000, kPanel = 250, kLeft = 60, kRight = 30, kTop = 34, kHigh = 160;
  std::string svg = svg_open(kWidth, kPanel * static_cast<int>(shown.size()) + 10, "kim divided by qem6 over the unit of length");
  for (std::size_t s = 0; s < shown.size(); ++s) {
    const KimSubjectResult& subject = *shown[s];
    const KimOutcome& base = subject.of(KimMethod::qem6);
    double highest = 1.2;
    for (const Curve& curve : kCurves)
      for (const KimSweepPoint& point : subject.sweep)
        if (base.*curve.base > 0) highest = std::max(highest, point.*curve.value / (base.*curve.base));
    const double limit = std::min(highest * 1.05, 8.0);
    const double top = kPanel * static_cast<double>(s) + kTop, count = static_cast<double>(subject.sweep.size() - 1);
    const auto x_of = [&](std::size_t i) { return kLeft + (kWidth - kLeft - kRight) * static_cast<double>(i) / count; };
    const auto y_of = [&](double ratio) { return top + kHigh * (1 - std::min(ratio, limit) / limit); };
    svg += svg_text(kLeft, top - 14, subject.name + ": kim / qem6 (half-edge)");
    const double step = limit > 4 ? 1 : 0.5;
    for (double level = 0; level <= limit; level += step)
      svg += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>", kLeft, kWidth - kRight, y_of(level),
                         y_of(level), std::fabs(level - 1) < 1e-9 ? "axis" : "grid") +
             svg_text(kLeft - 8, y_of(level) + 4, fmt::format("{:.1f}", level), "end", "faint");
    const std::size_t middle = subject.sweep.size() / 2;
    for (std::size_t i = 0; i < subject.sweep.size(); i += 2) {
      const int decade = (static_cast<int>(i) - static_cast<int>(middle)) / 2;
      static constexpr const char* kPowers[] = {"10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "D/8000", "10¹", "10²", "10³", "10⁴"};
      const std::string name = (decade == 0 ? "" : "×") + std::string(kPowers[decade + 4]);
      svg += svg_text(x_of(i), top + kHigh + 20, name, "middle", "faint");
    }
    svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"axis\" stroke-dasharray=\"4 4\"/>",
                       x_of(middle), top, top + kHigh);
    double legend = kWidth - kRight - 330.0;
    for (const Curve& curve : kCurves) {
      if (!(base.*curve.base > 0)) continue;
      std::string path;
      for (std::size_t i = 0; i < subject.sweep.size(); ++i)
        path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x_of(i), y_of(subject.sweep[i].*curve.value / (base.*curve.base)));
      svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.2\"/>", path, curve.color);
      svg += fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"3\"/>", legend,
                         legend + 22, top - 18, top - 18, curve.color) +
             svg_text(legend + 28, top - 14, curve.name);
      legend += 115;
    }
    svg +=
        svg_text((kLeft + kWidth - kRight) / 2.0, top + kHigh + 42, "unit of length (D: diagonal of the bounding box)", "middle", "faint");
  }
  return svg + "</svg>";
}

std::string ratio_drawing(const std::vector<KimSubjectResult>& subjects) {
  constexpr int kWidth = 1000, kLeft = 250, kRight = 40, kRow = 24;
  struct Quantity {
    const char* name;
    double (*ours)(const KimOutcome&);
    double (*paper)(const KimPaperRow&);
  };
  static constexpr Quantity kQuantities[] = {
      {"Metro mean", [](const KimOutcome& o) { return o.mean; }, [](const KimPaperRow& r) { return r.kim_mean / r.qem6_mean; }},
      {"Metro RMS", [](const KimOutcome& o) { return o.rms; }, [](const KimPaperRow& r) { return r.kim_rms / r.qem6_rms; }},
      {"image RMS", [](const KimOutcome& o) { return o.image_rms; }, [](const KimPaperRow& r) { return r.kim_image / r.qem6_image; }},
  };
  double highest = 2;
  for (const Quantity& q : kQuantities)
    for (const KimSubjectResult& s : subjects)
      for (const KimMethod base : {KimMethod::qem6, KimMethod::qem6_full})
        if (q.ours(s.of(base)) > 0) highest = std::max(highest, q.ours(s.of(KimMethod::kim)) / q.ours(s.of(base)));
  const double limit = std::ceil(highest * 2 + 0.1) / 2;
  const int rows = static_cast<int>(3 * (subjects.size() + 1));
  std::string svg = svg_open(kWidth, rows * kRow + 60, "ratios kim / qem6, ours and the paper's");
  const auto x_of = [&](double ratio) { return kLeft + (kWidth - kLeft - kRight) * ratio / limit; };
  const int bottom = rows * kRow + 24;
  for (double level = 0; level <= limit + 1e-9; level += limit > 5 ? 1 : 0.5)
    svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"24\" y2=\"{1}\" class=\"{2}\"/>", x_of(level), bottom,
                       std::fabs(level - 1) < 1e-9 ? "axis" : "grid") +
           svg_text(x_of(level), bottom + 18, fmt::format("{:.1f}", level), "middle", "faint");
  svg += fmt::format("<circle cx=\"{}\" cy=\"10\" r=\"6\" fill=\"#0072b2\"/>", kLeft + 6) +
         svg_text(kLeft + 18, 15, "against half-edge qem6") +
         fmt::format("<circle cx=\"{}\" cy=\"10\" r=\"6\" fill=\"none\" stroke=\"#e69f00\" stroke-width=\"2.5\"/>", kLeft + 206) +
         svg_text(kLeft + 218, 15, "against full-edge qem6") +
         fmt::format("<path d=\"M{0} 3l7 7l-7 7l-7 -7z\" fill=\"#cc79a7\"/>", kLeft + 407) + svg_text(kLeft + 420, 15, "the paper's");
  double y = 24;
  for (const Quantity& q : kQuantities) {
    y += kRow;
    svg += svg_text(10, y + 5, q.name);
    for (const KimSubjectResult& s : subjects) {
      svg += svg_text(kLeft - 14, y + 5, s.name, "end", "faint");
      const double kim = q.ours(s.of(KimMethod::kim)), half = q.ours(s.of(KimMethod::qem6)), full = q.ours(s.of(KimMethod::qem6_full));
      svg += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" class=\"grid\"/>", kLeft, kWidth - kRight, y, y);
      if (half > 0) svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"#0072b2\"/>", x_of(kim / half), y);
      if (full > 0)
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"none\" stroke=\"#e69f00\" stroke-width=\"2.5\"/>",
                           x_of(kim / full), y);
      if (s.paper_row)
        svg += fmt::format("<path d=\"M{:.1f} {:.1f}l7 7l-7 7l-7 -7z\" fill=\"#cc79a7\"/>", x_of(q.paper(kim_paper_rows()[*s.paper_row])),
                           y - 7);
      y += kRow;
    }
  }
  return svg + "</svg>";
}

}  // namespace etalon::validation
