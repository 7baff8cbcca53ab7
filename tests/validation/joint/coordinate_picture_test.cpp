#include "validation/joint/coordinate_picture.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "raster/cpu_renderer.h"
#include "raster/simd_level.h"
#include "validation/joint/screen_errors.h"
#include "validation/metrics/image_difference.h"

using namespace etalon;
using namespace etalon::validation;

namespace {

float chance(Rng& rng, double low, double high) {
  return static_cast<float>(low + (high - low) * static_cast<double>(rng.below(1'000'000)) / 1e6);
}

/// Triangles of any coordinates, some outside [0, 1], in front of a camera at z = 3.
Mesh chance_mesh(std::uint64_t seed, int triangles, double uv_low, double uv_high) {
  Rng rng(seed);
  Mesh mesh;
  mesh.has_uv = true;
  for (int t = 0; t < triangles; ++t) {
    std::array<WedgeId, 3> face;
    for (WedgeId& corner : face) {
      const float x = chance(rng, -2, 2), y = chance(rng, -2, 2), z = chance(rng, -1, 1), u = chance(rng, uv_low, uv_high);
      mesh.positions.emplace_back(x, y, z);
      mesh.wedges.push_back({VertexId(mesh.positions.size() - 1), Vec2f(u, chance(rng, uv_low, uv_high))});
      corner = WedgeId(mesh.wedges.size() - 1);
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

Image chance_texture(std::uint64_t seed, int width, int height) {
  Rng rng(seed);
  Image image(width, height, kRgba8);
  for (std::byte& b : image.bytes()) b = static_cast<std::byte>(rng.below(256));
  return opaque_rgba(image);
}

const PictureFrame kFrame{.camera = {}, .width = 160, .height = 120};

}  // namespace

TEST_CASE("a picture looked up through coordinates has the bytes of both passes drawn") {
  raster::CpuRenderer exact;
  struct Size {
    int width, height;
  };
  // Powers of two (weights without rounding), others (with), the least.
  for (const Size size : {Size{64, 64}, Size{256, 32}, Size{100, 37}, Size{495, 495}, Size{3, 1000}, Size{2, 2}})
    for (const double reach : {0.0, 0.3}) {
      const Mesh mesh = chance_mesh(static_cast<std::uint64_t>(size.width), 12, -reach, 1 + reach);
      const auto texture = std::make_shared<const Image>(chance_texture(7, size.width, size.height));
      const CoordinatePicture through(draw_coordinates(exact, mesh, kFrame), size.width, size.height);
      CHECK(through.covered_texels() > 1000);
      CHECK(through.covered_texels() < 160 * 120);
      CHECK(differing_texels(through.picture(*texture), draw_in_two_passes(exact, mesh, texture, kFrame)) == 0);
    }
}

TEST_CASE("values half way between two numbers are rounded as the renderer rounds them") {
  // A square of two texels' width over 2^n pixels: most weights are multiples of a power of two, so that ties abound.
  Mesh mesh;
  mesh.has_uv = true;
  for (int corner = 0; corner < 4; ++corner) {
    mesh.positions.emplace_back(static_cast<float>(corner & 1) * 4 - 2, static_cast<float>(corner >> 1) * 4 - 2, 0.0f);
    mesh.wedges.push_back(
        {VertexId(static_cast<std::size_t>(corner)), Vec2f(static_cast<float>(corner & 1), static_cast<float>(corner >> 1))});
  }
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(3u)}, {WedgeId(0u), WedgeId(3u), WedgeId(2u)}};
  const PictureFrame frame{.camera = {.eye = {0, 0, 4}, .tan_half_fov_y = 0.5}, .width = 128, .height = 128};
  raster::CpuRenderer exact;
  for (const int size : {2, 4, 3, 12, 24}) {
    Rng rng(static_cast<std::uint64_t>(size));
    Image image(size, size, kRgba8);
    for (std::byte& b : image.bytes()) b = static_cast<std::byte>(rng.below(4));
    const auto texture = std::make_shared<const Image>(opaque_rgba(image));
    const CoordinatePicture through(draw_coordinates(exact, mesh, frame), size, size);
    CHECK(through.covered_texels() == 128 * 128);
    CHECK(differing_texels(through.picture(*texture), draw_in_two_passes(exact, mesh, texture, frame)) == 0);
  }
}

TEST_CASE("the sum of squared differences is that of the pictures' RGB, uncovered texels black") {
  raster::CpuRenderer exact;
  const Mesh mesh = chance_mesh(1, 8, 0, 1), other = chance_mesh(2, 8, 0, 1);
  const Image texture = chance_texture(3, 64, 48), blurred = chance_texture(4, 64, 48);
  const CoordinatePicture one(draw_coordinates(exact, mesh, kFrame), 64, 48), two(draw_coordinates(exact, other, kFrame), 64, 48);
  const Image reference = one.picture(texture);
  CHECK(one.sse(texture, one.reference(reference)) == 0);
  const ImageDifference difference = measure_difference(two.picture(blurred), reference);
  const std::uint64_t rgb = difference.channels[0].sse + difference.channels[1].sse + difference.channels[2].sse;
  CHECK(rgb > 0);
  CHECK(two.sse(blurred, two.reference(reference)) == rgb);
}

TEST_CASE("errors by vectors of every kind, one texture or a group at a time, are the pictures' own") {
  raster::CpuRenderer exact;
  const Mesh mesh = chance_mesh(5, 9, -0.1, 1.1);
  const raster::SimdLevel level = raster::simd_level();
  // 64 x 32: ties abound in 2 x 2 texels of 0 and 1; 61 x 33: weights are rounded.
  for (const auto& [width, height] : {std::pair{64, 32}, {61, 33}, {2, 2}}) {
    const CoordinatePicture through(draw_coordinates(exact, mesh, kFrame), width, height);
    REQUIRE(through.covered_texels() % 16 != 0);
    std::vector<Image> textures;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      textures.push_back(chance_texture(seed, width, height));
      if (seed % 2 == 1)
        for (std::size_t n = 0; n < textures.back().bytes().size(); ++n)
          if (n % 4 != 3) textures.back().bytes()[n] &= std::byte{1};
    }
    const CoordinatePicture::Reference reference = through.reference(chance_texture(99, kFrame.width, kFrame.height));
    std::vector<std::uint64_t> wanted;
    for (const Image& texture : textures) {
      const ImageDifference d = measure_difference(through.picture(texture), chance_texture(99, kFrame.width, kFrame.height));
      wanted.push_back(d.channels[0].sse + d.channels[1].sse + d.channels[2].sse);
    }
    for (const raster::SimdLevel each : raster::available_simd_levels()) {
      raster::set_simd_level(each);
      CAPTURE(raster::to_string(each));
      for (std::size_t t = 0; t < textures.size(); ++t) CHECK(through.sse(textures[t], reference) == wanted[t]);
      for (const std::size_t count : {8, 3, 1}) {
        const TextureGroup group(std::span<const Image>(textures).first(count));
        const TextureGroup::Sums sums = through.sse(group, reference);
        for (std::size_t t = 0; t < count; ++t) CHECK(sums[t] == wanted[t]);
      }
    }
    raster::set_simd_level(level);
  }
}

