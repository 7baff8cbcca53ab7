// The judge on cases small enough to compute by hand, in both arithmetics.

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>

#include "core/base/error.h"
#include "validation/reference/sample.h"

namespace etalon::validation::reference {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::int32_t kTexel = 256;
constexpr auto kBoth = {Arithmetic::integer, Arithmetic::rational};

RasterVertex vertex(float x_texel, float y_texel) {
  RasterVertex v;
  v.x = static_cast<std::int32_t>(x_texel * kTexel);
  v.y = static_cast<std::int32_t>(y_texel * kTexel);
  return v;
}

struct Case {
  DrawList list;
  Frame frame;
  std::vector<TexelBytes> texel(int i, int j, Arithmetic arithmetic) const {
    validate(list, frame);
    return judge_texel(list, frame, i, j, arithmetic);
  }
  bool covered(int i, int j, Arithmetic arithmetic) const { return make_triangle_judge(list, frame, 0, arithmetic)->verdict(i, j).covered; }
};

void add_triangle(Case& c, RasterVertex v0, RasterVertex v1, RasterVertex v2) {
  const auto first = static_cast<std::uint32_t>(c.list.vertices.size());
  c.list.vertices.insert(c.list.vertices.end(), {v0, v1, v2});
  c.list.triangles.push_back({first, first + 1, first + 2});
  if (c.list.draws.empty()) c.list.draws.emplace_back();
  c.list.draws.back().triangle_count = static_cast<std::uint32_t>(c.list.triangles.size()) - c.list.draws.back().first_triangle;
}

// (0,0), (4,0), (0,4) on a frame of 4 × 4.
Case right_triangle() {
  Case c;
  c.frame.width = c.frame.height = 4;
  c.frame.guard = 4;
  add_triangle(c, vertex(0, 0), vertex(4, 0), vertex(0, 4));
  return c;
}

std::array<float, 4> floats(const TexelBytes& bytes) {
  std::array<float, 4> values;
  std::memcpy(values.data(), bytes.data(), 16);
  return values;
}

int byte_of(const TexelBytes& bytes, std::size_t n) { return std::to_integer<int>(bytes[n]); }

std::uint32_t id_of(const TexelBytes& bytes) {
  std::uint32_t id;
  std::memcpy(&id, bytes.data(), 4);
  return id;
}

// A row of texels, one channel of unorm8.
std::shared_ptr<const Image> row(std::initializer_list<int> values) {
  auto image = std::make_shared<Image>(static_cast<int>(values.size()), 1, PixelFormat{ChannelType::unorm8, 1});
  int x = 0;
  for (const int value : values) image->channels<std::uint8_t>(x++, 0)[0] = static_cast<std::uint8_t>(value);
  return image;
}

void give_constant_uv(Case& c, float u) {
  for (RasterVertex& v : c.list.vertices) v.uv = {u, 0.5f};
}

}  // namespace

TEST_CASE("coverage: samples on the long edge belong to the right rules") {
  Case c = right_triangle();
  for (const Arithmetic arithmetic : kBoth)
    for (const auto& [rule, on_edge] : {std::pair{FillRule::left_ymin, false},
                                        {FillRule::left_ymax, false},
                                        {FillRule::right_ymin, true},
                                        {FillRule::right_ymax, true}}) {
      c.frame.state.fill_rule = rule;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) CHECK(c.covered(i, j, arithmetic) == (i + j < 3 || (i + j == 3 && on_edge)));
    }
}

TEST_CASE("coverage: the four rules choose the sides of a square on texel centres") {
  for (const Arithmetic arithmetic : kBoth)
    for (const auto& [rule, i0, j0] :
         {std::tuple{FillRule::left_ymin, 0, 0}, {FillRule::left_ymax, 0, 1}, {FillRule::right_ymin, 1, 0}, {FillRule::right_ymax, 1, 1}}) {
      Case c;
      c.frame.width = c.frame.height = 3;
      c.frame.state.fill_rule = rule;
      c.frame.targets = {{TargetContent::triangle_id, kR32ui, {}}};
      add_triangle(c, vertex(0.5f, 0.5f), vertex(2.5f, 0.5f), vertex(2.5f, 2.5f));
      add_triangle(c, vertex(0.5f, 0.5f), vertex(0.5f, 2.5f), vertex(2.5f, 2.5f));  // clockwise
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const bool expected = (i == i0 || i == i0 + 1) && (j == j0 || j == j0 + 1);
          CHECK((id_of(c.texel(i, j, arithmetic)[0]) != kNoTriangle) == expected);
        }
    }
}

