#include "validation/studies/soucy_drawings.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/draw/scene.h"
#include "core/procedural/duck.h"
#include "validation/studies/svg.h"
#include "validation/studies/texel_canvas.h"

namespace etalon::validation {
namespace {

constexpr const char* kThin = "fill=\"none\" class=\"axis\"";
constexpr const char* kBold = "fill=\"none\" stroke=\"currentColor\" stroke-width=\"2\"";

std::string filled(const std::string& color) { return "fill=\"" + color + "\" class=\"axis\""; }
std::string rgb(const std::uint8_t* c) { return fmt::format("rgb({},{},{})", c[0], c[1], c[2]); }

Mesh flat_mesh(const std::vector<Vec2f>& places, const std::vector<std::array<std::uint32_t, 3>>& faces) {
  Mesh mesh;
  for (const Vec2f& p : places) mesh.positions.push_back({p.x, p.y, 0});
  for (std::uint32_t v = 0; v < places.size(); ++v) mesh.wedges.push_back({VertexId(v), {0, 0}});
  for (const auto& f : faces) mesh.faces.push_back({WedgeId(f[0]), WedgeId(f[1]), WedgeId(f[2])});
  return mesh;
}

/// All texels of a triangle on the map, white, and its outline.
std::string blank_triangle(const bake::Tile& tile, const TexelCanvas& canvas) {
  std::string svg;
  bake::for_each_texel(tile.size, [&](int i, int j) { svg += canvas.texel(i, j, kThin); });
  return svg;
}

/// Places of the tiling, tiles coloured by size, rectangles numbered in the order in which they were placed.
std::string map_drawing(const bake::Atlas& atlas, const Vec2d& origin, double scale, bool numbered) {
  std::string svg;
  std::vector<std::uint32_t> order(atlas.tiles.size());
  for (std::uint32_t f = 0; f < order.size(); ++f) order[f] = f;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return atlas.tiles[a].size > atlas.tiles[b].size; });
  int number = 0;
  for (const std::uint32_t f : order) {
    const bake::Tile& tile = atlas.tiles[f];
    const TexelCanvas canvas(tile, origin, scale);
    std::size_t hue = 0;
    for (int d = tile.size; d > 2; d /= 2) ++hue;
    bake::for_each_texel(tile.size, [&](int i, int j) {
      svg += canvas.texel(i, j, fmt::format("fill=\"{}\" fill-opacity=\"{}\" class=\"axis\"", drawing_hue(hue), tile.turned ? 0.5 : 0.22));
    });
    svg += canvas.outline("fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.3\"");
    if (!tile.turned || !numbered) continue;
    const Vec2d a = canvas.at(0, 0);  // of the turned half: the rectangle's upper right corner
    svg +=
        svg_text(a.x - scale * (tile.size > 2 ? 0.75 : 0.5) - 2, a.y + 14 + (tile.size > 2 ? 4 : 0), fmt::format("{}", ++number), "middle");
  }
  return svg;
}

}  // namespace

