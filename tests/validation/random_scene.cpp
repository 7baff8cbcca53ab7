#include "tests/validation/random_scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "core/math/half.h"

namespace etalon::test {

namespace {

template <class T, std::size_t n>
T one_of(Rng& rng, const T (&values)[n]) {
  return values[rng.below(n)];
}

int random_size(Rng& rng, int largest) {
  if (rng.coin()) return std::min(largest, 1 << rng.between(4, 9));
  return static_cast<int>(rng.between(std::min(17, largest), largest));
}

std::shared_ptr<const Image> random_texture(Rng& rng, PixelFormat format, bool filtered) {
  Image image(random_size(rng, 300), random_size(rng, 300), format);
  const bool smooth = rng.coin();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (int c = 0; c < format.channels; ++c) {
        const double ramp = 0.5 * (static_cast<double>(x) / image.width() + static_cast<double>(y) / image.height());
        const double value = smooth ? ramp : rng.unit();
        switch (format.type) {
          case ChannelType::unorm8:
          case ChannelType::srgb8: image.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(value * 255.999); break;
          case ChannelType::unorm16: image.channels<std::uint16_t>(x, y)[c] = static_cast<std::uint16_t>(value * 65535.999); break;
          case ChannelType::half: image.channels<std::uint16_t>(x, y)[c] = half_nearest_even(4 * value - 2); break;
          case ChannelType::float32: {
            // Wide exponents where the texel is only copied; -0, subnormals and tiny numbers belong to the format.
            float f = static_cast<float>(4 * value - 2);
            if (!filtered && rng.below(8) == 0) f *= 0x1p-140f;
            if (rng.below(64) == 0) f = -0.0f;
            image.channels<float>(x, y)[c] = f;
            break;
          }
          case ChannelType::uint32: break;
        }
      }
    }
  }
  return std::make_shared<const Image>(std::move(image));
}

// A map whose texels are coordinates of the second image, some of them exactly on its texel borders.
std::shared_ptr<const Image> random_map(Rng& rng, const Image& source, bool filtered) {
  const PixelFormat format =
      one_of(rng, {PixelFormat{ChannelType::unorm16, 2}, PixelFormat{ChannelType::float32, 2}, PixelFormat{ChannelType::half, 2},
                   PixelFormat{ChannelType::unorm8, 2}, PixelFormat{ChannelType::float32, 4}});
  Image map(random_size(rng, 200), random_size(rng, 200), format);
  const double jitter = filtered ? 0 : rng.unit() * 0.01;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      for (int c = 0; c < format.channels; ++c) {
        const int n = c == 0 ? source.width() : source.height();
        double value = std::clamp((c == 0 ? (x + 0.5) / map.width() : (y + 0.5) / map.height()) + jitter * (rng.unit() - 0.5), 0.0, 1.0);
        if (rng.below(4) == 0) value = std::round(value * n) / n;
        switch (format.type) {
          case ChannelType::unorm8: map.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>(std::lround(value * 255)); break;
          case ChannelType::unorm16: map.channels<std::uint16_t>(x, y)[c] = static_cast<std::uint16_t>(std::lround(value * 65535)); break;
          case ChannelType::half: map.channels<std::uint16_t>(x, y)[c] = half_nearest_even(value); break;
          default: map.channels<float>(x, y)[c] = static_cast<float>(value); break;
        }
      }
    }
  }
  return std::make_shared<const Image>(std::move(map));
}

PixelFormat random_format(Rng& rng, int channels) {
  return {one_of(rng, {ChannelType::unorm8, ChannelType::unorm16, ChannelType::half, ChannelType::float32}), channels};
}

std::vector<TargetSpec> random_targets(Rng& rng) {
  std::vector<TargetSpec> targets{{TargetContent::color, random_format(rng, static_cast<int>(rng.between(1, 4)))}};
  for (float& c : targets[0].clear) c = static_cast<float>(rng.unit());
  if (rng.coin()) return targets;
  targets.push_back({TargetContent::triangle_id, kR32ui});
  if (rng.coin()) targets.push_back({TargetContent::depth, kR32f});
  if (rng.coin()) targets.push_back({TargetContent::coordinate, random_format(rng, 2)});
  if (rng.coin()) targets.push_back({TargetContent::barycentrics, random_format(rng, 3)});
  return targets;
}

