#include "validation/selftest/geometry_scenes.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/selftest/scene_parts.h"

namespace etalon::validation {
namespace {

using W = VertexRange::W;

const std::vector<TargetSpec> kColor{{TargetContent::color, kRgba8, {0.25f, 0.5f, 0.75f, 1}}};
const std::vector<TargetSpec> kColorAndId{{TargetContent::color, kRgba8, {0.25f, 0.5f, 0.75f, 1}}, {TargetContent::triangle_id, kR32ui}};

void open_textured_draw(DrawList& list, Rng& rng, Filter filter, PixelFormat format = kRgba8, int width = 32, int height = 32) {
  const std::uint32_t texture = add_image(list, noise_image(width, height, format, rng));
  Draw& draw = open_draw(list, Shading::texture);
  draw.texture = texture;
  draw.sampler = random_sampler(rng, filter);
}

}  // namespace

SceneFamily grid_scenes() {
  SceneFamily family{"grids", {}};
  std::uint64_t seed = 6000;
  for (int bits = 1; bits <= 16; ++bits)
    for (const FillRule rule : {FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax})
      for (const bool depth_test : {true, false}) {
        Rng rng(seed++);
        FixedScene scene{
            fmt::format("{} bits, {}, depth test {}", bits, to_string(rule), depth_test ? "on" : "off"), {}, {27, 19, 64, {}, kColorAndId}};
        RasterState& state = scene.frame.state;
        state.subtexel_bits = bits;
        state.fill_rule = rule;
        state.depth_test = depth_test;
        state.cull = static_cast<CullMode>(rng.below(3));
        // Shared vertices on a coarse lattice: edges through samples, and edges in common.
        for (int n = 0; n < 14; ++n)
          scene.list.vertices.push_back(random_vertex(rng, scene.frame, {.reach_texel = 8, .on_lattice = n < 12}));
        for (const Shading shading : {Shading::vertex_color, Shading::texture}) {
          if (shading == Shading::texture)
            open_textured_draw(scene.list, rng, rng.coin() ? Filter::linear : Filter::nearest);
          else
            open_draw(scene.list, shading);
          const auto any = [&] { return static_cast<std::uint32_t>(rng.below(scene.list.vertices.size())); };
          for (int t = 0; t < 10; ++t) scene.list.triangles.push_back({any(), any(), any()});
          scene.list.draws.back().triangle_count = 10;
        }
        family.scenes.push_back(std::move(scene));
      }
  return family;
}

SceneFamily far_scenes() {
  SceneFamily family{"far", {}};
  std::uint64_t seed = 7000;
  struct Size {
    int width, height;
  };
  for (const Size size : {Size{64, 48}, Size{4001, 3}, Size{16384, 1}, Size{2, 16384}})
    for (const int bits : {1, 4, 8, 12, 16})
      for (const W w : {W::one, W::perspective}) {
        Rng rng(seed++);
        FixedScene scene{fmt::format("{}x{}, {} bits, w {}", size.width, size.height, bits, static_cast<int>(w)), {}, {}};
        scene.frame = {size.width, size.height, (16384 - std::max(size.width, size.height)) / 2, {}, kColor};
        scene.frame.state.subtexel_bits = bits;
        if (size.width == 64) scene.frame.targets = all_targets();
        const VertexRange range{.w = w, .reach_texel = 16384};
        open_textured_draw(scene.list, rng, Filter::nearest);
        add_cover(scene.list, rng, scene.frame, range);
        add_random_triangles(scene.list, rng, scene.frame, range, 4);
        open_textured_draw(scene.list, rng, Filter::linear, {ChannelType::srgb8, 3}, 29, 17);
        add_random_triangles(scene.list, rng, scene.frame, range, 4);
        open_draw(scene.list, Shading::vertex_color);
        add_random_triangles(scene.list, rng, scene.frame, range, 4);
        family.scenes.push_back(std::move(scene));
      }
  return family;
}

namespace {

// A sheet of columns × rows cells of half a texel whose vertices are moved at random, each cell two triangles.
void add_sheet(FixedScene& scene, Rng& rng, int columns, int rows, const VertexRange& range) {
  DrawList& list = scene.list;
  const auto first = static_cast<std::uint32_t>(list.vertices.size());
  const int bits = scene.frame.state.subtexel_bits;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      RasterVertex vertex = random_vertex(rng, scene.frame, range);
      const auto moved = [&](int at) {
        return static_cast<std::int32_t>((std::int64_t{at} << (bits - 1)) +
                                         rng.between(-(std::int64_t{1} << (bits - 2)), std::int64_t{1} << (bits - 2)));
      };
      vertex.x = moved(x);
      vertex.y = moved(y);
      vertex.uv = Vec2f{static_cast<float>(x) / 64, static_cast<float>(y) / 64};
      list.vertices.push_back(vertex);
    }
  const auto stride = static_cast<std::uint32_t>(columns) + 1;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const std::uint32_t at = first + static_cast<std::uint32_t>(y) * stride + static_cast<std::uint32_t>(x);
      list.triangles.push_back({at, at + 1, at + stride + 1});
      list.triangles.push_back({at, at + stride + 1, at + stride});
      list.draws.back().triangle_count += 2;
    }
}

}  // namespace