std::string lookup_drawing(Renderer& exact) {
  // A map with one rectangle of size 4; the triangle shown is its lower left half.
  const bake::Atlas atlas = bake::make_atlas(std::vector<double>{4, 4}, 4, 5);
  const bake::Tile& tile = atlas.tiles[1];
  auto map = std::make_shared<Image>(4, 5, kRgb8);
  bake::for_each_texel(tile.size, [&](int i, int j) {
    const auto [x, y] = tile.place(i, j);
    auto* c = map->channels<std::uint8_t>(x, y);
    c[0] = static_cast<std::uint8_t>(90 + 50 * i), c[1] = static_cast<std::uint8_t>(110 + (i + j) % 2 * 90),
    c[2] = static_cast<std::uint8_t>(70 + 55 * j);
  });
  constexpr int kWidth = 13, kHeight = 10;
  Frame frame{.width = kWidth, .height = kHeight, .guard = 2048, .state = {}, .targets = {}};
  frame.targets = {
      {TargetContent::color, kRgba8, {0, 0, 0, 1}}, {TargetContent::triangle_id, kR32ui, {}}, {TargetContent::coordinate, kRg32f, {}}};
  const std::array<Vec2d, 3> corners{Vec2d(1.3, 1.4), Vec2d(11.8, 2.7), Vec2d(4.6, 9.1)};
  DrawList list;
  for (int k = 0; k < 3; ++k) {
    const Vec2d uv = bake::corner_place(tile, k, bake::drawn_in_share(atlas));
    RasterVertex v;
    v.x = snap(corners[static_cast<std::size_t>(k)].x, frame.state), v.y = snap(corners[static_cast<std::size_t>(k)].y, frame.state);
    v.uv = {static_cast<float>(uv.x / atlas.width), static_cast<float>(uv.y / atlas.height)};
    list.vertices.push_back(v);
  }
  list.triangles = {{0, 1, 2}};
  list.images = {map};
  list.draws = {{.triangle_count = 1, .shading = Shading::texture, .texture = 0, .sampler = {Filter::nearest, Wrap::clamp, Wrap::clamp}}};
  const std::vector<Image> drawn = exact.render(list, frame);

  std::string svg = svg_open(1000, 400, "a triangle's pixels and its texels");
  const double px = 32;
  const auto place = [&](double x, double y) { return Vec2d(40 + px * x, 355 - px * y); };
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool covered = *drawn[1].channels<std::uint32_t>(x, y) != kNoTriangle;
      const Vec2d a = place(x, y + 1);
      svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\" class=\"axis\"/>", a.x, a.y, px, px,
                         covered ? rgb(drawn[0].channels<std::uint8_t>(x, y)) : "none");
    }
  svg += svg_triangle(place(corners[0].x, corners[0].y), place(corners[1].x, corners[1].y), place(corners[2].x, corners[2].y), kBold);
  const Vec2d origin(620, 345);
  constexpr double kTexel = 62;
  const TexelCanvas canvas(tile, origin, kTexel);
  bake::for_each_texel(tile.size, [&](int i, int j) {
    const auto [x, y] = tile.place(i, j);
    svg += canvas.texel(i, j, filled(rgb(map->channels<std::uint8_t>(x, y))));
    svg += svg_dot(canvas.center(i, j), 2.5, "fill=\"currentColor\"");
  });
  svg += canvas.outline(kBold);
  constexpr int kShownX = 6, kShownY = 4;
  const float* uv = drawn[2].channels<float>(kShownX, kShownY);
  const Vec2d from = place(kShownX + 0.5, kShownY + 0.5),
              to(origin.x + kTexel * uv[0] * atlas.width, origin.y - kTexel * uv[1] * atlas.height);
  svg += svg_line(from, to, "stroke=\"currentColor\" stroke-width=\"1.6\" stroke-dasharray=\"6 4\"") +
         svg_dot(from, 4, "fill=\"currentColor\"") + svg_dot(to, 5, "fill=\"#fff\" stroke=\"#000\"");
  for (int k = 0; k < 3; ++k) {
    const Vec2d p = place(corners[static_cast<std::size_t>(k)].x, corners[static_cast<std::size_t>(k)].y);
    svg += svg_text(p.x + (k == 1 ? 8 : -6), p.y + (k == 2 ? -7 : 19), fmt::format("p{}", k + 1), k == 1 ? "start" : "end");
  }
  return svg + svg_text(250, 392, "pixels: colour of the nearest texel centre", "middle", "faint") +
         svg_text(745, 392, fmt::format("the texture triangle; the pixel is looked up at ({:.2f}, {:.2f})", uv[0] * 4, uv[1] * 5), "middle",
                  "faint") +
         "</svg>";
}

std::string adjacent_drawing() {
  // Longest edges 3.68 and 2, the common one: sizes 4 and 2 at a spacing of 1. A second pair, not shown, makes both classes even.
  const Mesh mesh = flat_mesh({{0, 0}, {2, 0}, {0.6f, 3.4f}, {1, -1.6f}, {9, 0}, {11, 0}, {9.6f, 3.4f}, {10, -1.6f}},
                              {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}, {5, 4, 7}});
  const bake::Atlas atlas = bake::make_atlas(mesh, 1.0, 8, 9);
  const bake::TexelNodes nodes(mesh, atlas);
  std::string svg = svg_open(1000, 360, "two adjacent triangles and their texels");
  const auto at = [&](std::uint32_t v) { return Vec2d(110 + 62 * mesh.positions[v].x, 230 - 62 * mesh.positions[v].y); };
  for (std::uint32_t f = 0; f < 2; ++f) {
    const Vec2d a = at(mesh.vertex(FaceId(f), 0).index), b = at(mesh.vertex(FaceId(f), 1).index), c = at(mesh.vertex(FaceId(f), 2).index);
    svg += svg_triangle(a, b, c,
                        fmt::format("fill=\"{}\" fill-opacity=\"0.15\" stroke=\"currentColor\" stroke-width=\"2\"", drawing_hue(4 + f)));
    svg += svg_text((a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3 + 5, f == 0 ? "Ta" : "Tb", "middle");
  }
  svg += svg_text(at(0).x - 9, at(0).y + 5, "t1", "end") + svg_text(at(1).x + 9, at(1).y + 5, "t2");
  svg += svg_text(170, 350, "in space", "middle", "faint");
  std::vector<std::uint32_t> groups;  // in order of first sight, along the edge
  for (std::uint32_t f = 0; f < 2; ++f) {
    const bake::Tile& tile = atlas.tiles[f];
    bake::Tile lone = tile;  // each by itself, at the drawing's own place
    lone.x = lone.y = 0, lone.turned = false;
    const TexelCanvas canvas(lone, Vec2d(f == 0 ? 380 : 770, 310), 64);
    svg += blank_triangle(tile, canvas);
    std::string names;
    for (int step = 0; step < tile.size; ++step) {
      const auto [i, j] = f == 0 ? tile.side_texel(0, 1, step) : tile.side_texel(1, 0, step);  // both from t1 to t2
      const std::uint32_t group = nodes.group_of(nodes.texel(f, tile.size, i, j));
      auto known = std::find(groups.begin(), groups.end(), group);
      if (known == groups.end()) known = groups.insert(groups.end(), group);
      svg += canvas.texel(
          i, j,
          fmt::format("fill=\"{}\" fill-opacity=\"0.6\" class=\"axis\"", drawing_hue(static_cast<std::size_t>(known - groups.begin()))));
      names += svg_text(canvas.center(i, j).x, canvas.center(i, j).y + 5, fmt::format("t{}{}", f == 0 ? "a" : "b", step + 1), "middle");
    }
    svg += names + canvas.outline(kBold) +
           svg_text(f == 0 ? 500 : 840, 350, fmt::format("T{} in the map: size {}", f == 0 ? "a" : "b", tile.size), "middle", "faint");
  }
  return svg + "</svg>";
}

