#include "validation/selftest/value_scenes.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/selftest/scene_parts.h"

namespace etalon::validation {
namespace {

using W = VertexRange::W;

// One way to get a value: colours, a lookup, or a lookup through a map.
struct Kind {
  const char* name;
  Shading shading;
  Filter filter = Filter::nearest;
  Filter map_filter = Filter::nearest;
};

constexpr std::array kKinds{Kind{"colour", Shading::vertex_color},
                            Kind{"nearest", Shading::texture, Filter::nearest},
                            Kind{"linear", Shading::texture, Filter::linear},
                            Kind{"nearest of nearest", Shading::indexed, Filter::nearest, Filter::nearest},
                            Kind{"nearest of linear", Shading::indexed, Filter::nearest, Filter::linear},
                            Kind{"linear of nearest", Shading::indexed, Filter::linear, Filter::nearest},
                            Kind{"linear of linear", Shading::indexed, Filter::linear, Filter::linear}};

struct Size {
  int width, height;
};
constexpr std::array kTextureSizes{Size{32, 32}, Size{29, 17}, Size{16, 64}, Size{1, 1}, Size{5, 3}};

PixelFormat texture_format(std::size_t n) {
  constexpr std::array kChannels{4, 3, 2, 1};
  return {kNumberTypes[n % kNumberTypes.size()], kChannels[n / kNumberTypes.size() % kChannels.size()]};
}

// A draw of this kind with images and wraps by chance.
void open_draw_of(const Kind& kind, DrawList& list, Rng& rng, PixelFormat texture, PixelFormat map) {
  Draw draw{.shading = kind.shading};
  if (kind.shading != Shading::vertex_color) {
    const Size size = kTextureSizes[rng.below(kTextureSizes.size())];
    draw.texture = add_image(list, noise_image(size.width, size.height, texture, rng));
    draw.sampler = random_sampler(rng, kind.filter);
  }
  if (kind.shading == Shading::indexed) {
    const Size size = kTextureSizes[rng.below(kTextureSizes.size())];
    draw.indexing_map = add_image(list, noise_image(size.width, size.height, map, rng));
    draw.map_sampler = random_sampler(rng, kind.map_filter);
  }
  Draw& opened = open_draw(list, kind.shading);
  draw.first_triangle = opened.first_triangle;
  opened = draw;
}

struct Storage {
  PixelFormat format;
  HalfRounding half_rounding = HalfRounding::nearest_even;
};

constexpr std::array kStorages{
    Storage{{ChannelType::unorm8, 4}},  Storage{{ChannelType::unorm8, 3}},  Storage{{ChannelType::unorm8, 1}},
    Storage{{ChannelType::srgb8, 4}},   Storage{{ChannelType::srgb8, 3}},   Storage{{ChannelType::unorm16, 4}},
    Storage{{ChannelType::unorm16, 2}}, Storage{{ChannelType::half, 4}},    Storage{{ChannelType::half, 3}, HalfRounding::toward_zero},
    Storage{{ChannelType::float32, 4}}, Storage{{ChannelType::float32, 2}}, Storage{{ChannelType::float32, 1}}};

const char* name_of(W w) { return w == W::one ? "affine" : w == W::equal ? "equal w" : "perspective"; }

}  // namespace

SceneFamily shading_scenes() {
  SceneFamily family{"shading", {}};
  std::uint64_t seed = 1000;
  for (const Kind& kind : kKinds)
    for (const W w : {W::one, W::equal, W::perspective})
      for (const Storage& storage : kStorages) {
        Rng rng(seed++);
        FixedScene scene{fmt::format("{}, {}, {}", kind.name, name_of(w), to_string(storage.format)), {}, {}};
        scene.frame = {53, 37, 64, {}, {{TargetContent::color, storage.format, {0.25f, 0.5f, 0.75f, 1}}}};
        scene.frame.state.half_rounding = storage.half_rounding;
        scene.frame.state.depth_test = rng.coin();
        if (scene.frame.state.depth_test) scene.frame.targets.push_back({TargetContent::depth, kR32f});
        const VertexRange range{.w = w};
        const auto next_draw = [&] { open_draw_of(kind, scene.list, rng, texture_format(seed), {kNumberTypes[seed % 5], 2}); };
        next_draw();
        add_cover(scene.list, rng, scene.frame, range);
        next_draw();
        add_random_triangles(scene.list, rng, scene.frame, range, 6);
        family.scenes.push_back(std::move(scene));
      }
  return family;
}

SceneFamily texture_scenes() {
  SceneFamily family{"textures", {}};
  std::uint64_t seed = 2000;
  const auto add = [&](const Kind& kind, PixelFormat texture, PixelFormat map, PixelFormat stored, W w, const std::string& name) {
    Rng rng(seed++);
    FixedScene scene{name, {}, {27, 23, 64, {}, {{TargetContent::color, stored}}}};
    open_draw_of(kind, scene.list, rng, texture, map);
    add_cover(scene.list, rng, scene.frame, {.w = w});
    family.scenes.push_back(std::move(scene));
  };
  for (std::size_t n = 0; n < 20; ++n)
    for (std::size_t kind : {1u, 2u})
      for (const PixelFormat stored : {kRgba8, kRgba32f})
        for (const W w : {W::one, W::perspective})
          add(kKinds[kind], texture_format(n), kRg32f, stored, w,
              fmt::format("{} of {}, {}, {}", kKinds[kind].name, to_string(texture_format(n)), name_of(w), to_string(stored)));
  for (const ChannelType type : kNumberTypes)
    for (const int channels : {2, 3, 4})
      for (std::size_t kind : {3u, 4u, 5u, 6u})
        for (const W w : {W::one, W::perspective})
          add(kKinds[kind], texture_format(seed % 20), {type, channels}, seed % 2 != 0 ? kRgba8 : kRgba32f, w,
              fmt::format("{}, map {}, {}", kKinds[kind].name, to_string(PixelFormat{type, channels}), name_of(w)));
  return family;
}

SceneFamily wrap_scenes() {
  SceneFamily family{"wraps", {}};
  std::uint64_t seed = 3000;
  constexpr std::array kSizes{Size{8, 8}, Size{7, 5}, Size{1, 1}, Size{1024, 3}, Size{2, 4099}};
  for (const Filter filter : {Filter::nearest, Filter::linear})
    for (const Wrap wrap_u : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat})
      for (const Wrap wrap_v : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat})
        for (const Size size : kSizes)
          // Near, and so far that a float32 knows the texel only to a few, or to 64 of them.
          for (const float reach_texel : {0.0f, 0x1p20f, 0x1p29f}) {
            const float reach = reach_texel == 0 ? 3 : reach_texel / static_cast<float>(std::max(size.width, size.height));
            Rng rng(seed++);
            // Far away the coordinate's own error is what a float32 target must see; textures of bytes have a kernel of their own.
            constexpr std::array kFormats{kRgba8, PixelFormat{ChannelType::float32, 3}, PixelFormat{ChannelType::unorm16, 2},
                                          PixelFormat{ChannelType::half, 4}};
            const PixelFormat format = kFormats[seed % kFormats.size()];
            FixedScene scene{fmt::format("{}, wraps {} {}, {}x{} {}, up to {}", to_string(filter), static_cast<int>(wrap_u),
                                         static_cast<int>(wrap_v), size.width, size.height, to_string(format), reach),
                             {},
                             {33, 17, 64, {}, {{TargetContent::color, kRgba8}, {TargetContent::color, kRgba32f}}}};
            Draw& draw = open_draw(scene.list, Shading::texture);
            draw.sampler = {filter, wrap_u, wrap_v};
            draw.texture = add_image(scene.list, noise_image(size.width, size.height, format, rng));
            add_cover(scene.list, rng, scene.frame, {.w = seed % 2 != 0 ? W::one : W::perspective, .uv_low = -reach, .uv_high = reach});
            family.scenes.push_back(std::move(scene));
          }
  return family;
}