SceneFamily tiny_scenes() {
  SceneFamily family{"tiny", {}};
  std::uint64_t seed = 8000;
  for (const int bits : {4, 8, 16})
    for (const W w : {W::one, W::perspective}) {
      Rng rng(seed++);
      FixedScene scene{fmt::format("sheets, {} bits, w {}", bits, static_cast<int>(w)), {}, {71, 53, 64, {}, kColorAndId}};
      scene.frame.state.subtexel_bits = bits;
      open_textured_draw(scene.list, rng, Filter::nearest);
      add_sheet(scene, rng, 140, 100, {.w = w});
      open_draw(scene.list, Shading::vertex_color);
      add_sheet(scene, rng, 60, 40, {.w = w});
      open_textured_draw(scene.list, rng, Filter::linear);
      add_sheet(scene, rng, 40, 104, {.w = w});
      family.scenes.push_back(std::move(scene));

      FixedScene soup{fmt::format("soup, {} bits, w {}", bits, static_cast<int>(w)), {}, {67, 59, 64, {}, kColorAndId}};
      soup.frame.state.subtexel_bits = bits;
      open_draw(soup.list, Shading::vertex_color);
      for (int t = 0; t < 4000; ++t) {
        std::array<RasterVertex, 3> corner;
        for (RasterVertex& vertex : corner) vertex = random_vertex(rng, soup.frame, {.w = w});
        const std::int64_t reach = std::int64_t{2} << bits;
        for (std::size_t k = 1; k < 3; ++k) {
          corner[k].x = static_cast<std::int32_t>(corner[0].x + rng.between(-reach, reach));
          corner[k].y = static_cast<std::int32_t>(corner[0].y + rng.between(-reach, reach));
        }
        add_triangle(soup.list, corner[0], corner[1], corner[2]);
      }
      family.scenes.push_back(std::move(soup));
    }
  return family;
}

SceneFamily sliver_scenes() {
  SceneFamily family{"slivers", {}};
  std::uint64_t seed = 9000;
  for (const int bits : {1, 8, 16})
    for (const W w : {W::one, W::perspective, W::wild})
      for (const Shading shading : {Shading::vertex_color, Shading::texture}) {
        Rng rng(seed++);
        FixedScene scene{fmt::format("{} bits, w {}, {}", bits, static_cast<int>(w), shading == Shading::texture ? "nearest" : "colour"),
                         {},
                         {83, 61, 2048, {}, kColorAndId}};
        scene.frame.state.subtexel_bits = bits;
        scene.frame.targets.push_back({TargetContent::coordinate, kRg32f});
        if (shading == Shading::texture)
          open_textured_draw(scene.list, rng, Filter::nearest);
        else
          open_draw(scene.list, shading);
        const VertexRange range{.w = w, .reach_texel = 40};
        // A fan of 120 needles around one vertex, its rim on the frame's own border.
        RasterVertex hub = random_vertex(rng, scene.frame, range);
        RasterVertex last = random_vertex(rng, scene.frame, range);
        for (int n = 0; n < 120; ++n) {
          RasterVertex next = random_vertex(rng, scene.frame, range);
          next.x = last.x + static_cast<std::int32_t>(rng.between(0, std::int64_t{2} << bits));
          next.y = last.y + static_cast<std::int32_t>(rng.between(0, std::int64_t{1} << bits));
          if (next.x > subtexels(120, scene.frame)) next.x = subtexels(-20, scene.frame);
          if (next.y > subtexels(90, scene.frame)) next.y = subtexels(-20, scene.frame);
          add_triangle(scene.list, hub, last, next);
          last = next;
        }
        // Needles: two far ends, and the third vertex a few sub-texels beside their line.
        for (int n = 0; n < 80; ++n) {
          const RasterVertex a = random_vertex(rng, scene.frame, range);
          const RasterVertex b = random_vertex(rng, scene.frame, range);
          RasterVertex c = random_vertex(rng, scene.frame, range);
          const std::int64_t part = rng.between(0, 16);
          c.x = static_cast<std::int32_t>(a.x + part * (std::int64_t{b.x} - a.x) / 16 + rng.between(-2, 2));
          c.y = static_cast<std::int32_t>(a.y + part * (std::int64_t{b.y} - a.y) / 16 + rng.between(-2, 2));
          add_triangle(scene.list, a, b, c);
        }
        family.scenes.push_back(std::move(scene));
      }
  return family;
}

