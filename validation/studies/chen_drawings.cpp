#include "validation/studies/chen_drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/nearest_point.h"
#include "validation/studies/svg.h"

namespace etalon::validation {

namespace {

// Colours that colour-blind readers can tell apart [Okabe & Ito 2008], and tints of them.
constexpr const char* kHues[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9",
                                 "#d55e00", "#f0e442", "#8a8f98", "#7a5195", "#3c6e47"};

double cross(const Vec2d& a, const Vec2d& b) { return a.x * b.y - a.y * b.x; }

/// From p to the line a–b.
double line_distance(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const Vec2d d = b - a;
  const double length2 = d.x * d.x + d.y * d.y;
  return length2 > 0 ? std::abs(cross(d, p - a)) / std::sqrt(length2) : 0;
}

/// Of the corners first..last of the ring, the one whose line from `from` comes nearest to p.
std::size_t nearest_line(const ChenCollapse& collapse, const Vec2d& from, std::size_t first, std::size_t last, const Vec2d& p) {
  std::size_t best = first;
  for (std::size_t k = first; k <= last; ++k)
    if (line_distance(p, from, Vec2d(collapse.cells.nodes[k].before)) < line_distance(p, from, Vec2d(collapse.cells.nodes[best].before)))
      best = k;
  return best;
}

/// The collapse with every crossing where its edges cross on the texture plane, u being at its new place: the overlay itself.
ChenCollapse as_overlay(const ChenCollapse& collapse) {
  ChenCollapse overlay = collapse;
  auto& nodes = overlay.cells.nodes;
  const Vec2d u(nodes[0].after), v(nodes[1].after), u_before(nodes[0].before);
  for (std::size_t n = 1 + collapse.ring; n < nodes.size(); ++n) {
    const Vec2d spoke = Vec2d(nodes[nearest_line(collapse, u_before, 2, collapse.ring, Vec2d(nodes[n].before))].before) - u;
    const Vec2d diagonal = Vec2d(nodes[nearest_line(collapse, v, 3, collapse.ring - 1, Vec2d(nodes[n].after))].after) - v;
    const double area = cross(spoke, diagonal);
    if (area != 0) nodes[n].after = Vec2f(u + spoke * (cross(v - u, diagonal) / area));
  }
  return overlay;
}

/// Ring coordinates into a square panel.
class Panel {
 public:
  Panel(const ChenCollapse& collapse, double x, double y, double size) : x_(x), y_(y), size_(size) {
    low_ = high_ = Vec2d(collapse.cells.nodes.front().before);
    for (const adapt::CellNode& node : collapse.cells.nodes)
      for (const Vec2f& p : {node.before, node.after}) {
        low_ = {std::min(low_.x, static_cast<double>(p.x)), std::min(low_.y, static_cast<double>(p.y))};
        high_ = {std::max(high_.x, static_cast<double>(p.x)), std::max(high_.y, static_cast<double>(p.y))};
      }
  }
  [[nodiscard]] Vec2d operator()(const Vec2f& p) const {
    const double side = std::max(high_.x - low_.x, high_.y - low_.y);
    const Vec2d middle = (low_ + high_) * 0.5;
    return {x_ + size_ * (0.5 + (static_cast<double>(p.x) - middle.x) / side),
            y_ + size_ * (0.5 - (static_cast<double>(p.y) - middle.y) / side)};
  }