namespace {

// Subnormals, numbers below 2^-40 and negative zeros among ordinary ones.
std::shared_ptr<const Image> image_of_extremes(Rng& rng) {
  constexpr std::array kNumbers{0x1p-149f, -0x1p-130f,     0x1p-126f,  0x1p-41f,     0x1p-40f,   -0.0f,    0.0f,
                                1.0f,      0x1.fffffep-1f, 65504.0f,   65519.996f,   65520.0f,   65536.0f, 0x1p40f,
                                -0x1p40f,  0x1p-24f,       0x1p-25f,   0x1.8p-24f,   0x1.002p0f, 0.5f,     -0.25f,
                                0x1p-14f,  0x1.ffcp-15f,   1.5f / 255, 0.5f / 65535, 3.0f};
  auto image = std::make_shared<Image>(13, 11, kRgba32f);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 13; ++x)
      for (int c = 0; c < 4; ++c) image->channels<float>(x, y)[c] = kNumbers[rng.below(kNumbers.size())];
  return image;
}

float extreme_attribute(Rng& rng) {
  constexpr std::array kNumbers{0x1p40f,  -0x1p40f, 0x1p-40f, 0x1.fffffep-41f, -0.0f, 0.0f,           1.0f,       65504.0f,
                                65520.0f, 65536.0f, 0x1p-24f, 0x1p-25f,        0.5f,  0x1.fffffep-1f, 0.0031308f, 0.04045f};
  return rng.coin() ? kNumbers[rng.below(kNumbers.size())] : rng.uniform(-2, 2);
}

}  // namespace