namespace {

// The frame from one corner to another, in texels, with uv so that texel (i, j) of the frame meets (i + shift, j + shift) of the texture.
void add_copy(FixedScene& scene, double low_x, double low_y, double high_x, double high_y, float shift, float size, float w) {
  std::array<RasterVertex, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = k == 0 || k == 3 ? low_x : high_x, y = k < 2 ? low_y : high_y;
    corners[k].x = subtexels(x, scene.frame);
    corners[k].y = subtexels(y, scene.frame);
    corners[k].z = 0.5f;
    corners[k].w = w;
    corners[k].uv = Vec2f{(static_cast<float>(x) + shift) / size, (static_cast<float>(y) + shift) / size};
  }
  add_rectangle(scene.list, corners);
}

// The attribute runs from 0 to 1 over `steps` texels from a texel's centre, so that a sample's value is a multiple of 1/steps.
void add_ramp(FixedScene& scene, int steps, float low, float high) {
  std::array<RasterVertex, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool left = k == 0 || k == 3;
    corners[k].x = subtexels(left ? 0.5 : 0.5 + steps, scene.frame);
    corners[k].y = subtexels(k < 2 ? 0 : scene.frame.height, scene.frame);
    corners[k].z = 0.25f;
    const float value = left ? low : high;
    corners[k].color = Vec4f{value, high + low - value, 2 * value, 1 - value};
    corners[k].uv = Vec2f{value, high};
  }
  add_rectangle(scene.list, corners);
}

// `layers` triangles; with margins the depths behind the nearest count too.
FixedScene depth_tie_scene(std::uint64_t seed, int layers, bool margins) {
  Rng rng(seed);
  FixedScene scene{fmt::format("depths {}, {} layers{}", seed, layers, margins ? ", margins" : ""), {}, {61, 43, 64, {}, kColorAndId}};
  scene.frame.targets.push_back({TargetContent::depth, kR32f});
  if (margins) scene.frame.targets.push_back({TargetContent::margins, kRgba32f});
  open_draw(scene.list, Shading::vertex_color);
  for (int n = 0; n < layers; ++n) {
    std::array<RasterVertex, 3> corner;
    for (RasterVertex& vertex : corner) {
      vertex = random_vertex(rng, scene.frame, {.on_lattice = rng.coin()});
      // Few levels, the far plane among them; now and then one ulp beside.
      vertex.z = static_cast<float>(rng.below(9)) / 8;
      if (vertex.z < 1 && rng.below(4) == 0) vertex.z += 0x1p-24f;
    }
    if (n % 3 == 0) corner[0].z = corner[1].z = corner[2].z = n % 2 == 0 ? 1 : corner[0].z;  // on the far plane: never drawn
    add_triangle(scene.list, corner[0], corner[1], corner[2]);
    if (n % 4 == 0) add_triangle(scene.list, corner[1], corner[2], corner[0]);  // the same plane again
  }
  return scene;
}

}  // namespace

SceneFamily tie_scenes() {
  SceneFamily family{"ties", {}};
  std::uint64_t seed = 10000;
  for (const Filter filter : {Filter::nearest, Filter::linear})
    for (const float shift : {0.0f, 0.25f, 0.5f, -0.5f, 16.5f})
      for (const int size : {32, 24, 37})
        for (const float w : {1.0f, 0.75f}) {
          Rng rng(seed++);
          FixedScene scene{fmt::format("{} shifted by {}, size {}, w {}", to_string(filter), shift, size, w), {}, {47, 39, 64, {}, kColor}};
          scene.frame.targets.push_back({TargetContent::margins, kRgba32f});
          open_textured_draw(scene.list, rng, filter, kRgba8, size, size);
          add_copy(scene, -8, -8, 56, 56, shift, static_cast<float>(size), w);
          family.scenes.push_back(std::move(scene));
        }
  struct Ramp {
    int steps;
    float low, high;
  };
  // Half way between two unorm8 (510 = 2·255), half, and float32 numbers.
  for (const Ramp ramp : {Ramp{510, 0, 1}, Ramp{1020, 0, 1}, Ramp{2, 1, 0x1.004p0f}, Ramp{64, 1, 0x1.08p0f}, Ramp{4, 1, 0x1.000004p0f},
                          Ramp{1024, 0, 0x1p-15f}, Ramp{8, 0, 0x1p-22f}}) {
    FixedScene scene{fmt::format("ramp of {} steps", ramp.steps), {}, {ramp.steps + 1, 3, 64, {}, {}}};
    scene.frame.state.depth_test = false;
    for (const ChannelType type : kNumberTypes) scene.frame.targets.push_back({TargetContent::color, {type, 4}, {0, 0, 0, 0}});
    scene.frame.targets.push_back({TargetContent::coordinate, {ChannelType::half, 2}});
    open_draw(scene.list, Shading::vertex_color);
    add_ramp(scene, ramp.steps, ramp.low, ramp.high);
    family.scenes.push_back(scene);
    scene.name += ", half toward zero";
    scene.frame.state.half_rounding = HalfRounding::toward_zero;
    family.scenes.push_back(std::move(scene));
  }
  seed = 10500;
  for (const int layers : {4, 9, 40})
    for (const bool margins : {true, false})
      for (int n = 0; n < 4; ++n) family.scenes.push_back(depth_tie_scene(seed++, layers, margins));
  return family;
}