class SceneMaker {
 public:
  SceneMaker(Rng& rng, RandomScene& scene) : rng_(rng), scene_(scene), grid_(1 << scene.frame.state.subtexel_bits) {}

  std::int32_t position(double texels, int extent) const {
    const double lo = -scene_.frame.guard, hi = extent + scene_.frame.guard;
    return static_cast<std::int32_t>(std::lround(std::clamp(texels, lo, hi) * grid_));
  }

  // uv of a position: a map of the frame onto the texture, at about one texel per texel or at random; per scene, so that neighbours continue.
  void choose_mapping(int texture_width, int texture_height) {
    switch (rng_.below(4)) {
      case 0:  // whole texels, or halves: every sample a tie or far from one
        scale_x_ = 1.0 / texture_width;
        scale_y_ = 1.0 / texture_height;
        shift_x_ = static_cast<double>(rng_.between(-8, 8)) * 0.5 / texture_width;
        shift_y_ = static_cast<double>(rng_.between(-8, 8)) * 0.5 / texture_height;
        break;
      case 1:  // rotated one to one
        scale_x_ = 0.8 / texture_width;
        shear_x_ = 0.6 / texture_width;
        scale_y_ = 0.8 / texture_height;
        shear_y_ = -0.6 / texture_height;
        break;
      default:
        scale_x_ = (rng_.unit() * 6 - 3) / scene_.frame.width;
        shear_x_ = (rng_.unit() * 4 - 2) / scene_.frame.height;
        scale_y_ = (rng_.unit() * 6 - 3) / scene_.frame.height;
        shear_y_ = (rng_.unit() * 4 - 2) / scene_.frame.width;
        shift_x_ = rng_.unit() * 2 - 1;
        shift_y_ = rng_.unit() * 2 - 1;
    }
  }

  RasterVertex vertex(double x, double y, bool perspective, bool random_uv) {
    RasterVertex v;
    v.x = position(x, scene_.frame.width);
    v.y = position(y, scene_.frame.height);
    v.z = static_cast<float>(rng_.unit());
    v.w = perspective ? static_cast<float>(0.3 + 4.7 * rng_.unit()) : 1.0f;
    const double px = static_cast<double>(v.x) / grid_, py = static_cast<double>(v.y) / grid_;
    if (random_uv) {
      v.uv = Vec2f(static_cast<float>(rng_.unit() * 3 - 1), static_cast<float>(rng_.unit() * 3 - 1));
    } else {
      v.uv =
          Vec2f(static_cast<float>(scale_x_ * px + shear_x_ * py + shift_x_), static_cast<float>(scale_y_ * py + shear_y_ * px + shift_y_));
    }
    for (int c = 0; c < 4; ++c) v.color[c] = static_cast<float>(rng_.unit());
    return v;
  }

  void triangle(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) {
    const auto first = static_cast<std::uint32_t>(scene_.list.vertices.size());
    for (const RasterVertex& v : {a, b, c}) scene_.list.vertices.push_back(v);
    scene_.list.triangles.push_back({first, first + 1, first + 2});
  }

  void random_triangles(int count, double reach, bool perspective) {
    const bool random_uv = rng_.coin();
    for (int t = 0; t < count; ++t) {
      const double size = reach * std::max(scene_.frame.width, scene_.frame.height) * (0.02 + rng_.unit());
      const double x = rng_.unit() * scene_.frame.width, y = rng_.unit() * scene_.frame.height;
      const auto corner = [&] { return vertex(x + (rng_.unit() - 0.5) * size, y + (rng_.unit() - 0.5) * size, perspective, random_uv); };
      const RasterVertex a = corner(), b = corner(), c = corner();
      triangle(a, b, c);
    }
  }

  void slivers(int count, bool perspective) {
    for (int t = 0; t < count; ++t) {
      const double x = rng_.unit() * scene_.frame.width, y = rng_.unit() * scene_.frame.height;
      const double dx = (rng_.unit() - 0.5) * scene_.frame.width, dy = (rng_.unit() - 0.5) * scene_.frame.height;
      const double off = static_cast<double>(rng_.between(1, 64)) / grid_, along = rng_.unit();
      triangle(vertex(x, y, perspective, true), vertex(x + dx, y + dy, perspective, true),
               vertex(x + along * dx + off, y + along * dy - off, perspective, true));
    }
  }