 private:
  double x_, y_, size_;
  Vec2d low_, high_;
};

std::string node_name(const ChenCollapse& collapse, std::size_t node) {
  if (node == 0) return "u";
  if (node == 1) return "v";
  if (node <= collapse.ring) return "";
  return std::string(1, static_cast<char>('a' + node - collapse.ring - 1));
}

std::string named_dots(const ChenCollapse& collapse, const Panel& at, bool after, const char* suffix) {
  std::string svg;
  for (std::size_t n = 0; n < collapse.cells.nodes.size(); ++n) {
    const Vec2d p = at(after ? collapse.cells.nodes[n].after : collapse.cells.nodes[n].before);
    const bool ring = n > 0 && n <= collapse.ring;
    svg += svg_dot(p, ring ? 3 : 4, "fill=\"currentColor\"");
    const std::string name = node_name(collapse, n);
    if (!name.empty()) svg += svg_text(p.x + 8, p.y - 7, n == 1 ? name : name + suffix);
  }
  return svg;
}

/// Ring edges, then spokes of u or diagonals of v.
std::string ring_lines(const ChenCollapse& collapse, const Panel& at, bool spokes, bool diagonals, bool u_after) {
  const auto& nodes = collapse.cells.nodes;
  const auto corner = [&](std::size_t k) { return at(nodes[1 + k % collapse.ring].before); };
  std::string svg;
  for (std::size_t k = 0; k < collapse.ring; ++k) svg += svg_line(corner(k), corner(k + 1), "stroke=\"currentColor\" stroke-width=\"1.6\"");
  const Vec2d u = at(u_after ? nodes[0].after : nodes[0].before);
  for (std::size_t k = 0; spokes && k < collapse.ring; ++k) svg += svg_line(u, corner(k), "stroke=\"#0072b2\" stroke-width=\"2\"");
  for (std::size_t k = 2; diagonals && k + 1 < collapse.ring; ++k)
    svg += svg_line(corner(0), corner(k), "stroke=\"#d55e00\" stroke-width=\"2\" stroke-dasharray=\"7 4\"");
  return svg;
}

std::string cell_fill(const ChenCollapse& collapse, const Panel& at, bool after, bool numbered) {
  std::string svg;
  for (std::size_t c = 0; c < collapse.cells.cells.size(); ++c) {
    Vec2d p[3], middle(0, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const adapt::CellNode& node = collapse.cells.nodes[collapse.cells.cells[c][k]];
      p[k] = at(after ? node.after : node.before);
      middle += p[k] * (1.0 / 3);
    }
    svg += svg_triangle(
        p[0], p[1], p[2],
        fmt::format("fill=\"{}\" fill-opacity=\".5\" stroke=\"currentColor\" stroke-width=\"1\"", kHues[c % std::size(kHues)]));
    if (numbered) svg += svg_text(middle.x, middle.y + 4, std::to_string(c + 1), "middle");
  }
  return svg;
}

/// 1 for an equilateral triangle, 0 for a flat one.
double roundness(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const auto squared = [](const Vec2d& d) { return d.x * d.x + d.y * d.y; };
  constexpr double kTwoRoot3 = 3.4641016151377544;  // of twice the area over the sides' squares
  const double sides2 = squared(b - a) + squared(c - b) + squared(a - c);
  return sides2 > 0 ? kTwoRoot3 * std::abs(cross(b - a, c - a)) / sides2 : 0;
}

/// How well a collapse can be drawn: round cells of one size, and nodes that move by a part of the ring that can be seen.
double showing(const ChenCollapse& collapse) {
  const auto& nodes = collapse.cells.nodes;
  double least = 1, smallest = 1e300, area = 0, moved2 = 1e300, longest2 = 0;
  for (std::size_t k = 1; k <= collapse.ring; ++k)
    for (std::size_t l = 1; l < k; ++l) {
      const Vec2d d = Vec2d(nodes[k].before) - Vec2d(nodes[l].before);
      longest2 = std::max(longest2, d.x * d.x + d.y * d.y);
    }
  const double longest = std::sqrt(longest2);
  double off_diagonals = longest;  // u in the middle of a triangle: the general case
  for (std::size_t k = 3; k < collapse.ring; ++k)
    off_diagonals = std::min(off_diagonals, line_distance(Vec2d(nodes[0].after), Vec2d(nodes[1].after), Vec2d(nodes[k].after)));
  for (const auto& cell : collapse.cells.cells)
    for (const bool after : {false, true}) {
      const auto p = [&](std::size_t k) { return Vec2d(after ? nodes[cell[k]].after : nodes[cell[k]].before); };
      const double here = std::abs(cross(p(1) - p(0), p(2) - p(0)));
      least = std::min(least, roundness(p(0), p(1), p(2))), smallest = std::min(smallest, here), area += here / 2;
    }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (n > 0 && n <= collapse.ring) continue;
    const Vec2d d = Vec2d(nodes[n].after) - Vec2d(nodes[n].before);
    moved2 = std::min(moved2, d.x * d.x + d.y * d.y);
  }
  if (!(longest > 0) || !(area > 0)) return 0;
  return least * std::sqrt(smallest / area) * std::min(std::sqrt(moved2) / longest, 0.06) * std::min(off_diagonals / longest, 0.08) *
         std::min(1.0, 2 * area / longest2);
}

std::vector<Vec3d> positions_of(const progressive::ProgressiveMesh& mesh, const ChenCollapse& collapse) {
  const auto& data = mesh.data();
  const auto u = data.base_vertices + static_cast<std::uint32_t>(collapse.split);
  std::vector<Vec3d> positions(collapse.ring + 1, to_double(data.positions[u]));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto& wedges = mesh.face_wedges(f);
    if (std::none_of(wedges.begin(), wedges.end(), [&](std::uint32_t w) { return data.wedges[w].vertex.index == u; })) continue;
    for (const std::uint32_t w : wedges)
      for (std::size_t k = 1; k <= collapse.ring; ++k)
        if (data.wedges[w].uv == collapse.cells.nodes[k].before) positions[k] = to_double(data.positions[data.wedges[w].vertex.index]);
  }
  return positions;
}

}  // namespace