TEST_CASE("coverage: culling by the area's sign before the exchange, none without area, ties are seen anyway") {
  for (const Arithmetic arithmetic : kBoth) {
    Case c = right_triangle();
    CHECK(make_triangle_judge(c.list, c.frame, 0, arithmetic)->verdict(1, 2).on_edge);
    CHECK_FALSE(make_triangle_judge(c.list, c.frame, 0, arithmetic)->verdict(1, 1).on_edge);
    c.frame.state.cull = CullMode::counter_clockwise;
    CHECK_FALSE(c.covered(0, 0, arithmetic));
    c.frame.state.cull = CullMode::clockwise;
    CHECK(c.covered(0, 0, arithmetic));
    std::swap(c.list.triangles[0][1], c.list.triangles[0][2]);
    CHECK_FALSE(c.covered(0, 0, arithmetic));
    c.frame.state.cull = CullMode::none;
    CHECK(c.covered(0, 0, arithmetic));
    c.list.vertices[2] = vertex(2, 0);
    CHECK_FALSE(c.covered(0, 0, arithmetic));
  }
}

TEST_CASE("values: perspective, affine depth, margins and bound terms by hand") {
  Case c = right_triangle();
  c.list.vertices[1].w = 3;
  c.list.vertices[1].uv = {1, 0};
  c.list.vertices[1].z = 1;
  c.list.images.push_back(row({1, 2, 3, 4}));
  c.list.draws[0].shading = Shading::texture;
  c.list.draws[0].texture = 0;
  c.frame.targets = {{TargetContent::coordinate, kRg32f, {}},
                     {TargetContent::barycentrics, {ChannelType::float32, 3}, {}},
                     {TargetContent::depth, kR32f, {}},
                     {TargetContent::margins, kRgba32f, {}},
                     {TargetContent::bound_terms, kRg32f, {}}};
  for (const Arithmetic arithmetic : kBoth) {
    // Affine weights at (½, ½): 6/8, 1/8, 1/8; divided by w: 18/24, 1/24, 3/24, sum 22/24.
    const auto texel = c.texel(0, 0, arithmetic);
    CHECK(floats(texel[0])[0] == 1.0f / 22.0f);
    CHECK(floats(texel[0])[1] == 0.0f);
    CHECK(floats(texel[1])[0] == 18.0f / 22.0f);
    CHECK(floats(texel[1])[1] == 1.0f / 22.0f);
    CHECK(floats(texel[1])[2] == 3.0f / 22.0f);
    CHECK(floats(texel[2])[0] == 0.125f);
    CHECK(floats(texel[3])[0] == 128.0f);        // half a texel from the legs
    CHECK(floats(texel[3])[1] == 4.0f / 22.0f);  // u·4 = 2/11, next to 0
    CHECK(floats(texel[3])[2] == 0.0f);
    CHECK(floats(texel[3])[3] == kInfinity);
    // u = x/12 / (1 − x/6) = x / (12 − 2x): du/dx = 12 / (12 − 2x)² = 12/121 at x = ½, times 4 texels; nothing in y.
    CHECK(floats(texel[4])[0] == 48.0f / 121.0f);
    CHECK(floats(texel[4])[1] == 0.25f);
    // Three quarters of a texel border: at (1½, ½) u·4 = 6/9, next to 1.
    CHECK(floats(c.texel(1, 0, arithmetic)[3])[1] == 1.0f / 3.0f);
    c.list.draws[0].sampler.filter = Filter::linear;
    CHECK(floats(c.texel(1, 0, arithmetic)[3])[1] == 1.0f / 6.0f);  // 6/9 − ½
    CHECK(floats(c.texel(1, 0, arithmetic)[3])[2] == 0.5f);
    c.list.draws[0].sampler.filter = Filter::nearest;
  }
}