namespace {

// Around 2^-40, below which what is filtered, and a coordinate, is 0; both signs.
std::shared_ptr<const Image> image_of_tiny_numbers(PixelFormat format, Rng& rng) {
  auto image = std::make_shared<Image>(11, 7, format);
  for (int y = 0; y < image->height(); ++y)
    for (int x = 0; x < image->width(); ++x)
      for (int c = 0; c < format.channels; ++c) image->channels<float>(x, y)[c] = rng.uniform(-0x1p-39f, 0x1p-39f);
  return image;
}

// Filtered texels, and coordinates from a map, of which most are nearly nothing.
void add_tiny_number_scenes(SceneFamily& family) {
  std::uint64_t seed = 4500;
  for (const Shading shading : {Shading::texture, Shading::indexed})
    for (const Filter filter : {Filter::nearest, Filter::linear})
      for (const W w : {W::one, W::perspective}) {
        Rng rng(seed++);
        FixedScene scene{
            fmt::format("tiny numbers, {}, {}, {}", shading == Shading::texture ? "texture" : "map", to_string(filter), name_of(w)),
            {},
            {37, 31, 64, {}, {{TargetContent::color, kRgba32f}, {TargetContent::color, kRgba8}}}};
        Draw draw{.shading = shading};
        if (shading == Shading::texture) {
          draw.texture = add_image(scene.list, image_of_tiny_numbers(kRgba32f, rng));
          draw.sampler = random_sampler(rng, filter);
        } else {
          draw.texture = add_image(scene.list, noise_image(32, 32, kRgba8, rng));
          draw.sampler = {Filter::nearest, Wrap::repeat, Wrap::mirrored_repeat};
          draw.indexing_map = add_image(scene.list, image_of_tiny_numbers(kRg32f, rng));
          draw.map_sampler = random_sampler(rng, filter);
        }
        open_draw(scene.list, shading) = draw;
        add_cover(scene.list, rng, scene.frame, {.w = w});
        family.scenes.push_back(std::move(scene));
      }
}

}  // namespace

