#include "validation/mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "validation/texel_lookup.h"

namespace etalon::validation {
namespace {

constexpr std::size_t kMostImages = 6;  // exchanged with each other: the pairs grow with the square

// A copy with every vertex changed, by the image that its draw looks up at uv. Vertices are unshared first.
template <class Change>
DrawList with_vertices(const DrawList& list, Change&& change) {
  DrawList out = list;
  out.vertices.clear();
  for (std::uint32_t t = 0; t < list.triangles.size(); ++t) {
    const Draw& draw = list.draw_of(t);
    const std::uint32_t image = draw.shading == Shading::indexed ? draw.indexing_map : draw.texture;
    for (std::size_t k = 0; k < 3; ++k) {
      RasterVertex v = list.vertices[list.triangles[t][k]];
      change(v, draw.shading == Shading::vertex_color ? nullptr : list.images[image].get());
      out.triangles[t][k] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(v);
    }
  }
  return out;
}

template <class Change>
DrawList with_samplers(const DrawList& list, Change&& change) {
  DrawList out = list;
  for (Draw& draw : out.draws) {
    change(draw.sampler);
    change(draw.map_sampler);
  }
  return out;
}

DrawList with_uv_shift(const DrawList& list, float du_texel, float dv_texel) {
  return with_vertices(list, [&](RasterVertex& v, const Image* image) {
    if (image != nullptr) v.uv += Vec2f(du_texel / static_cast<float>(image->width()), dv_texel / static_cast<float>(image->height()));
  });
}

// Box filtered from level to level, stored as the level before it was: 8 bits rounded to nearest, as drivers do.
Image half_size(const Image& image) {
  const int width = std::max(1, image.width() / 2), height = std::max(1, image.height() / 2), channels = image.format().channels;
  const bool bytes = image.format().type == ChannelType::unorm8;
  Image small(width, height, bytes ? image.format() : PixelFormat{ChannelType::float32, channels});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) {
        const int x0 = std::min(2 * x, image.width() - 1), y0 = std::min(2 * y, image.height() - 1);
        const int x1 = std::min(x0 + 1, image.width() - 1), y1 = std::min(y0 + 1, image.height() - 1);
        const double sum =
            texel_value(image, x0, y0, c) + texel_value(image, x1, y0, c) + texel_value(image, x0, y1, c) + texel_value(image, x1, y1, c);
        if (bytes)
          small.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>((std::lround(sum * 255) + 2) / 4);
        else
          small.channels<float>(x, y)[c] = static_cast<float>(sum / 4);
      }
  return small;
}

DrawList with_mip_level(const DrawList& list, int level) {
  DrawList out = list;
  for (auto& image : out.images) {
    Image small = half_size(*image);
    for (int k = 1; k < level; ++k) small = half_size(small);
    image = std::make_shared<const Image>(std::move(small));
  }
  return out;
}

DrawList with_srgb_images(const DrawList& list) {
  DrawList out = list;
  for (auto& image : out.images) {
    if (image->format().type != ChannelType::unorm8) continue;
    Image curved(image->width(), image->height(), {ChannelType::srgb8, image->format().channels});
    std::copy(image->bytes().begin(), image->bytes().end(), curved.bytes().begin());
    image = std::make_shared<const Image>(std::move(curved));
  }
  return out;
}

struct Maker {
  const DrawList& list;
  const Frame& frame;
  const DeviceModel& device;
  std::vector<Mistake> mistakes;

  void add(const std::string& name, std::function<SupposedDrawing()> make) { mistakes.push_back({name, {std::move(make)}}); }
  template <class Make>
  void add_list(const std::string& name, Make&& make) {
    add(name, [this_list = &list, this_frame = &frame, this_device = &device, make] {
      return SupposedDrawing{make(*this_list), *this_frame, *this_device};
    });
  }
  template <class Change>
  void add_frame(const std::string& name, Change&& change) {
    add(name, [this_list = &list, this_frame = &frame, this_device = &device, change] {
      SupposedDrawing drawing{*this_list, *this_frame, *this_device};
      change(drawing.frame);
      return drawing;
    });
  }
  template <class Change>
  void add_device(const std::string& name, Change&& change) {
    add(name, [this_list = &list, this_frame = &frame, this_device = &device, change] {
      SupposedDrawing drawing{*this_list, *this_frame, *this_device};
      change(drawing.device);
      return drawing;
    });
  }

