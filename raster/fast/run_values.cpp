#include "raster/fast/run_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/fast/texel_lanes.h"

namespace etalon::raster::fast {

PlaneLayout plane_layout(const DrawList& list, const Frame& frame) {
  PlaneLayout layout;
  const auto add = [&](PlaneAttribute first, int count) {
    for (int n = 0; n < count; ++n) layout.add(static_cast<PlaneAttribute>(first + n));
  };
  for (const TargetSpec& target : frame.targets) {
    if (target.content == TargetContent::barycentrics) add(kPlaneWeight0, 3);
    if (target.content == TargetContent::coordinate) add(kPlaneU, 2);
    if (target.content == TargetContent::margins) layout.add_edges();
    if (target.content != TargetContent::color && target.content != TargetContent::margins) continue;
    for (const Draw& draw : list.draws) {
      if (draw.shading != Shading::vertex_color) {
        add(kPlaneU, 2);
      } else if (target.content == TargetContent::color) {
        add(kPlaneRed, target.format.channels);
      }
    }
  }
  return layout;
}

std::vector<double> largest_texels(const DrawList& list) {
  std::vector<double> largest(list.images.size(), 1);
  std::vector<bool> wanted(list.images.size(), false);
  for (const Draw& draw : list.draws) {
    if (draw.shading == Shading::vertex_color) continue;
    if (draw.sampler.filter == Filter::linear) wanted[draw.texture] = true;
    if (draw.shading == Shading::indexed && draw.map_sampler.filter == Filter::linear) wanted[draw.indexing_map] = true;
  }
  for (std::size_t n = 0; n < list.images.size(); ++n)
    if (wanted[n]) largest[n] = largest_texel(*list.images[n]);
  return largest;
}

const Positions& RunValues::positions() {
  if (!has_positions_) context_.kernels.positions(triangles_, lanes_, column_, row_, positions_), has_positions_ = true;
  return positions_;
}

void RunValues::evaluate(PlaneAttribute a, Values& result) {
  context_.kernels.attribute(triangles_, lanes_, context_.layout.offset(a), context_.layout.error(a), positions(), result);
}

void RunValues::interpolate_uv() {
  if (!has_uv_) evaluate(kPlaneU, uv_[0]), evaluate(kPlaneV, uv_[1]), has_uv_ = true;
}

LaneMask RunValues::store_planes(PlaneAttribute first, const TargetSpec& target, std::byte* texels) {
  for (int c = 0; c < target.format.channels; ++c) evaluate(static_cast<PlaneAttribute>(first + c), value_[c]);
  return store_values(target, texels);
}

LaneMask RunValues::store_coordinate(const TargetSpec& target, std::byte* texels) { return store_planes(kPlaneU, target, texels); }
LaneMask RunValues::store_barycentrics(const TargetSpec& target, std::byte* texels) { return store_planes(kPlaneWeight0, target, texels); }

LaneMask RunValues::store_margins(const Draw& draw, const FloatLanes& gap, std::byte* texels) {
  if (context_.frame.state.subtexel_bits > kMostEdgeBits) return ~LaneMask{0};
  LaneMask undecided = context_.kernels.edge_distance(triangles_, lanes_, context_.layout.edges(), positions(), float_[0]);
  if (draw.shading == Shading::vertex_color) {
    for (int axis = 0; axis < 2; ++axis) std::fill_n(float_[1 + axis].at, lanes_, std::numeric_limits<float>::infinity());
  } else {
    interpolate_uv();
    const bool indexed = draw.shading == Shading::indexed;
    const Image& image = *context_.list.images[indexed ? draw.indexing_map : draw.texture];
    const double offset = (indexed ? draw.map_sampler : draw.sampler).filter == Filter::linear ? 0.5 : 0;
    undecided |= context_.kernels.border_distance(uv_[0], lanes_, image.width(), offset, float_[1]);
    undecided |= context_.kernels.border_distance(uv_[1], lanes_, image.height(), offset, float_[2]);
  }
  float_[3] = gap;
  interleave<float>(float_, lanes_, 4, texels);
  return undecided;
}

LaneMask RunValues::store_color(const Draw& draw, const TargetSpec& target, std::byte* texels) {
  if (draw.shading == Shading::vertex_color) return store_planes(kPlaneRed, target, texels);
  const Image& texture = *context_.list.images[draw.texture];
  const bool copied = draw.sampler.filter == Filter::nearest && copies(texture.format(), target.format);
  if (copied && draw.shading == Shading::texture) return copy_nearest(texture, draw.sampler, target.format, texels);
  if (draw.shading == Shading::texture && draw.sampler.filter == Filter::linear && texture.format() == kRg32f && target.format == kRg32f)
    return linear_pairs(texture, draw.sampler, context_.largest[draw.texture], texels);
  interpolate_uv();
  LaneMask undecided = 0;
  if (draw.shading == Shading::indexed) {
    undecided = through_map(draw);
  } else {
    coordinate_[0] = uv_[0], coordinate_[1] = uv_[1];
  }
  if (copied) {
    undecided |= nearest(texture, draw.sampler);
    copy_texels(texture, offset_[0], lanes_, target.format, context_.kernels, texels);
    return undecided;
  }
  undecided |= look_up(texture, draw.sampler, context_.largest[draw.texture], target.format.channels);
  return undecided | store_values(target, texels);
}

LaneMask RunValues::copy_nearest(const Image& image, const Sampler& sampler, PixelFormat target, std::byte* texels) {
  const TexelGrid grid = {image.width(), image.height(), sampler.wrap_u, sampler.wrap_v};
  const LaneMask undecided = context_.kernels.nearest_texels(triangles_, lanes_, column_, row_, context_.layout.offset(kPlaneU),
                                                             context_.layout.offset(kPlaneV), grid, offset_[0]);
  copy_texels(image, offset_[0], lanes_, target, context_.kernels, texels);
  return undecided;
}

LaneMask RunValues::linear_pairs(const Image& image, const Sampler& sampler, double largest, std::byte* texels) {
  const TexelGrid grid = {image.width(), image.height(), sampler.wrap_u, sampler.wrap_v};
  return context_.kernels.linear_float_pairs(triangles_, lanes_, column_, row_, context_.layout.offset(kPlaneU),
                                             context_.layout.offset(kPlaneV), grid, image.channels<float>(0, 0), std::max(largest, 1.0),
                                             texels);
}

// Texel offsets of coordinate_ into offset_[0].
LaneMask RunValues::nearest(const Image& image, const Sampler& sampler) {
  const LaneMask undecided = context_.kernels.nearest_axis(coordinate_[0], lanes_, image.width(), sampler.wrap_u, index_[0]) |
                             context_.kernels.nearest_axis(coordinate_[1], lanes_, image.height(), sampler.wrap_v, index_[1]);
  context_.kernels.texel_offsets(index_[0], index_[1], lanes_, image.width(), offset_[0]);
  return undecided;
}

// The four texels around coordinate_ into offset_, their weights into axis_.
LaneMask RunValues::linear(const Image& image, const Sampler& sampler) {
  const Kernels& k = context_.kernels;
  const LaneMask undecided = k.linear_axis(coordinate_[0], lanes_, image.width(), sampler.wrap_u, axis_[0]) |
                             k.linear_axis(coordinate_[1], lanes_, image.height(), sampler.wrap_v, axis_[1]);
  k.texel_offsets(axis_[0].first, axis_[1].first, lanes_, image.width(), offset_[0]);
  k.texel_offsets(axis_[0].second, axis_[1].first, lanes_, image.width(), offset_[1]);
  k.texel_offsets(axis_[0].first, axis_[1].second, lanes_, image.width(), offset_[2]);
  k.texel_offsets(axis_[0].second, axis_[1].second, lanes_, image.width(), offset_[3]);
  return undecided;
}

// Channels of the image at coordinate_ into value_.
LaneMask RunValues::look_up(const Image& image, const Sampler& sampler, double largest, int channels) {
  if (sampler.filter == Filter::nearest) {
    const LaneMask undecided = nearest(image, sampler);
    for (int c = 0; c < channels; ++c) {
      const TexelUnit unit = texel_unit(image.format(), c);
      read_channel(image, offset_[0], lanes_, c, texel_[0]);
      for (int n = 0; n < lanes_; ++n) {
        const double value = texel_[0].at[n] * unit.scale;
        value_[c].value.at[n] = value;
        value_[c].error.at[n] = unit.exact ? 0 : std::abs(value) * 0x1p-51;  // scale and product, and one rounding where it is used
      }
    }
    return undecided;
  }
  const LaneMask undecided = linear(image, sampler);
  if (image.format() == kRgba8) {
    context_.kernels.bilinear_rgba8(image.bytes().data(), offset_, axis_[0], axis_[1], lanes_, value_);
  } else {
    interpolate(image, largest, channels);
  }
  return undecided;
}

void RunValues::interpolate(const Image& image, double largest, int channels) {
  for (int c = 0; c < channels; ++c) {
    for (int n = 0; n < 4; ++n) {
      read_channel(image, offset_[n], lanes_, c, texel_[n]);
      for (int lane = 0; lane < lanes_; ++lane)  // what is filtered is canonical
        if (std::abs(texel_[n].at[lane]) < 0x1p-40) texel_[n].at[lane] = 0;
    }
    const TexelUnit unit = texel_unit(image.format(), c);
    context_.kernels.bilinear(texel_, axis_[0], axis_[1], lanes_, unit.scale, std::max(largest, 1.0) / unit.scale, value_[c]);
  }
}

// The indexing map's two channels as the coordinates of the second lookup.
LaneMask RunValues::through_map(const Draw& draw) {
  coordinate_[0] = uv_[0], coordinate_[1] = uv_[1];
  const Image& map = *context_.list.images[draw.indexing_map];
  LaneMask undecided = look_up(map, draw.map_sampler, context_.largest[draw.indexing_map], 2);
  for (int c = 0; c < 2; ++c) {
    coordinate_[c] = value_[c];
    if (draw.map_sampler.filter == Filter::linear) {  // rounded once to float32
      undecided |= context_.kernels.to_float32(value_[c], lanes_, float_[c]);
      for (int n = 0; n < lanes_; ++n) coordinate_[c].value.at[n] = canonical(float_[c].at[n]);
    }
    if (draw.map_sampler.filter == Filter::linear ||
        texel_unit(map.format(), c).exact)  // what is left is the product with the image's size
      for (int n = 0; n < lanes_; ++n) coordinate_[c].error.at[n] = std::abs(coordinate_[c].value.at[n]) * 0x1p-52;
  }
  return undecided;
}

LaneMask RunValues::store_values(const TargetSpec& target, std::byte* texels) {
  const int channels = target.format.channels;
  const Kernels& k = context_.kernels;
  LaneMask undecided = 0;
  switch (target.format.type) {
    case ChannelType::unorm8:
    case ChannelType::unorm16:
      for (int c = 0; c < channels; ++c)
        undecided |= k.to_unorm(value_[c], lanes_, target.format.type == ChannelType::unorm8 ? 255 : 65535, integer_[c]);
      if (target.format.type == ChannelType::unorm8) {
        interleave<std::uint8_t>(integer_, lanes_, channels, texels);
      } else {
        interleave<std::uint16_t>(integer_, lanes_, channels, texels);
      }
      return undecided;
    case ChannelType::float32:
      for (int c = 0; c < channels; ++c) undecided |= k.to_float32(value_[c], lanes_, float_[c]);
      interleave<float>(float_, lanes_, channels, texels);
      return undecided;
    default: return store_lanes(value_, lanes_, target, context_.frame.state.half_rounding, texels);
  }
}

}  // namespace etalon::raster::fast
