#include "tests/bench/bench_scene.h"

#include <cmath>
#include <memory>
#include <utility>

#include "core/base/rng.h"
#include "core/draw/scene.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "core/procedural/head.h"
#include "core/procedural/knot.h"
#include "core/procedural/noise.h"
#include "core/procedural/smooth_math.h"
#include "raster/cpu_renderer.h"
#include "tests/support/skip.h"

namespace etalon::bench {
namespace {

constexpr int kSubtexels = 256;

Frame frame_of(int size, bool depth_test) {
  Frame frame{.width = size, .height = size, .guard = 0, .state = {}, .targets = {{}}};
  frame.state.depth_test = depth_test;
  return frame;
}

/// Four channels, as any application would upload it: devices keep three as four.
std::shared_ptr<const Image> with_alpha(const Image& rgb) {
  auto image = std::make_shared<Image>(rgb.width(), rgb.height(), kRgba8);
  for (int y = 0; y < rgb.height(); ++y)
    for (int x = 0; x < rgb.width(); ++x) {
      const auto* from = rgb.channels<std::uint8_t>(x, y);
      auto* to = image->channels<std::uint8_t>(x, y);
      for (int c = 0; c < 4; ++c) to[c] = c < rgb.format().channels ? from[c] : 255;
    }
  return image;
}

BenchScene model_scene(const Mesh& mesh, const Material& material, const Camera& camera) {
  BenchScene scene{{}, frame_of(1024, true)};
  scene.list = make_scene(mesh, {material}, camera, scene.frame);
  scene.list.source_faces.clear();
  return scene;
}

Camera front_of(const Mesh& mesh) { return named_view("front", bounding_box(mesh), 1024, 1024); }

Material textured(std::shared_ptr<const Image> image, Filter filter) {
  return {.texture = std::move(image), .sampler = {filter, Wrap::repeat, Wrap::repeat}};
}

/// From above, so that little of the ground hides behind hills, and all of it is in the frame.
const Camera kTerrainCamera{.eye = {0, 2.3, 1.9}, .target = {0, -0.05, 0.1}};

double terrain_height(double x, double z) { return 0.28 * procedural::fractal_noise({1.9 * x, 0.5, 1.9 * z}, 7, 5); }

std::shared_ptr<const Image> terrain_texture(int size) {
  auto image = std::make_shared<Image>(size, size, kRgba8);
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const double x = 2 * (i + 0.5) / size - 1, z = 2 * (j + 0.5) / size - 1;
      const double h = terrain_height(x, z), grain = procedural::value_noise({90 * x, 0, 90 * z}, 3);
      const Vec3d meadow(0.24, 0.42, 0.16), rock(0.50, 0.45, 0.40), snow(0.95, 0.96, 0.98);
      Vec3d color = procedural::mix(meadow, rock, procedural::smooth_step(-0.05, 0.10, h));
      color = procedural::mix(color, snow, procedural::smooth_step(0.12, 0.22, h)) * (0.92 + 0.08 * grain);
      auto* texel = image->channels<std::uint8_t>(i, j);
      for (int c = 0; c < 3; ++c) texel[c] = static_cast<std::uint8_t>(std::floor(procedural::clamp01(color[c]) * 255 + 0.5));
      texel[3] = 255;
    }
  return image;
}

Vec2f warped(ScreenWarp warp, int x_texel, int y_texel, int size) {
  const double x = x_texel, y = y_texel;
  switch (warp) {
    case ScreenWarp::identity: return Vec2f(Vec2d(x, y) / double(size));
    case ScreenWarp::half_texel: return Vec2f(Vec2d(x + 0.5, y + 0.5) / double(size));
    case ScreenWarp::rotated: return Vec2f(Vec2d(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y) / double(size));
  }
  return {0, 0};
}

}  // namespace

BenchScene small_triangles_scene(std::uint32_t triangle_count) {
  constexpr int kSize = 512, kReach = 4 * kSubtexels;  // a random triangle in a square has 11/144 of its area: 4.9 texels
  BenchScene scene{{}, frame_of(kSize, true)};
  Rng rng(1);
  for (std::uint32_t t = 0; t < triangle_count; ++t) {
    const std::int64_t x = rng.between(kReach, kSize * kSubtexels - kReach), y = rng.between(kReach, kSize * kSubtexels - kReach);
    for (int k = 0; k < 3; ++k) {
      RasterVertex v;
      v.x = static_cast<std::int32_t>(x + rng.between(-kReach, kReach));
      v.y = static_cast<std::int32_t>(y + rng.between(-kReach, kReach));
      v.z = rng.uniform(0, 1);
      v.color = Vec4f{rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1), 1};
      scene.list.vertices.push_back(v);
    }
    scene.list.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  scene.list.draws = {{.triangle_count = triangle_count}};
  return scene;
}

BenchScene head_scene(Filter filter) {
  const procedural::Model head = procedural::make_head();
  return model_scene(head.mesh, textured(with_alpha(head.texture), filter), front_of(head.mesh));
}