TEST_CASE("values: a vertex-coloured draw has no lookup, tiny numbers and negative zero enter as +0") {
  Case c = right_triangle();
  for (RasterVertex& v : c.list.vertices) v.color = {-0.0f, 0x1.fffffep-41f, -0x1p-40f, 0.5f};
  c.frame.targets = {{TargetContent::color, kRgba32f, {}},
                     {TargetContent::margins, kRgba32f, {}},
                     {TargetContent::bound_terms, kRg32f, {}},
                     {TargetContent::color, kRgba8, {}}};
  for (const Arithmetic arithmetic : kBoth) {
    const auto texel = c.texel(0, 0, arithmetic);
    CHECK(floats(texel[0]) == std::array{0.0f, 0.0f, -0x1p-40f, 0.5f});
    CHECK_FALSE(std::signbit(floats(texel[0])[0]));
    CHECK(floats(texel[1])[1] == kInfinity);
    CHECK(floats(texel[1])[2] == kInfinity);
    CHECK(floats(texel[2])[0] == 0.0f);
    CHECK(byte_of(texel[3], 3) == 128);
  }
}

TEST_CASE("lookup: wraps of nearest, index by index") {
  struct Wrapped {
    Wrap wrap;
    std::array<int, 16> texel;  // of indices −6 .. 9 in a row of 4
  };
  Case c = right_triangle();
  c.list.images.push_back(row({10, 11, 12, 13}));
  c.list.draws[0].shading = Shading::texture;
  c.list.draws[0].texture = 0;
  c.frame.targets = {{TargetContent::color, {ChannelType::unorm8, 4}, {}}};
  for (const Arithmetic arithmetic : kBoth)
    for (const Wrapped& expected : {Wrapped{Wrap::clamp, {0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3, 3}},
                                    Wrapped{Wrap::repeat, {2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1}},
                                    Wrapped{Wrap::mirrored_repeat, {2, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0, 1}}}) {
      c.list.draws[0].sampler.wrap_u = expected.wrap;
      for (int n = 0; n < 16; ++n)
        for (const float part : {0.0f, 0.5f}) {  // floor: the border belongs to the texel above it
          give_constant_uv(c, (static_cast<float>(n - 6) + part) / 4);
          const auto texel = c.texel(0, 0, arithmetic)[0];
          CHECK(byte_of(texel, 0) == 10 + expected.texel[static_cast<std::size_t>(n)]);
          CHECK(byte_of(texel, 1) == 0);  // absent channels read 0, 0, 1
          CHECK(byte_of(texel, 3) == 255);
        }
    }
}

TEST_CASE("lookup: linear weights, both texels wrapped") {
  Case c = right_triangle();
  c.list.images.push_back(row({0, 255}));
  Draw& draw = c.list.draws[0];
  draw.shading = Shading::texture;
  draw.texture = 0;
  draw.sampler.filter = Filter::linear;
  c.frame.targets = {{TargetContent::color, {ChannelType::float32, 1}, {}}, {TargetContent::color, {ChannelType::unorm8, 1}, {}}};
  for (const Arithmetic arithmetic : kBoth) {
    const auto value = [&](float u, Wrap wrap) {
      give_constant_uv(c, u);
      draw.sampler.wrap_u = wrap;
      return floats(c.texel(0, 0, arithmetic)[0])[0];
    };
    CHECK(value(0.25f, Wrap::clamp) == 0.0f);
    CHECK(value(0.5f, Wrap::clamp) == 0.5f);
    CHECK(byte_of(c.texel(0, 0, arithmetic)[1], 0) == 128);  // 127.5, to even
    CHECK(value(0.375f, Wrap::repeat) == 0.25f);
    CHECK(value(0.0f, Wrap::clamp) == 0.0f);
    CHECK(value(0.0f, Wrap::repeat) == 0.5f);           // halfway between the last texel and the first
    CHECK(value(0.0f, Wrap::mirrored_repeat) == 0.0f);  // between the first and its mirror image
    CHECK(value(1.0f, Wrap::mirrored_repeat) == 1.0f);
    CHECK(value(0.0625f, Wrap::repeat) == 0.375f);
  }
}

TEST_CASE("indexed lookup: nearest hands over the stored rational") {
  auto texture = std::make_shared<Image>(255, 1, PixelFormat{ChannelType::unorm8, 1});
  for (int x = 0; x < 255; ++x) texture->channels<std::uint8_t>(x, 0)[0] = static_cast<std::uint8_t>(x);
  for (const Arithmetic arithmetic : kBoth)
    for (int i = 0; i < 255; i += arithmetic == Arithmetic::integer ? 1 : 16) {
      auto map = std::make_shared<Image>(1, 1, PixelFormat{ChannelType::unorm8, 2});
      map->channels<std::uint8_t>(0, 0)[0] = static_cast<std::uint8_t>(i);
      Case c = right_triangle();
      c.list.images = {texture, map};
      Draw& draw = c.list.draws[0];
      draw.shading = Shading::indexed;
      draw.texture = 0;
      draw.indexing_map = 1;
      c.frame.targets = {{TargetContent::color, {ChannelType::unorm8, 1}, {}}};
      CHECK(byte_of(c.texel(0, 0, arithmetic)[0], 0) == i);  // i/255 · 255 = i exactly
    }
}