std::optional<ChenCollapse> showing_collapse(progressive::ProgressiveMesh& mesh, const adapt::AdaptSequence& sequence) {
  std::optional<ChenCollapse> best;
  for (std::size_t n = 0; n < sequence.size(); ++n) {
    const std::vector<adapt::ChartCells>& charts = sequence.split(n);
    if (charts.size() != 1 || charts.front().status != adapt::CellStatus::made) continue;
    ChenCollapse collapse;
    collapse.split = n, collapse.cells = charts.front().cells;
    const auto& nodes = collapse.cells.nodes;
    if (collapse.cells.u_kept < 1 || collapse.cells.crossings_kept < 1) continue;
    while (1 + collapse.ring < nodes.size() && nodes[1 + collapse.ring].before == nodes[1 + collapse.ring].after) ++collapse.ring;
    const std::size_t crossings = nodes.size() - 1 - collapse.ring;
    if (collapse.ring < 6 || collapse.ring > 8 || crossings < 2 || crossings > 5) continue;
    collapse.score = showing(collapse);
    if (best && collapse.score <= best->score) continue;
    if (collapse.score > 0) best = std::move(collapse);
  }
  if (best) {
    mesh.go_to(best->split + 1);
    best->positions = positions_of(mesh, *best);
  }
  return best;
}

std::string line_drawing(const ChenLineExample& line) {
  constexpr int kWidth = 1000;
  std::string svg = svg_open(kWidth, 330, "distortion and adaptation of the texture of a line");
  const char *blue = "stroke=\"#0072b2\" stroke-width=\"7\" stroke-linecap=\"butt\"",
             *orange = "stroke=\"#e69f00\" stroke-width=\"7\" stroke-linecap=\"butt\"";
  const auto panel = [&](double x, const char* title, double border, double share, bool original) {
    const auto at = [&](const Vec2d& p) { return Vec2d(x + 240 * p.x, 190 - 200 * p.y); };
    svg += svg_text(x + 120, 40, title, "middle");
    const Vec2d c(share, 0);
    if (original) {
      svg += svg_line(at(line.a), at(line.c), blue) + svg_line(at(line.c), at(line.b), orange);
    } else {
      svg += svg_line(at(line.a), at(line.c), "class=\"axis\" stroke-dasharray=\"5 5\"") +
             svg_line(at(line.c), at(line.b), "class=\"axis\" stroke-dasharray=\"5 5\"") + svg_line(at(line.a), at(c), blue) +
             svg_line(at(c), at(line.b), orange) + svg_line(at(line.c), at({line.c.x, 0}), "class=\"grid\" stroke-dasharray=\"3 4\"");
    }
    svg += svg_text(x - 8, 195, "A", "end") + svg_text(x + 248, 195, "B");
    svg += svg_text(at(line.c).x, at(line.c).y - 12, "C", "middle");
    const double y = 262;
    svg += svg_line({x, y}, {x + 240 * border, y}, "stroke=\"#0072b2\" stroke-width=\"16\"") +
           svg_line({x + 240 * border, y}, {x + 240, y}, "stroke=\"#e69f00\" stroke-width=\"16\"") + svg_text(x - 8, y + 5, "T", "end") +
           svg_text(x, y + 28, "0", "middle", "faint") +
           svg_text(x + 240 * border, y + 28, fmt::format("{:.2f}", border), "middle", "faint") +
           svg_text(x + 240, y + 28, "1", "middle", "faint");
  };
  panel(50, "AC, CB with texture T", line.c_before, line.c_before, true);
  panel(380, "AB, the texture as it is", line.c_before, line.c_before, false);
  panel(710, "AB, the texture adapted", line.c_after, line.c_after, false);
  return svg + "</svg>";
}