std::optional<BenchScene> real_head_scene(Filter filter) {
  const auto model = test::data_file("lee_perry_smith/LeePerrySmith.glb"), texture = test::data_file("lee_perry_smith/Map-COL.jpg");
  if (!model || !texture) return std::nullopt;
  io::LoadedModel loaded = io::read_mesh(*model);
  io::flip_v(loaded.mesh);
  loaded.mesh.face_materials.clear();
  return model_scene(loaded.mesh, textured(with_alpha(io::read_image(*texture)), filter), front_of(loaded.mesh));
}

BenchScene full_screen_scene(ScreenWarp warp) {
  constexpr int kSize = 1024;
  BenchScene scene{{}, frame_of(kSize, false)};
  auto image = std::make_shared<Image>(kSize, kSize, kRgba8);
  Rng rng(2);
  for (std::byte& byte : image->bytes()) byte = static_cast<std::byte>(rng.below(256));
  scene.list.images = {image};
  for (const auto& [x, y] : {std::pair{0, 0}, {kSize, 0}, {kSize, kSize}, {0, kSize}}) {
    RasterVertex v;
    v.x = x * kSubtexels, v.y = y * kSubtexels;
    v.uv = warped(warp, x, y, kSize);
    scene.list.vertices.push_back(v);
  }
  scene.list.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.list.draws = {{.triangle_count = 2,
                       .shading = Shading::texture,
                       .texture = 0,
                       .sampler = {Filter::nearest, Wrap::repeat, Wrap::repeat},
                       .map_sampler = {}}};
  return scene;
}

BenchScene knot_scene(int rings, int around) {
  const Mesh knot = procedural::make_knot({.rings = rings, .around = around});
  return model_scene(knot, {}, front_of(knot));
}

BenchScene terrain_scene(std::uint32_t cells) {
  Mesh mesh;
  mesh.has_uv = true;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const double u = static_cast<double>(i) / cells, v = static_cast<double>(j) / cells;
      const double x = 2 * u - 1, z = 2 * v - 1;
      mesh.wedges.push_back({VertexId(mesh.positions.size()), Vec2f(Vec2d(u, v))});
      mesh.positions.push_back(Vec3f(Vec3d(x, terrain_height(x, z), z)));
    }
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = c - 1;
      mesh.faces.push_back({WedgeId(a), WedgeId(c), WedgeId(b)});
      mesh.faces.push_back({WedgeId(a), WedgeId(d), WedgeId(c)});
    }
  return model_scene(mesh, textured(terrain_texture(1024), Filter::nearest), kTerrainCamera);
}

std::vector<SceneEntry> scene_entries() {
  return {
      {"small_triangles", "100,000 small triangles with depth, 512²", [] { return small_triangles_scene(); }},
      {"head_nearest", "the embedded head, nearest, 1024²", [] { return head_scene(Filter::nearest); }},
      {"head_linear", "the embedded head, linear, 1024²", [] { return head_scene(Filter::linear); }, 0.3},
      {"real_head_nearest", "Lee Perry-Smith's head, nearest, 1024²", [] { return real_head_scene(Filter::nearest); }},
      {"real_head_linear", "Lee Perry-Smith's head, linear, 1024²", [] { return real_head_scene(Filter::linear); }, 0.3},
      {"screen", "full screen, nearest, RGBA8 1024²", [] { return full_screen_scene(ScreenWarp::identity); }},
      {"screen_half_texel", "full screen, moved by half a texel: all ties", [] { return full_screen_scene(ScreenWarp::half_texel); }, 1},
      {"screen_rotated", "full screen, rotated", [] { return full_screen_scene(ScreenWarp::rotated); }},
      {"knot", "knot of 2,360,000 triangles, vertex colours, 1024²", [] { return knot_scene(); }},
      {"terrain", "terrain of 131,072 triangles, nearest, 1024²", [] { return terrain_scene(); }},
  };
}

SceneWork work_of(const BenchScene& scene) {
  Frame ids = scene.frame;
  ids.targets = {{TargetContent::triangle_id, kR32ui}};
  raster::CpuRenderer renderer;
  const Image visible = renderer.render(scene.list, ids).front();
  SceneWork work;
  const auto* id = visible.channels<std::uint32_t>(0, 0);
  for (std::size_t i = 0; i < visible.texel_count(); ++i) work.covered_texels += id[i] != kNoTriangle ? 1 : 0;
  work.vertices = scene.list.vertices.size();
  work.triangles = scene.list.triangles.size();
  work.input_bytes = work.vertices * sizeof(RasterVertex) + work.triangles * sizeof(scene.list.triangles[0]);
  for (const TargetSpec& target : scene.frame.targets)
    work.frame_bytes += visible.texel_count() * static_cast<std::uint64_t>(bytes_per_texel(target.format));
  const Draw& draw = scene.list.draws.front();
  if (draw.shading == Shading::texture) {
    const Image& texture = *scene.list.images[draw.texture];
    work.lookups = work.covered_texels * (draw.sampler.filter == Filter::linear ? 4 : 1);
    work.lookup_bytes = static_cast<std::uint64_t>(bytes_per_texel(texture.format()));
    work.table_texels = texture.texel_count();
  }
  return work;
}

}  // namespace etalon::bench