  // A grid of shared vertices over the frame and somewhat beyond.
  void mesh(int cells, double jitter, bool perspective) {
    const auto first = static_cast<std::uint32_t>(scene_.list.vertices.size());
    const double dx = 1.2 * scene_.frame.width / cells, dy = 1.2 * scene_.frame.height / cells;
    for (int j = 0; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i) {
        scene_.list.vertices.push_back(vertex(-0.1 * scene_.frame.width + dx * (i + jitter * (rng_.unit() - 0.5)),
                                              -0.1 * scene_.frame.height + dy * (j + jitter * (rng_.unit() - 0.5)), perspective, false));
      }
    }
    const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        if (rng_.coin()) {
          scene_.list.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
          scene_.list.triangles.push_back({at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)});
        } else {
          scene_.list.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
          scene_.list.triangles.push_back({at(i + 1, j + 1), at(i, j), at(i + 1, j)});
        }
      }
    }
  }

  // Axis-aligned quads of two triangles, corners on texel centres, corners or anywhere: what a driver may take a short cut for.
  void rectangles(int count) {
    for (int n = 0; n < count; ++n) {
      const double step = one_of(rng_, {1.0, 0.5, 1.0 / grid_});
      const auto coordinate = [&](int extent) { return std::floor(rng_.unit() * extent / step) * step; };
      const double x0 = coordinate(scene_.frame.width), x1 = coordinate(scene_.frame.width), y0 = coordinate(scene_.frame.height),
                   y1 = coordinate(scene_.frame.height);
      const RasterVertex a = vertex(x0, y0, false, false), b = vertex(x1, y0, false, false), c = vertex(x1, y1, false, false),
                         d = vertex(x0, y1, false, false);
      triangle(a, b, c);
      triangle(a, c, d);
    }
  }

  // Pairs of nearly equal planes and exact copies: the depth order is the question.
  void depth_pairs(int count) {
    for (int n = 0; n < count; ++n) {
      const double x = rng_.unit() * scene_.frame.width, y = rng_.unit() * scene_.frame.height;
      const double size = 0.7 * std::max(scene_.frame.width, scene_.frame.height);
      std::array<RasterVertex, 3> a;
      for (RasterVertex& v : a) v = vertex(x + (rng_.unit() - 0.5) * size, y + (rng_.unit() - 0.5) * size, false, false);
      triangle(a[0], a[1], a[2]);
      for (RasterVertex& v : a) {
        v.color[0] = static_cast<float>(rng_.unit());
        if (rng_.coin()) v.z = std::clamp(v.z + static_cast<float>(rng_.between(-4, 4)) * 0x1p-22f, 0.0f, 1.0f);
      }
      triangle(a[2], a[0], a[1]);
    }
  }

 private:
  Rng& rng_;
  RandomScene& scene_;
  double grid_;
  double scale_x_ = 0, shear_x_ = 0, shift_x_ = 0, scale_y_ = 0, shear_y_ = 0, shift_y_ = 0;
};

Sampler random_sampler(Rng& rng, Filter filter) {
  return {filter, one_of(rng, {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat}),
          one_of(rng, {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat})};
}

}  // namespace

std::string to_string(SceneKind kind) {
  constexpr const char* kNames[] = {
      "affine colour", "affine nearest", "affine linear", "perspective colour", "perspective nearest", "perspective linear",
      "depth",         "indexed",        "slivers",       "shared mesh",        "rectangles"};
  return kNames[static_cast<int>(kind)];
}