std::string neighbourhood_drawing(const ChenCollapse& collapse) {
  std::string svg = svg_open(1000, 700, "the neighbourhood of an edge in space and on the texture plane, before and after its collapse");
  // Seen against the mean normal, turned a little so that heights show.
  Vec3d normal(0, 0, 0), middle(0, 0, 0);
  const auto& p = collapse.positions;
  for (std::size_t k = 1; k <= collapse.ring; ++k) {
    normal += cross_product(p[k] - p[0], p[k % collapse.ring + 1] - p[0]);
    middle += p[k] * (1.0 / static_cast<double>(collapse.ring));
  }
  const auto unit = [](const Vec3d& a) { return a * (1 / std::sqrt(dot_product(a, a))); };
  const Vec3d n = unit(normal), side = unit(cross_product(n, p[1] - p[0])), eye = unit(n + side * 0.9),
              right = unit(cross_product(side, n)), up = cross_product(eye, right) * 1.0;
  double reach = 0;
  for (const Vec3d& q : p) reach = std::max({reach, std::abs(dot_product(q - middle, right)), std::abs(dot_product(q - middle, up))});
  const auto in_space = [&](double x, std::size_t k) {
    const Vec3d d = p[k] - middle;
    return Vec2d(x + 150 * dot_product(d, right) / reach, 185 + 150 * dot_product(d, up) / reach);
  };
  const Vec3d light = unit(n + right * 0.5 - up * 0.4);
  const auto face = [&](double x, std::size_t a, std::size_t b, std::size_t c) {
    const Vec3d m = unit(cross_product(p[b] - p[a], p[c] - p[a]));
    const int grey = static_cast<int>(90 + 150 * std::abs(dot_product(m, light)));
    svg += svg_triangle(in_space(x, a), in_space(x, b), in_space(x, c),
                        fmt::format("fill=\"rgb({0},{0},{0})\" stroke=\"#333\" stroke-width=\"1.2\"", std::min(grey, 255)));
  };
  for (std::size_t k = 1; k <= collapse.ring; ++k) face(250, 0, k, k % collapse.ring + 1);
  for (std::size_t k = 2; k + 1 <= collapse.ring; ++k) face(750, 1, k, k + 1);
  svg += svg_line(in_space(250, 0), in_space(250, 1), "stroke=\"#d55e00\" stroke-width=\"3\"");
  for (const double x : {250.0, 750.0}) {
    const Vec2d v = in_space(x, 1);
    svg += svg_dot(v, 4, "fill=\"currentColor\"") + svg_text(v.x + 9, v.y - 8, "V");
  }
  const Vec2d u = in_space(250, 0);
  svg += svg_dot(u, 4, "fill=\"currentColor\"") + svg_text(u.x + 9, u.y - 8, "U");
  svg += svg_text(250, 22, "in space, before", "middle") + svg_text(750, 22, "in space, after U → V", "middle");
  const Panel left(collapse, 110, 385, 280), right_panel(collapse, 610, 385, 280);
  svg += ring_lines(collapse, left, true, false, false) + ring_lines(collapse, right_panel, false, true, false);
  const Vec2d uv = left(collapse.cells.nodes[0].before), v1 = left(collapse.cells.nodes[1].before),
              v2 = right_panel(collapse.cells.nodes[1].before);
  svg += svg_dot(uv, 4, "fill=\"currentColor\"") + svg_text(uv.x + 8, uv.y - 7, "u") + svg_dot(v1, 4, "fill=\"currentColor\"") +
         svg_text(v1.x + 8, v1.y - 7, "v") + svg_dot(v2, 4, "fill=\"currentColor\"") + svg_text(v2.x + 8, v2.y - 7, "v");
  svg += svg_text(250, 692, "on the texture plane, before", "middle", "faint") +
         svg_text(750, 692, "on the texture plane, after", "middle", "faint");
  return svg + "</svg>";
}