std::string projection_drawing() {
  Mesh duck = procedural::make_duck(procedural::duck_of_faces(4000, false));
  const simplify::SimplifyResult simplified = simplify::simplify_mesh(duck, {.target_faces = 700, .record_landings = true});
  const Mesh& mesh = simplified.mesh;
  const bake::Atlas atlas = bake::make_atlas(mesh, bake::mean_edge_length(duck), 256, 256);
  const bake::TexelNodes nodes(mesh, atlas);
  const bake::TexelColors colors = bake::average_colors(atlas, nodes, duck.colors, simplified.landings);
  // Of triangles with ten texels and eight of them hit that in which vertices of its own fell into most, and of these the one with fewest.
  std::vector<std::vector<std::uint32_t>> fallen(mesh.face_count());
  for (const Landing& landing : simplified.landings) {
    if (!landing.face.valid()) continue;
    const bake::Tile& on = atlas.tiles[landing.face.index];
    const auto [i, j] = on.nearest_texel(landing.weights);
    fallen[landing.face.index].push_back(nodes.texel(landing.face.index, on.size, i, j));
  }
  std::uint32_t face = 0;
  std::pair<std::ptrdiff_t, std::ptrdiff_t> best{-1, 0};
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (atlas.tiles[f].size != 4) continue;
    std::ptrdiff_t hit = 0, own = 0;
    for (std::uint32_t t = nodes.first(f); t < nodes.first(f) + 10; ++t)
      hit += colors.is_hit(t), own += std::find(fallen[f].begin(), fallen[f].end(), t) != fallen[f].end();
    const std::pair candidate{own, -static_cast<std::ptrdiff_t>(fallen[f].size())};
    if (hit == 8 && candidate > best) best = candidate, face = f;
  }
  bake::Tile tile = atlas.tiles[face];
  tile.x = tile.y = 0, tile.turned = false;
  const TexelCanvas canvas(tile, Vec2d(330, 350), 78);
  std::string svg = svg_open(1000, 400, "vertices of the scan on a texture triangle");
  svg +=
      "<defs><pattern id=\"hatch\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">"
      "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"8\" class=\"axis\"/></pattern></defs>";
  std::size_t hit_texels = 0;
  bake::for_each_texel(tile.size, [&](int i, int j) {
    const std::uint32_t t = nodes.texel(face, tile.size, i, j);
    hit_texels += colors.is_hit(t);
    svg += canvas.texel(i, j, colors.is_hit(t) ? filled(rgb(colors.color[t].data())) : "fill=\"url(#hatch)\" class=\"axis\"");
    svg += svg_dot(canvas.center(i, j), 2, "fill=\"currentColor\"");
  });
  svg += canvas.outline(kBold);
  const auto mark = [&](const Vec2d& p) {
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"9\" fill=\"#fff\" stroke=\"#000\"/>", p.x - 4.5, p.y - 4.5);
  };
  for (const Landing& landing : simplified.landings) {
    if (landing.face.index != face) continue;
    const double w[] = {landing.weights.x, landing.weights.y, landing.weights.z};
    mark(canvas.at(w[(tile.right_corner + 1) % 3] * tile.size, w[(tile.right_corner + 2) % 3] * tile.size));
  }
  constexpr int kCorner[3][2] = {{0, 0}, {4, 0}, {0, 4}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2d p = canvas.at(kCorner[k][0], kCorner[k][1]);
    mark(p);
    svg += svg_text(p.x + (k == 1 ? 10 : -10), p.y + 18, fmt::format("p{}", k + 1), k == 1 ? "start" : "end");
  }
  return svg +
         svg_text(500, 392,
                  fmt::format("ten texels: {} hit, {} empty; vertices of the scan as white squares; texels on the sides have the colour of "
                              "all that their neighbours'"
                              " equal texels received",
                              hit_texels, 10 - hit_texels),
                  "middle", "faint") +
         "</svg>";
}

