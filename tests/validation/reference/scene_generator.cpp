#include "tests/validation/reference/scene_generator.h"

#include <algorithm>
#include <optional>

#include "tests/validation/reference/random_values.h"
#include "tests/validation/reference/triangle_generator.h"

namespace etalon::validation::reference {

namespace {

// |u|·size < 2^30 for images of up to 64 texels a side; maps hold coordinates of textures of that size too.
constexpr int kTexturedUvExponent = 23;
constexpr int kAttributeExponent = 40;

// Indices into DrawList::images by what may be done with them.
struct ImagePool {
  std::vector<std::uint32_t> textures;       // any filter
  std::vector<std::uint32_t> wide_textures;  // float texels of any size: nearest only
  std::vector<std::uint32_t> maps;           // two channels or more, texels in the range of uv
};

std::uint32_t add_image(DrawList& list, std::shared_ptr<const Image> image) {
  list.images.push_back(std::move(image));
  return static_cast<std::uint32_t>(list.images.size() - 1);
}

// Formats that the fast path has kernels of its own for, where texture and target both have them: chance alone seldom meets those.
std::optional<PixelFormat> random_own_format(Rng& rng) {
  return one_in(rng, 4) ? std::optional(one_of(rng, {kRg32f, kRgba8})) : std::nullopt;
}

ImagePool add_images(Rng& rng, DrawList& list, std::optional<PixelFormat> own) {
  ImagePool pool;
  const auto channels = [&rng](int least) { return static_cast<int>(rng.between(least, 4)); };
  for (int n = 0; n < 4; ++n)
    pool.textures.push_back(add_image(list, random_image(rng, own ? *own : random_format(rng, channels(1)), kAttributeExponent)));
  pool.wide_textures.push_back(add_image(list, random_image(rng, {ChannelType::float32, channels(1)}, 127)));
  for (int n = 0; n < 3; ++n) pool.maps.push_back(add_image(list, random_image(rng, random_format(rng, channels(2)), kTexturedUvExponent)));
  return pool;
}

std::uint32_t pick(Rng& rng, const std::vector<std::uint32_t>& from) { return from[rng.below(from.size())]; }

Draw random_draw(Rng& rng, const ImagePool& pool) {
  Draw draw;
  draw.shading = one_of(rng, {Shading::vertex_color, Shading::texture, Shading::texture, Shading::indexed});
  if (draw.shading == Shading::vertex_color) return draw;
  draw.sampler = random_sampler(rng);
  draw.texture = pick(rng, draw.sampler.filter == Filter::nearest && one_in(rng, 4) ? pool.wide_textures : pool.textures);
  if (draw.shading == Shading::indexed) draw.indexing_map = pick(rng, pool.maps), draw.map_sampler = random_sampler(rng);
  return draw;
}

TriangleDomain domain_of(const Frame& frame, const DrawList& list, const Draw& draw, int size_exponent) {
  const int bits = frame.state.subtexel_bits;
  const auto subtexels = [bits](std::int64_t texels) { return texels * (std::int64_t{1} << bits); };
  const Image* image = draw.shading == Shading::vertex_color ? nullptr
                       : draw.shading == Shading::texture    ? list.images[draw.texture].get()
                                                             : list.images[draw.indexing_map].get();
  return {.x_min = subtexels(-frame.guard),
          .x_max = subtexels(frame.width + frame.guard),
          .y_min = subtexels(-frame.guard),
          .y_max = subtexels(frame.height + frame.guard),
          .frame_x = subtexels(frame.width),
          .frame_y = subtexels(frame.height),
          .subtexel_bits = bits,
          .size_exponent = size_exponent,
          .uv_exponent = image != nullptr ? kTexturedUvExponent : kAttributeExponent,
          .texture_width = image != nullptr ? image->width() : 1,
          .texture_height = image != nullptr ? image->height() : 1};
}

// Draws of one to three triangles, each with its own vertices.
void add_triangles(Rng& rng, Scene& scene, std::optional<PixelFormat> own, int triangle_count, int size_exponent) {
  DrawList& list = scene.list;
  const ImagePool pool = add_images(rng, list, own);
  Corners previous{};
  while (list.triangles.size() < static_cast<std::size_t>(triangle_count)) {
    Draw draw = random_draw(rng, pool);
    draw.first_triangle = static_cast<std::uint32_t>(list.triangles.size());
    draw.triangle_count = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(rng.below(3) + 1, static_cast<std::uint64_t>(triangle_count) - list.triangles.size()));
    const TriangleDomain domain = domain_of(scene.frame, list, draw, size_exponent);
    for (std::uint32_t n = 0; n < draw.triangle_count; ++n) {
      Aim aim;
      previous = random_triangle(rng, domain, previous, aim);
      scene.aims.push_back(aim);
      const auto first = static_cast<std::uint32_t>(list.vertices.size());
      list.vertices.insert(list.vertices.end(), previous.begin(), previous.end());
      list.triangles.push_back({first, first + 1, first + 2});
    }
    list.draws.push_back(draw);
  }
}

TargetSpec random_target(Rng& rng, TargetContent content, PixelFormat format) {
  TargetSpec target{content, format, {}};
  for (float& c : target.clear) c = random_attribute(rng, kAttributeExponent);
  return target;
}

Frame block_frame(Rng& rng) {
  Frame frame;
  switch (rng.below(5)) {
    case 0: frame.width = frame.height = 16384, frame.guard = 0; break;
    case 1: frame.width = 8192, frame.height = static_cast<int>(rng.between(1, 8192)), frame.guard = 4096; break;
    case 2:
      frame.width = static_cast<int>(rng.between(1, 300)), frame.height = static_cast<int>(rng.between(1, 300)),
      frame.guard = static_cast<int>(rng.between(0, 8000));
      break;
    default: frame.width = frame.height = 4096, frame.guard = 2048; break;
  }
  frame.state = random_state(rng);
  return frame;
}

}  // namespace