  void fill_rules();
  void texture_places();
  void samplers();
  void other_images();
  void geometry();
  void storage();
  void coordinate_bits();
};

void Maker::fill_rules() {
  for (const FillRule rule : {FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax}) {
    if (rule == frame.state.fill_rule) continue;
    add_frame("fill rule " + to_string(rule), [rule](Frame& f) { f.state.fill_rule = rule; });
    mistakes.back().touches_few = true;
  }
}

void Maker::texture_places() {
  for (const int axis : {0, 1}) {
    for (const float half : {0.5f, -0.5f}) {
      add_list(fmt::format("texture coordinate shifted by {}1/2 texel in {}", half > 0 ? '+' : '-', axis == 0 ? 'u' : 'v'),
               [=](const DrawList& l) { return with_uv_shift(l, axis == 0 ? half : 0, axis == 0 ? 0 : half); });
    }
  }
  for (const float half : {0.5f, -0.5f}) {
    add_list(fmt::format("texture coordinate shifted by {}1/2 texel in u and v", half > 0 ? '+' : '-'),
             [=](const DrawList& l) { return with_uv_shift(l, half, half); });
  }
  add_list("v flipped", [](const DrawList& l) { return with_vertices(l, [](RasterVertex& v, const Image*) { v.uv.y = 1 - v.uv.y; }); });
}

void Maker::samplers() {
  for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat})
    add_list("wrap " + to_string(wrap),
             [=](const DrawList& l) { return with_samplers(l, [=](Sampler& s) { s.wrap_u = s.wrap_v = wrap; }); });
  for (const Filter filter : {Filter::nearest, Filter::linear})
    add_list("filter " + to_string(filter), [=](const DrawList& l) { return with_samplers(l, [=](Sampler& s) { s.filter = filter; }); });
}

void Maker::other_images() {
  // Levels below 4 texels hold next to nothing, and an image of integers has none.
  int smallest = 1 << 14;
  bool real = true;
  for (const auto& image : list.images) {
    smallest = std::min({smallest, image->width(), image->height()});
    real = real && image->format().type != ChannelType::uint32;
  }
  Mistake mips{"mip levels", {}};
  for (int level = 1; real && level <= 5 && (smallest >> level) >= 4; ++level)
    mips.alternatives.push_back([this_list = &list, this_frame = &frame, this_device = &device, level] {
      return SupposedDrawing{with_mip_level(*this_list, level), *this_frame, *this_device};
    });
  if (!mips.alternatives.empty()) mistakes.push_back(std::move(mips));
  if (list.images.size() <= kMostImages) {
    for (std::uint32_t i = 0; i < list.images.size(); ++i)
      for (std::uint32_t k = 0; k < list.images.size(); ++k) {
        const auto is_i = [i](const Draw& draw) { return draw.shading != Shading::vertex_color && draw.texture == i; };
        if (i == k || std::none_of(list.draws.begin(), list.draws.end(), is_i)) continue;
        add_list(fmt::format("image {} in the place of image {}", k, i), [=](const DrawList& l) {
          DrawList out = l;
          for (Draw& draw : out.draws)
            if (is_i(draw)) draw.texture = k;
          return out;
        });
      }
  }
  add_list("textures decoded as sRGB", with_srgb_images);
}