std::string pairing_drawing() {
  std::string svg = svg_open(1000, 330, "half-square triangles paired to rectangles");
  const bake::Atlas small = bake::make_atlas(std::vector<double>{2, 2}, 2, 3), large = bake::make_atlas(std::vector<double>{4, 4}, 4, 5);
  svg += map_drawing(small, Vec2d(240, 280), 50, false) + map_drawing(large, Vec2d(600, 280), 50, false);
  return svg + svg_text(290, 318, "a: size 2, a 2 × 3 rectangle", "middle", "faint") +
         svg_text(700, 318, "b: size 4, a 4 × 5 rectangle", "middle", "faint") + "</svg>";
}

std::string tiling_drawing() {
  std::vector<double> ratios;
  for (const auto& [size, count] : {std::pair(4, 10), std::pair(16, 2), std::pair(8, 6), std::pair(2, 23)})
    ratios.insert(ratios.end(), static_cast<std::size_t>(count), size);
  const bake::Atlas atlas = bake::make_atlas(ratios, 32, 24);
  std::string svg = svg_open(1000, 470, "a tiled map");
  constexpr double kTexel = 18;
  const Vec2d origin(210, 440);
  svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>", origin.x, origin.y - kTexel * atlas.height,
                     kTexel * atlas.width, kTexel * atlas.height, kBold);
  return svg + map_drawing(atlas, origin, kTexel, true) +
         svg_text(500, 462, fmt::format("{} triangles in {} × {} texels", atlas.tiles.size(), atlas.width, atlas.height), "middle",
                  "faint") +
         "</svg>";
}

std::string reclassification_drawing() {
  const std::vector<double> ratios{17.5, 11, 31, 29, 14.8, 15.5, 7.6, 6.1};
  std::vector<bake::SizeStep> steps;
  const bake::TriangleSizes sizes = bake::choose_sizes(ratios, 32, 33, [&](const bake::SizeStep& step) { steps.push_back(step); });
  std::string svg = svg_open(1000, 380, "triangles go to lower classes");
  const auto column = [](std::size_t n) { return 150 + 108.0 * static_cast<double>(n); };
  const auto level = [](int size) {
    int rank = 0;
    for (int d = size; d > 2; d /= 2) ++rank;
    return 320 - 70.0 * rank;
  };
  for (int size = 2; size <= 32; size *= 2)
    svg += svg_line({100, level(size)}, {970, level(size)}, "class=\"grid\"") +
           svg_text(90, level(size) + 5, fmt::format("{}", size), "end", "faint");
  std::vector<int> now;
  for (std::size_t n = 0; n < ratios.size(); ++n) {
    now.push_back(bake::wanted_size(ratios[n], bake::largest_size(32, 33)));
    svg += svg_dot({column(n), level(now[n])}, 6, "fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.6\"") +
           svg_text(column(n), 358, fmt::format("{}{:g}", n < 2 ? fmt::format("T{}: ", n + 1) : "", ratios[n]), "middle");
  }
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const std::size_t n = steps[s].face.index;
    const double x = column(n), from = level(steps[s].from), to = level(steps[s].from / 2);
    svg += svg_line({x, from + 6}, {x, to - 7}, fmt::format("stroke=\"{}\" stroke-width=\"2.4\"", drawing_hue(0))) +
           svg_text(x + 8, (from + to) / 2 + 5, fmt::format("{}: {:.4g}", s + 1, steps[s].proximity));
    now[n] = steps[s].from / 2;
  }
  for (std::size_t n = 0; n < ratios.size(); ++n) {
    if (sizes.sizes[n] != now[n])  // for the sake of even classes
      svg += svg_line({column(n), level(now[n]) + 6}, {column(n), level(sizes.sizes[n]) - 7},
                      "stroke=\"currentColor\" stroke-width=\"1.6\" stroke-dasharray=\"5 4\"");
    svg += svg_dot({column(n), level(sizes.sizes[n])}, 6, "fill=\"currentColor\"");
  }
  return svg + svg_text(535, 377, "E_max / D_i of each triangle", "middle", "faint") + "</svg>";
}

}  // namespace etalon::validation