TEST_CASE("indexed lookup: linear hands over the value rounded to float32") {
  auto map = std::make_shared<Image>(2, 1, PixelFormat{ChannelType::unorm8, 2});
  map->channels<std::uint8_t>(0, 0)[0] = 178;
  map->channels<std::uint8_t>(1, 0)[0] = 179;
  Case c = right_triangle();
  c.list.images = {row({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}), map};
  give_constant_uv(c, 0.5f);  // halfway: 178.5/255 = 7/10, and the float32 nearest to 7/10 lies below it
  Draw& draw = c.list.draws[0];
  draw.shading = Shading::indexed;
  draw.texture = 0;
  draw.indexing_map = 1;
  draw.map_sampler.filter = Filter::linear;
  c.frame.targets = {{TargetContent::color, {ChannelType::unorm8, 1}, {}}};
  for (const Arithmetic arithmetic : kBoth) CHECK(byte_of(c.texel(0, 0, arithmetic)[0], 0) == 6);
}

TEST_CASE("indexed lookup: margins and bound terms are those of the first lookup, a stored number below 2^-40 stays under nearest") {
  Case c = right_triangle();
  auto map = std::make_shared<Image>(8, 2, PixelFormat{ChannelType::float32, 2});
  for (int x = 0; x < 8; ++x) map->channels<float>(x, 0)[0] = -0x1p-100f;
  c.list.images = {row({7, 9}), map};
  Draw& draw = c.list.draws[0];
  draw.shading = Shading::indexed;
  draw.texture = 0;
  draw.sampler.wrap_u = Wrap::repeat;
  draw.indexing_map = 1;
  give_constant_uv(c, 0.25f + 1.0f / 64);
  for (RasterVertex& v : c.list.vertices) v.uv.y = 0.125f;
  c.frame.targets = {{TargetContent::color, {ChannelType::unorm8, 1}, {}}, {TargetContent::margins, kRgba32f, {}}};
  for (const Arithmetic arithmetic : kBoth) {
    draw.map_sampler.filter = Filter::nearest;
    CHECK(byte_of(c.texel(0, 0, arithmetic)[0], 0) == 9);      // just below zero: the last texel of the row before
    CHECK(floats(c.texel(0, 0, arithmetic)[1])[1] == 0.125f);  // 8·u = 2.125
    CHECK(floats(c.texel(0, 0, arithmetic)[1])[2] == 0.25f);
    draw.map_sampler.filter = Filter::linear;
    CHECK(byte_of(c.texel(0, 0, arithmetic)[0], 0) == 7);  // a filtered texel that small is +0
  }
}

TEST_CASE("visibility: nearer wins, equal goes to the earlier, depth 1 is not drawn, the runner-up is next in depth order") {
  Case c = right_triangle();
  for (int n = 0; n < 3; ++n) add_triangle(c, vertex(0, 0), vertex(4, 0), vertex(0, 4));
  const auto depths = [&c](std::array<float, 4> z) {
    for (std::size_t n = 0; n < 12; ++n) c.list.vertices[n].z = z[n / 3];
  };
  c.frame.targets = {{TargetContent::triangle_id, kR32ui, {}}, {TargetContent::depth, kR32f, {}}, {TargetContent::margins, kRgba32f, {}}};
  for (const Arithmetic arithmetic : kBoth) {
    const auto sees = [&](std::uint32_t id, float depth, float gap) {
      const auto texel = c.texel(0, 0, arithmetic);
      CHECK(id_of(texel[0]) == id);
      CHECK(floats(texel[1])[0] == depth);
      CHECK(floats(texel[2])[3] == gap);
    };
    c.frame.state.depth_test = true;
    depths({0.5f, 0.25f, 0.75f, 0.25f});
    sees(1, 0.25f, 0.0f);
    depths({0.75f, 0.5f, 0.25f, 0.625f});
    sees(2, 0.25f, 0.25f);
    depths({1, 1, 1, 1});
    sees(kNoTriangle, 1.0f, 0.0f);  // the clear of margins
    depths({0.75f, 0.1f, 0.5f, 0.3f});
    sees(1, 0.1f, static_cast<float>(static_cast<double>(0.3f) - static_cast<double>(0.1f)));
    c.frame.state.depth_test = false;
    sees(3, 0.3f, kInfinity);
    depths({0.0f, 0.0f, 0.0f, 1.0f});
    sees(3, 1.0f, kInfinity);
  }
}