void Maker::geometry() {
  const int bits = frame.state.subtexel_bits;
  const std::int32_t half = 1 << (bits - 1);
  const struct {
    const char* name;
    int x, y;
  } shifts[] = {{"+1/2 texel in x", 1, 0},  {"-1/2 texel in x", -1, 0},      {"+1/2 texel in y", 0, 1},
                {"-1/2 texel in y", 0, -1}, {"+1/2 texel in x and y", 1, 1}, {"-1/2 texel in x and y", -1, -1}};
  for (const auto& shift : shifts)
    add_list(fmt::format("geometry shifted by {}", shift.name), [half, shift](const DrawList& l) {
      DrawList out = l;
      for (RasterVertex& v : out.vertices) v.x += half * shift.x, v.y += half * shift.y;
      return out;
    });
  for (const int coarse : {8, 4}) {
    if (coarse >= bits) continue;
    add_list(fmt::format("positions on a grid of {} sub-texel bits", coarse), [drop = bits - coarse](const DrawList& l) {
      DrawList out = l;
      const double step = std::ldexp(1.0, drop);
      for (RasterVertex& v : out.vertices) {
        v.x = static_cast<std::int32_t>(std::nearbyint(v.x / step) * step);
        v.y = static_cast<std::int32_t>(std::nearbyint(v.y / step) * step);
      }
      return out;
    });
  }
  if (frame.state.depth_test) add_frame("no depth test", [](Frame& f) { f.state.depth_test = false; });
  add_list("attributes interpolated without perspective", [](const DrawList& l) {
    DrawList out = l;
    for (RasterVertex& v : out.vertices) v.w = 1;
    return out;
  });
}

void Maker::storage() {
  add_device("unorm stored toward zero", [](DeviceModel& d) { d.unorm_toward_zero = true; });
  const bool was_nearest = frame.state.half_rounding == HalfRounding::nearest_even;
  add_frame(was_nearest ? "half stored toward zero" : "half stored to nearest even",
            [=](Frame& f) { f.state.half_rounding = was_nearest ? HalfRounding::toward_zero : HalfRounding::nearest_even; });
  for (const auto& [from, to, name] : {std::tuple{ChannelType::unorm8, ChannelType::srgb8, "colours stored by the sRGB curve"},
                                       std::tuple{ChannelType::srgb8, ChannelType::unorm8, "colours stored without the sRGB curve"}}) {
    const auto is_from = [type = from](const TargetSpec& t) { return t.content == TargetContent::color && t.format.type == type; };
    if (std::any_of(frame.targets.begin(), frame.targets.end(), is_from))
      add_frame(name, [is_from, type = to](Frame& f) {
        for (TargetSpec& target : f.targets)
          if (is_from(target)) target.format.type = type;
      });
  }
}

void Maker::coordinate_bits() {
  for (const int bits : {8, 4}) {
    const double error = std::ldexp(1.0, -bits);
    if (device.coordinate_error_texel >= error) continue;
    add_device(fmt::format("texture coordinates, or weights of the filter, of {} bits", bits),
               [error](DeviceModel& d) { d.coordinate_error_texel = error; });
    mistakes.back().last_resort = true;
  }
}

}  // namespace

std::vector<Mistake> usual_mistakes(const DrawList& list, const Frame& frame, const DeviceModel& device) {
  Maker maker{list, frame, device, {}};
  const bool textured = std::any_of(list.draws.begin(), list.draws.end(), [](const Draw& d) { return d.shading != Shading::vertex_color; });
  maker.fill_rules();
  if (textured) {
    maker.texture_places();
    maker.samplers();
    maker.other_images();
  }
  const auto as_it_is = [&list, &frame, &device] { return SupposedDrawing{list, frame, device}; };
  maker.mistakes.push_back({"picture upside down", {as_it_is}, CandidateReading::upside_down});
  if (!frame.targets.empty() && frame.targets.front().content == TargetContent::color && frame.targets.front().format.channels >= 3)
    maker.mistakes.push_back({"red and blue exchanged", {as_it_is}, CandidateReading::red_blue_exchanged});
  maker.geometry();
  maker.storage();
  if (textured) maker.coordinate_bits();
  return std::move(maker.mistakes);
}

Image read_as(const Image& image, CandidateReading reading) {
  Image result = image;
  if (image.empty() || reading == CandidateReading::plain) return result;
  if (reading == CandidateReading::upside_down) {
    const auto row = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(bytes_per_texel(image.format()));
    for (int y = 0; y < image.height(); ++y) std::memcpy(result.texel(0, y), image.texel(0, image.height() - 1 - y), row);
    return result;
  }
  if (image.format().channels < 3) return result;
  const auto size = static_cast<std::size_t>(bytes_per_channel(image.format().type));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      std::byte* texel = result.texel(x, y);
      std::swap_ranges(texel, texel + size, texel + 2 * size);
    }
  return result;
}

}  // namespace etalon::validation