RandomScene make_random_scene(std::uint64_t seed, const RasterState& device_state, int largest) {
  Rng rng(seed * 0x9E3779B97F4A7C15ull + 1);
  RandomScene scene;
  scene.kind = static_cast<SceneKind>(seed % kSceneKindCount);
  scene.frame.width = random_size(rng, largest);
  scene.frame.height = random_size(rng, largest);
  scene.frame.guard = one_of(rng, {0, 13, 64, 700, 2048, 7000});
  scene.frame.guard = std::min(scene.frame.guard, (16384 - std::max(scene.frame.width, scene.frame.height)) / 2);
  scene.frame.state = device_state;
  scene.frame.targets = random_targets(rng);

  const SceneKind kind = scene.kind;
  Draw draw;
  const bool color = kind == SceneKind::affine_color || kind == SceneKind::perspective_color || (kind == SceneKind::depth && rng.coin());
  draw.shading = color ? Shading::vertex_color : kind == SceneKind::indexed ? Shading::indexed : Shading::texture;
  const bool linear = kind == SceneKind::affine_linear || kind == SceneKind::perspective_linear ||
                      (kind != SceneKind::affine_nearest && kind != SceneKind::perspective_nearest && rng.below(3) == 0);
  draw.sampler = random_sampler(rng, linear ? Filter::linear : Filter::nearest);
  int mapped_width = 1, mapped_height = 1;
  if (draw.shading != Shading::vertex_color) {
    const PixelFormat format = random_format(rng, static_cast<int>(rng.between(1, 4)));
    scene.list.images.push_back(random_texture(rng, format, linear));
    draw.texture = 0;
    mapped_width = scene.list.images[0]->width();
    mapped_height = scene.list.images[0]->height();
  }
  if (draw.shading == Shading::indexed) {
    draw.map_sampler = random_sampler(rng, rng.coin() ? Filter::linear : Filter::nearest);
    scene.list.images.push_back(random_map(rng, *scene.list.images[0], draw.map_sampler.filter == Filter::linear));
    draw.indexing_map = 1;
    mapped_width = scene.list.images[1]->width();
    mapped_height = scene.list.images[1]->height();
  }

  SceneMaker make(rng, scene);
  make.choose_mapping(mapped_width, mapped_height);
  const bool perspective = kind == SceneKind::perspective_color || kind == SceneKind::perspective_nearest ||
                           kind == SceneKind::perspective_linear ||
                           ((kind == SceneKind::slivers || kind == SceneKind::shared_mesh || kind == SceneKind::indexed) && rng.coin());
  switch (kind) {
    case SceneKind::slivers: make.slivers(200, perspective); break;
    case SceneKind::shared_mesh: make.mesh(static_cast<int>(rng.between(2, 24)), rng.unit() * 0.8, perspective); break;
    case SceneKind::rectangles: make.rectangles(24); break;
    case SceneKind::depth: make.depth_pairs(12); break;
    default: make.random_triangles(12, 1.5, perspective); make.random_triangles(60, 0.2, perspective);
  }
  if (kind == SceneKind::rectangles || kind == SceneKind::slivers) scene.frame.state.depth_test = rng.coin();
  draw.triangle_count = static_cast<std::uint32_t>(scene.list.triangles.size());
  scene.list.draws.push_back(draw);
  return scene;
}

RandomScene make_exact_scene(std::uint64_t seed, const RasterState& device_state, int largest, bool nearest) {
  Rng rng(seed * 0xBF58476D1CE4E5B9ull + 7);
  RasterState state = device_state;
  state.half_rounding = rng.coin() ? HalfRounding::nearest_even : HalfRounding::toward_zero;
  if (rng.coin()) state.subtexel_bits = static_cast<int>(rng.between(1, device_state.subtexel_bits));
  RandomScene scene = make_random_scene(seed, state, largest);
  for (Draw& draw : scene.list.draws) {
    if (nearest) draw.sampler.filter = draw.map_sampler.filter = Filter::nearest;
  }
  for (TargetSpec& target : scene.frame.targets) {
    if (target.format.type == ChannelType::unorm8 && rng.coin()) target.format.type = ChannelType::srgb8;
  }
  for (auto& image : scene.list.images) {
    if (image->format().type != ChannelType::unorm8 || rng.coin()) continue;
    Image srgb(image->width(), image->height(), {ChannelType::srgb8, image->format().channels});
    std::copy(image->bytes().begin(), image->bytes().end(), srgb.bytes().begin());
    image = std::make_shared<const Image>(std::move(srgb));
  }
  return scene;
}

}  // namespace etalon::test