TEST_CASE("clears: fixed ones, and the target's own stored by its format") {
  Case c = right_triangle();
  c.frame.targets = {{TargetContent::triangle_id, kR32ui, {9, 9, 9, 9}},
                     {TargetContent::depth, kR32f, {9, 9, 9, 9}},
                     {TargetContent::margins, kRgba32f, {9, 9, 9, 9}},
                     {TargetContent::bound_terms, kRg32f, {9, 9, 9, 9}},
                     {TargetContent::color, {ChannelType::srgb8, 4}, {0.5f, 2.0f, -1.0f, 0.5f}},
                     {TargetContent::coordinate, kRg32f, {-0.0f, 0x1p-149f, 0, 0}}};
  for (const Arithmetic arithmetic : kBoth) {
    const auto texel = c.texel(3, 3, arithmetic);
    CHECK(id_of(texel[0]) == kNoTriangle);
    CHECK(floats(texel[1])[0] == 1.0f);
    CHECK(texel[2] == TexelBytes{});
    CHECK(texel[3] == TexelBytes{});
    CHECK(byte_of(texel[4], 0) == 188);
    CHECK(byte_of(texel[4], 1) == 255);
    CHECK(byte_of(texel[4], 2) == 0);
    CHECK(byte_of(texel[4], 3) == 128);
    CHECK(id_of(texel[5]) == 0);
    CHECK(floats(texel[5])[1] == 0x1p-149f);
  }
}

TEST_CASE("positions at the end of their range and all sub-texel bits") {
  for (const Arithmetic arithmetic : kBoth)
    for (int bits = 1; bits <= 16; ++bits) {
      Case c;
      c.frame.width = c.frame.height = 16384;
      c.frame.guard = 0;
      c.frame.state.subtexel_bits = bits;
      const std::int32_t end = 16384 * (1 << bits);
      RasterVertex a, b, d;
      b.x = end, d.y = end;
      b.uv = {1, 0};
      add_triangle(c, a, b, d);
      c.frame.targets = {{TargetContent::coordinate, kRg32f, {}}, {TargetContent::margins, kRgba32f, {}}};
      CHECK(c.covered(16382, 0, arithmetic));
      CHECK_FALSE(c.covered(16383, 0, arithmetic));  // on the long edge, which left rules do not own
      const auto texel = c.texel(16382, 0, arithmetic);
      CHECK(floats(texel[0])[0] == 16382.5f / 16384.0f);
      CHECK(floats(texel[1])[0] == static_cast<float>(1 << (bits - 1)));  // ½ texel from the bottom, 1/√2 from the long edge
    }
}

TEST_CASE("a list that validate() would refuse is an InternalError, never a verdict") {
  for (const Arithmetic arithmetic : kBoth) {
    Case c = right_triangle();
    c.list.draws[0].triangle_count = 0;
    c.frame.targets = {{TargetContent::color, kRgba8, {}}};
    TexelBytes bytes;
    CHECK_THROWS_AS(make_triangle_judge(c.list, c.frame, 0, arithmetic)->store(0, 0, c.frame.targets, {}, &bytes), InternalError);
    c = right_triangle();
    c.frame.targets = {{TargetContent::color, kRgba8, {}}};
    c.list.vertices[0].color.x = kInfinity;
    CHECK_THROWS_AS(make_triangle_judge(c.list, c.frame, 0, arithmetic)->store(0, 0, c.frame.targets, {}, &bytes), InternalError);
    for (const Filter filter : {Filter::nearest, Filter::linear}) {
      c = right_triangle();
      c.frame.targets = {{TargetContent::color, kRgba8, {}}};
      c.list.images.push_back(std::make_shared<Image>(1, 1, kR32ui));
      c.list.draws[0].shading = Shading::texture;
      c.list.draws[0].texture = 0;
      c.list.draws[0].sampler.filter = filter;
      CHECK_THROWS_AS(make_triangle_judge(c.list, c.frame, 0, arithmetic)->store(0, 0, c.frame.targets, {}, &bytes), InternalError);
    }
  }
}

}  // namespace etalon::validation::reference