TEST_CASE("screen errors draw each mesh once for all its textures") {
  raster::CpuRenderer exact;
  const std::vector<Mesh> meshes = {chance_mesh(1, 4, 0, 1), chance_mesh(2, 6, 0, 1)};
  const std::vector<Image> textures = {chance_texture(3, 16, 16), chance_texture(4, 16, 16), chance_texture(5, 16, 16)};
  const Image reference = CoordinatePicture(draw_coordinates(exact, meshes[1], kFrame), 16, 16).picture(textures[2]);
  ScreenErrors errors(exact, {kFrame, [&](std::size_t i) { return meshes[i]; }, textures, reference});
  CHECK(errors.samples() == 3 * 160 * 120);
  for (std::size_t i : {1, 0})
    for (std::size_t j : {2, 1, 0}) {
      const Image drawn = draw_in_two_passes(exact, meshes[i], std::make_shared<const Image>(textures[j]), kFrame);
      CHECK(errors.picture(i, j) == drawn);
      const ImageDifference d = measure_difference(drawn, reference);
      CHECK(errors.sse(i, j) == d.channels[0].sse + d.channels[1].sse + d.channels[2].sse);
    }
  CHECK(errors.sse(1, 2) == 0);
  CHECK(errors.meshes_drawn() == 2);
  const std::vector<std::uint64_t> row = errors.sse_of_mesh(0);
  REQUIRE(row.size() == 3);
  for (std::size_t j = 0; j < 3; ++j) CHECK(row[j] == errors.sse(0, j));
  CHECK(errors.meshes_drawn() == 3);
  CHECK(errors.sse_of_mesh(0) == row);
  CHECK(errors.meshes_drawn() == 3);
  errors.forget_drawings();
  CHECK(errors.sse_of_mesh(1)[2] == 0);
  CHECK(errors.meshes_drawn() == 4);
}