Scene random_block(std::uint64_t seed, int triangle_count) {
  Rng rng(seed);
  Scene scene;
  scene.frame = block_frame(rng);
  const std::optional<PixelFormat> own = random_own_format(rng);
  add_triangles(rng, scene, own, triangle_count, 12);
  auto& targets = scene.frame.targets;
  targets.push_back(random_target(rng, TargetContent::color, own ? *own : random_format(rng, static_cast<int>(rng.between(1, 4)))));
  targets.push_back(random_target(rng, TargetContent::color, random_format(rng, 4)));
  targets.push_back(random_target(rng, TargetContent::coordinate, rng.coin() ? kRg32f : random_format(rng, 2)));
  targets.push_back(random_target(rng, TargetContent::depth, kR32f));
  if (one_in(rng, 3)) targets.push_back(random_target(rng, TargetContent::barycentrics, random_format(rng, 3)));
  if (one_in(rng, 3)) targets.push_back(random_target(rng, TargetContent::margins, kRgba32f));
  if (one_in(rng, 3)) targets.push_back(random_target(rng, TargetContent::bound_terms, kRg32f));
  if (one_in(rng, 8)) targets.push_back(random_target(rng, TargetContent::triangle_id, kR32ui));
  return scene;
}

Scene random_frame(std::uint64_t seed, int width, int height, int triangle_count) {
  Rng rng(seed);
  Scene scene;
  scene.frame.width = width;
  scene.frame.height = height;
  scene.frame.guard = static_cast<int>(rng.between(0, 2 * std::max(width, height)));
  scene.frame.state = random_state(rng);
  int size_exponent = 1;
  while ((1 << size_exponent) < std::max(width, height)) ++size_exponent;
  const std::optional<PixelFormat> own = random_own_format(rng);
  add_triangles(rng, scene, own, triangle_count, size_exponent);
  const std::uint64_t depths = rng.below(3);  // as they come; a few levels, flat triangles; one plane
  for (std::size_t v = 0; v < scene.list.vertices.size(); ++v) {
    RasterVertex& vertex = scene.list.vertices[v];
    if (depths == 1) vertex.z = v % 3 == 0 ? static_cast<float>(rng.between(1, 8)) / 8 : scene.list.vertices[v - 1].z;
    if (depths == 2) vertex.z = 0.5f;
  }
  auto& targets = scene.frame.targets;
  targets.push_back(random_target(rng, TargetContent::color, own ? *own : random_format(rng, static_cast<int>(rng.between(1, 4)))));
  targets.push_back(random_target(rng, TargetContent::color, random_format(rng, 4)));
  targets.push_back(random_target(rng, TargetContent::triangle_id, kR32ui));
  targets.push_back(random_target(rng, TargetContent::barycentrics, random_format(rng, 3)));
  targets.push_back(random_target(rng, TargetContent::coordinate, random_format(rng, 2)));
  targets.push_back(random_target(rng, TargetContent::depth, kR32f));
  targets.push_back(random_target(rng, TargetContent::margins, kRgba32f));
  targets.push_back(random_target(rng, TargetContent::bound_terms, kRg32f));
  return scene;
}

}  // namespace etalon::validation::reference