SceneFamily extreme_value_scenes() {
  SceneFamily family{"values", {}};
  std::uint64_t seed = 4000;
  std::vector<Storage> storages;
  for (const ChannelType type : kNumberTypes)
    for (int channels = 1; channels <= 4; ++channels) storages.push_back({{type, channels}});
  for (int channels = 1; channels <= 4; ++channels) storages.push_back({{ChannelType::half, channels}, HalfRounding::toward_zero});
  for (const Storage& storage : storages)
    for (const bool constant : {true, false})  // constant over a triangle: the value is the attribute itself
      for (const W w : {W::one, W::perspective, W::wild})
        for (const Shading shading : {Shading::vertex_color, Shading::texture}) {
          Rng rng(seed++);
          FixedScene scene{
              fmt::format("{}{}, {}{}, w {}", to_string(storage.format),
                          storage.half_rounding == HalfRounding::toward_zero ? " toward zero" : "",
                          shading == Shading::texture ? "texture" : "colour", constant ? ", constant" : "", static_cast<int>(w)),
              {},
              {29, 21, 64, {}, {{TargetContent::color, storage.format, {-1, 2, 0.5f, 0x1p40f}}}}};
          scene.frame.state.half_rounding = storage.half_rounding;
          scene.frame.state.depth_test = false;
          Draw& draw = open_draw(scene.list, shading);
          if (shading == Shading::texture) {
            draw.sampler = random_sampler(rng, constant ? Filter::nearest : Filter::linear);
            draw.texture = add_image(scene.list, image_of_extremes(rng));
          }
          for (int t = 0; t < 12; ++t) {
            std::array<RasterVertex, 3> corner;
            for (RasterVertex& vertex : corner) {
              vertex = random_vertex(rng, scene.frame, {.w = w});
              for (int c = 0; c < 4; ++c) vertex.color[c] = extreme_attribute(rng);
              if (constant) vertex.color = corner[0].color;
            }
            add_triangle(scene.list, corner[0], corner[1], corner[2]);
          }
          family.scenes.push_back(std::move(scene));
        }
  add_tiny_number_scenes(family);
  return family;
}

SceneFamily target_scenes() {
  SceneFamily family{"targets", {}};
  std::uint64_t seed = 5000;
  std::vector<std::vector<TargetSpec>> sets{{{TargetContent::triangle_id, kR32ui}},
                                            {{TargetContent::depth, kR32f}},
                                            {{TargetContent::margins, kRgba32f}},
                                            {{TargetContent::bound_terms, kRg32f}},
                                            all_targets()};
  for (const ChannelType type : kNumberTypes) {
    sets.push_back({{TargetContent::barycentrics, {type, 3}, {0.5f, 0.25f, 0.125f, 1}}});
    sets.push_back({{TargetContent::coordinate, {type, 2}, {0.5f, 0.25f, 0.125f, 1}}});
  }
  // As `etalon render --margins` draws.
  sets.push_back({{TargetContent::color, kRgba32f},
                  {TargetContent::triangle_id, kR32ui},
                  {TargetContent::depth, kR32f},
                  {TargetContent::margins, kRgba32f},
                  {TargetContent::bound_terms, kRg32f}});
  for (const std::vector<TargetSpec>& targets : sets)
    for (const std::size_t kind : {0u, 1u, 2u, 6u})
      for (const W w : {W::one, W::mixed}) {
        Rng rng(seed++);
        FixedScene scene{fmt::format("{} {}{}, {}, {}", to_string(targets[0].content), to_string(targets[0].format),
                                     targets.size() > 1 ? " and others" : "", kKinds[kind].name, name_of(w)),
                         {},
                         {41, 29, 64, {}, targets}};
        scene.frame.state.half_rounding = rng.coin() ? HalfRounding::toward_zero : HalfRounding::nearest_even;
        scene.frame.state.depth_test = rng.below(4) != 0;
        open_draw_of(kKinds[kind], scene.list, rng, texture_format(seed), kRg32f);
        add_cover(scene.list, rng, scene.frame, {.w = w});
        add_random_triangles(scene.list, rng, scene.frame, {.w = w, .on_lattice = rng.coin()}, 8);
        family.scenes.push_back(std::move(scene));
      }
  return family;
}

}  // namespace etalon::validation