TEST_CASE("errors of a mesh that shares triangles with the one before are those of the mesh alone") {
  raster::CpuRenderer exact;
  std::vector<Mesh> meshes;
  for (const int kept : {12, 11, 3, 0}) {  // all, but one, few and none of the first mesh's triangles; others in their places
    Mesh mesh = chance_mesh(1, 12, 0, 1);
    const Mesh other = chance_mesh(static_cast<std::uint64_t>(2 + kept), 12, 0, 1);
    for (std::size_t v = 3 * static_cast<std::size_t>(kept); v < mesh.positions.size(); ++v)
      mesh.positions[v] = other.positions[v], mesh.wedges[v] = other.wedges[v];
    meshes.push_back(std::move(mesh));
  }
  Mesh moved = meshes[0];
  for (Wedge& wedge : moved.wedges) wedge.uv.y = std::nextafter(wedge.uv.y, 2.0f);  // every texel covered, at another coordinate
  meshes.push_back(std::move(moved));
  std::vector<Image> textures;
  for (std::uint64_t seed = 0; seed < 11; ++seed) textures.push_back(chance_texture(seed, 48, 16));
  const Image reference = CoordinatePicture(draw_coordinates(exact, meshes[0], kFrame), 48, 16).picture(textures[10]);
  ScreenErrors in_turn(exact, {kFrame, [&](std::size_t i) { return meshes[i]; }, textures, reference});
  for (const std::size_t i : {0, 1, 2, 3, 0, 4, 0, 3}) {
    CAPTURE(i);
    ScreenErrors alone(exact, {kFrame, [&](std::size_t k) { return meshes[k]; }, textures, reference});
    const std::vector<std::uint64_t> errors = in_turn.sse_of_mesh(i);
    CHECK(errors == alone.sse_of_mesh(i));
    for (const std::size_t t : {0, 7, 10}) CHECK(errors[t] == alone.sse(i, t));
  }
}

TEST_CASE("what two drawings show alike is hidden in both, and nothing else") {
  raster::CpuRenderer exact;
  Mesh mesh = chance_mesh(1, 12, 0, 1);
  const DrawnCoordinates one = draw_coordinates(exact, mesh, kFrame);
  for (std::size_t v = 30; v < 36; ++v) mesh.wedges[v].uv = {0.25f, 0.75f};
  mesh.positions[0].x += 0.5f;
  const DrawnCoordinates other = draw_coordinates(exact, mesh, kFrame);
  DrawnCoordinates rest = one, rest_of_other = other;
  hide_what_both_show(rest, rest_of_other);
  std::size_t hidden = 0, left = 0;
  for (int y = 0; y < kFrame.height; ++y)
    for (int x = 0; x < kFrame.width; ++x) {
      const std::uint32_t a = *one.ids.channels<std::uint32_t>(x, y), b = *other.ids.channels<std::uint32_t>(x, y);
      const auto *uv = one.coordinates->channels<float>(x, y), *other_uv = other.coordinates->channels<float>(x, y);
      const bool alike = a != kNoTriangle && b != kNoTriangle && uv[0] == other_uv[0] && uv[1] == other_uv[1];
      hidden += alike ? 1 : 0, left += !alike && (a != kNoTriangle || b != kNoTriangle) ? 1 : 0;
      REQUIRE(*rest.ids.channels<std::uint32_t>(x, y) == (alike ? kNoTriangle : a));
      REQUIRE(*rest_of_other.ids.channels<std::uint32_t>(x, y) == (alike ? kNoTriangle : b));
    }
  CHECK(hidden > 1000);
  CHECK(left > 1000);
}

TEST_CASE("textures of one texel's width, and of formats without bytes, are refused") {
  raster::CpuRenderer exact;
  const DrawnCoordinates drawn = draw_coordinates(exact, chance_mesh(1, 2, 0, 1), kFrame);
  CHECK_THROWS_AS(CoordinatePicture(drawn, 1, 8), InputError);
  CHECK_THROWS_AS((void)opaque_rgba(Image(2, 2, kRg32f)), InputError);
  Image grey(2, 2, {ChannelType::unorm8, 1});
  *grey.channels<std::uint8_t>(1, 1) = 77;
  const Image opaque = opaque_rgba(grey);
  CHECK(opaque.channels<std::uint8_t>(1, 1)[2] == 77);
  CHECK(opaque.channels<std::uint8_t>(0, 0)[3] == 255);
  CHECK(without_alpha(opaque).format() == kRgb8);
  CHECK(without_alpha(opaque).channels<std::uint8_t>(1, 1)[1] == 77);
  CHECK_THROWS_AS((void)without_alpha(grey), InternalError);
}