SceneFamily size_scenes() {
  SceneFamily family{"sizes", {}};
  struct Size {
    int width, height;
  };
  std::uint64_t seed = 11000;
  for (const Size size : {Size{1, 1},   Size{1, 97},  Size{97, 1},  Size{3, 5},   Size{7, 8},   Size{8, 7},    Size{9, 2},
                          Size{15, 16}, Size{17, 9},  Size{31, 33}, Size{32, 32}, Size{33, 31}, Size{63, 64},  Size{64, 64},
                          Size{65, 63}, Size{127, 5}, Size{128, 9}, Size{129, 7}, Size{257, 3}, Size{301, 277}})
    for (int kind = 0; kind < 3; ++kind) {
      Rng rng(seed++);
      FixedScene scene{fmt::format("{}x{}, {}", size.width, size.height,
                                   kind == 0   ? "colour"
                                   : kind == 1 ? "nearest"
                                               : "linear"),
                       {},
                       {size.width, size.height, 32, {}, kColor}};
      scene.frame.targets.push_back({TargetContent::depth, kR32f});
      if (kind == 0)
        open_draw(scene.list, Shading::vertex_color);
      else
        open_textured_draw(scene.list, rng, kind == 1 ? Filter::nearest : Filter::linear);
      add_cover(scene.list, rng, scene.frame, {.w = W::mixed});
      add_random_triangles(scene.list, rng, scene.frame, {.reach_texel = 4}, 6);
      family.scenes.push_back(std::move(scene));
    }
  return family;
}

SceneFamily pass_scenes() {
  SceneFamily family{"passes", {}};
  std::uint64_t seed = 12000;
  for (const Shading shading : {Shading::texture, Shading::indexed})
    for (const Filter filter : {Filter::nearest, Filter::linear}) {
      Rng rng(seed++);
      FixedScene scene{fmt::format("{}, {}", shading == Shading::texture ? "from a map" : "through a map", to_string(filter)),
                       {},
                       {149, 131, 64, {}, {{TargetContent::color, kRg32f}}}};
      scene.frame.state.depth_test = false;
      const std::uint32_t map = add_image(scene.list, noise_image(64, 64, kRg32f, rng));
      const std::uint32_t colors = add_image(scene.list, noise_image(64, 64, kRg32f, rng));
      for (int fan = 0; fan < 700; ++fan) {
        Draw& draw = open_draw(scene.list, shading);
        draw.texture = shading == Shading::texture ? map : colors;
        draw.sampler.filter = filter;
        if (shading == Shading::indexed) draw.indexing_map = map, draw.map_sampler.filter = filter;
        const VertexRange range{.w = W::one, .reach_texel = 0, .uv_low = 0, .uv_high = 1};
        const RasterVertex hub = random_vertex(rng, scene.frame, range);
        constexpr std::array<std::array<int, 2>, 6> kRim{{{8, 0}, {5, 7}, {-4, 6}, {-8, 1}, {-5, -6}, {4, -7}}};
        std::array<RasterVertex, 6> rim;
        for (std::size_t k = 0; k < 6; ++k) {
          rim[k] = random_vertex(rng, scene.frame, range);
          rim[k].x = hub.x + kRim[k][0] * 256 + static_cast<std::int32_t>(rng.between(-255, 255));
          rim[k].y = hub.y + kRim[k][1] * 256 + static_cast<std::int32_t>(rng.between(-255, 255));
        }
        for (std::size_t k = 0; k < 6; ++k) add_triangle(scene.list, hub, rim[k], rim[(k + 1) % 6]);
      }
      family.scenes.push_back(std::move(scene));
    }
  return family;
}

}  // namespace etalon::validation