std::string overlay_drawing(const ChenCollapse& made) {
  const ChenCollapse collapse = as_overlay(made);
  std::string svg = svg_open(1000, 400, "the edges before and after over each other, and the cells they make");
  const Panel left(collapse, 90, 30, 320), right(collapse, 590, 30, 320);
  svg += ring_lines(collapse, left, true, true, true) + named_dots(collapse, left, true, "");
  svg += cell_fill(collapse, right, true, true);
  svg += svg_text(250, 390, "edges before (solid) and after (dashed)", "middle", "faint") +
         svg_text(750, 390, fmt::format("{} cells", collapse.cells.cells.size()), "middle", "faint");
  return svg + "</svg>";
}

std::string correspondence_drawing(const ChenCollapse& collapse) {
  std::string svg = svg_open(1000, 400, "the same cells in both textures");
  const Panel left(collapse, 90, 30, 320), right(collapse, 590, 30, 320);
  svg += cell_fill(collapse, left, false, true) + named_dots(collapse, left, false, "");
  svg += cell_fill(collapse, right, true, true) + named_dots(collapse, right, true, "′");
  svg += svg_text(250, 390, "before the collapse: u's edges are straight", "middle", "faint") +
         svg_text(750, 390, "after it: v's edges are straight", "middle", "faint");
  return svg + "</svg>";
}

std::string fan_drawing(const ChenCollapse& collapse) {
  // Cells at u make a fan; the others are taken up in strips, each going on over a shared edge to the lowest cell that is left.
  const auto& cells = collapse.cells.cells;
  std::vector<int> strip(cells.size(), -1);  // 0: the fan
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (std::find(cells[c].begin(), cells[c].end(), 0) != cells[c].end()) strip[c] = 0;
  const auto shared = [&](std::size_t a, std::size_t b) {
    return std::count_if(cells[a].begin(), cells[a].end(),
                         [&](std::uint16_t n) { return std::find(cells[b].begin(), cells[b].end(), n) != cells[b].end(); });
  };
  int strips = 0;
  std::vector<std::vector<std::size_t>> order;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (strip[c] >= 0) continue;
    order.emplace_back();
    ++strips;
    for (std::size_t at = c; at < cells.size();) {
      strip[at] = strips, order.back().push_back(at);
      std::size_t next = 0;
      while (next < cells.size() && (strip[next] >= 0 || shared(at, next) != 2)) ++next;
      at = next;
    }
  }
  std::string svg = svg_open(1000, 420, "the cells as a triangle fan and triangle strips");
  const Panel panel(collapse, 90, 30, 340);
  const auto middle = [&](std::size_t c) {
    Vec2d sum(0, 0);
    for (const std::uint16_t n : cells[c]) sum += panel(collapse.cells.nodes[n].after) * (1.0 / 3);
    return sum;
  };
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto p = [&](std::size_t k) { return panel(collapse.cells.nodes[cells[c][k]].after); };
    svg += svg_triangle(p(0), p(1), p(2),
                        fmt::format("fill=\"{}\" fill-opacity=\".55\" stroke=\"currentColor\" stroke-width=\"1\"",
                                    kHues[static_cast<std::size_t>(strip[c]) % std::size(kHues)]));
  }
  for (const auto& way : order)
    for (std::size_t k = 0; k < way.size(); ++k) {
      svg += svg_dot(middle(way[k]), 3, "fill=\"currentColor\"");
      if (k > 0) svg += svg_line(middle(way[k - 1]), middle(way[k]), "stroke=\"currentColor\" stroke-width=\"2\"");
    }
  const Vec2d u = panel(collapse.cells.nodes[0].after);
  svg += svg_dot(u, 4, "fill=\"currentColor\"") + svg_text(u.x + 8, u.y - 7, "u′");
  std::size_t in_fan = 0, in_strips = 0;
  for (const int s : strip) in_fan += s == 0;
  for (const auto& way : order) in_strips += way.size() + 2;
  double y = 90;
  const auto legend = [&](const std::string& words, const char* hue) {
    if (hue != nullptr)
      svg += fmt::format("<rect x=\"520\" y=\"{:.1f}\" width=\"18\" height=\"18\" fill=\"{}\" fill-opacity=\".55\"/>", y - 14, hue);
    svg += svg_text(hue != nullptr ? 550 : 520, y, words);
    y += 34;
  };
  legend(fmt::format("a fan around u: {} cells, {} vertices", in_fan, in_fan + 2), kHues[0]);
  for (std::size_t s = 0; s < order.size(); ++s)
    legend(fmt::format("a strip: {} cell{}, {} vertices", order[s].size(), order[s].size() == 1 ? "" : "s", order[s].size() + 2),
           kHues[(s + 1) % std::size(kHues)]);
  y += 10;
  legend(fmt::format("fan and strips send {} vertices,", in_fan + 2 + in_strips), nullptr);
  legend(fmt::format("separate triangles {},", 3 * cells.size()), nullptr);
  legend(fmt::format("indexed triangles {} and {} indices.", collapse.cells.nodes.size(), 3 * cells.size()), nullptr);
  return svg + "</svg>";
}

std::string blur_drawing() {
  static constexpr int kTexels = 8, kCell = 40, kLeft = 170;
  // Two texels become one: coordinates (2i + 1)/8, half way between their centres.
  constexpr int kRow[kTexels] = {0, 255, 255, 0, 0, 255, 0, 255};
  std::string svg = svg_open(1000, 330, "what half as many texels show, by adapted texels and by adapted coordinates");
  const auto row = [&](double y, const std::string& name, int count, double width, const auto& value) {
    svg += svg_text(kLeft - 14, y + 25, name, "end");
    for (int i = 0; i < count; ++i) {
      const int grey = value(i);
      svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"rgb({},{},{})\" {}/>", kLeft + i * width, y,
                         width, kCell, grey, grey, grey, width > kCell ? "class=\"axis\"" : "");
    }
  };
  row(10, "T", kTexels, 2 * kCell, [&](int i) { return kRow[i]; });
  const auto mean = [&](int i) { return (kRow[2 * i] + kRow[2 * i + 1] + 1) / 2; };
  row(80, "T′, adapted", kTexels / 2, 4 * kCell, mean);
  svg += svg_text(kLeft - 14, 175, "I′, adapted", "end");
  for (int i = 0; i < kTexels / 2; ++i) {
    svg += fmt::format("<rect x=\"{}\" y=\"150\" width=\"{}\" height=\"{}\" fill=\"none\" class=\"axis\"/>", kLeft + i * 4 * kCell,
                       4 * kCell, kCell);
    svg += svg_text(kLeft + (i + 0.5) * 4 * kCell, 175, fmt::format("{}/{}", 2 * i + 1, kTexels), "middle");
  }
  // Drawn on 32 samples: through the map the coordinate is interpolated, then the texture is looked up; both linear.
  constexpr int kSamples = 64;
  const auto linear = [](double at, int count, const auto& value) {
    const double t = at * count - 0.5;
    const int i = static_cast<int>(std::floor(t));
    const double f = t - i;
    return value(std::clamp(i, 0, count - 1)) * (1 - f) + value(std::clamp(i + 1, 0, count - 1)) * f;
  };
  const double wide = 2.0 * kCell * kTexels / kSamples;
  row(210, "through T′", kSamples, wide, [&](int s) { return static_cast<int>(linear((s + 0.5) / kSamples, kTexels / 2, mean) + 0.5); });
  row(270, "through I′, T", kSamples, wide, [&](int s) {
    const double u = linear((s + 0.5) / kSamples, kTexels / 2, [](int i) { return (2.0 * i + 1) / kTexels; });
    return static_cast<int>(linear(u, kTexels, [&](int i) { return static_cast<double>(kRow[i]); }) + 0.5);
  });
  return svg + "</svg>";
}

}  // namespace etalon::validation
