#include "validation/texel_diff.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/math/half.h"
#include "raster/cpu_renderer.h"
#include "tests/validation/random_scene.h"
#include "tests/validation/scenes.h"

namespace etalon::validation {
namespace {

using test::at;
using test::frame_of;
using test::list_of;

std::vector<Image> exact(const DrawList& list, const Frame& frame) {
  raster::CpuRenderer cpu;
  return cpu.render(list, frame);
}

DiffResult diff(const DrawList& list, const Frame& frame, const std::vector<Image>& golden, const std::vector<Image>& candidate,
                const DeviceModel& device = llvmpipe_model()) {
  return diff_images(list, frame, device, golden, candidate);
}

const TargetSpec kId{TargetContent::triangle_id, kR32ui};

DrawList gradient_triangle() {
  return list_of({at(1, 1, {}, {0.1f, 0.2f, 0.3f, 1}), at(60, 4, {}, {0.9f, 0.1f, 0.5f, 1}), at(9, 55, {}, {0.3f, 0.8f, 0.7f, 0.5f})});
}

float& red(Image& image, int x, int y) { return image.channels<float>(x, y)[0]; }

TEST_CASE("equal images are identical, and every texel is counted once") {
  const Frame frame = frame_of(64, 48, {{TargetContent::color, kRgba8}, kId});
  const DrawList list = gradient_triangle();
  const auto golden = exact(list, frame);
  const DiffResult result = diff(list, frame, golden, golden);
  CHECK(result.counts[TexelClass::identical] == 64 * 48);
  CHECK(result.counts.total() == 64 * 48);
  CHECK(result.agreed());
  CHECK(result.proven());
  CHECK(result.worst.empty());
}

TEST_CASE("one wrong last bit of a float32 value is a legal rounding for a device: native mode cannot see it") {
  const Frame frame = frame_of(64, 48, {{TargetContent::color, kRgba32f}});
  const DrawList list = gradient_triangle();
  const auto golden = exact(list, frame);
  auto candidate = golden;
  red(candidate[0], 20, 20) = std::bit_cast<float>(std::bit_cast<std::uint32_t>(red(candidate[0], 20, 20)) + 1);
  const DiffResult result = diff(list, frame, golden, candidate);
  CHECK(result.counts[TexelClass::rounding] == 1);
  CHECK(result.agreed());
  CHECK(*result.class_image.channels<std::uint8_t>(20, 20) == static_cast<int>(TexelClass::rounding));
  // The contract itself allows nothing: exact mode sees it.
  CHECK(diff(list, frame, golden, candidate, contract_model()).counts[TexelClass::unexplained] == 1);
}

TEST_CASE("a float32 value beyond the bound is unexplained, by value") {
  const Frame frame = frame_of(64, 48, {{TargetContent::color, kRgba32f}, kId});
  const DrawList list = gradient_triangle();
  const auto golden = exact(list, frame);
  auto candidate = golden;
  red(candidate[0], 20, 20) += 1e-4f;
  const DiffResult result = diff(list, frame, golden, candidate);
  CHECK(result.counts[TexelClass::unexplained] == 1);
  CHECK(result.unexplained_by[static_cast<std::size_t>(Cause::value)] == 1);
  CHECK_FALSE(result.agreed());
  REQUIRE(result.worst.size() == 1);
  CHECK(result.worst[0].x == 20);
  CHECK(result.worst[0].y == 20);
  CHECK(result.worst[0].verdict.triangle == 0);
  CHECK(result.worst[0].sentence.find("UNEXPLAINED (value)") != std::string::npos);
  CHECK(result.worst[0].golden_bytes[0] != result.worst[0].candidate_bytes[0]);
  CHECK(result.worst[0].golden_bytes[1] == "00000000");
}

TEST_CASE("NaN is no rounding of anything") {
  const Frame frame = frame_of(64, 48, {{TargetContent::color, kRgba32f}});
  const DrawList list = gradient_triangle();
  const auto golden = exact(list, frame);
  auto candidate = golden;
  red(candidate[0], 20, 20) = std::bit_cast<float>(0x7FC00000u);
  CHECK(diff(list, frame, golden, candidate).counts[TexelClass::unexplained] == 1);
}

TEST_CASE("stored toward zero: unorm and half values between two codes are unexplained, the legal ones near a code are not") {
  for (const ChannelType type : {ChannelType::unorm8, ChannelType::unorm16, ChannelType::half}) {
    CAPTURE(to_string(type));
    const Frame frame = frame_of(64, 48, {{TargetContent::color, {type, 1}}});
    const Frame wide = frame_of(64, 48, {{TargetContent::color, kR32f}});
    const DrawList list = gradient_triangle();
    const auto golden = exact(list, frame);
    const Image value = exact(list, wide)[0];
    auto candidate = golden;
    int changed = 0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const double v = static_cast<double>(*value.channels<float>(x, y));
        if (type == ChannelType::half) {
          *candidate[0].channels<std::uint16_t>(x, y) = half_toward_zero(v);
        } else if (type == ChannelType::unorm8) {
          *candidate[0].channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(v * 255);
        } else {
          *candidate[0].channels<std::uint16_t>(x, y) = static_cast<std::uint16_t>(v * 65535);
        }
        changed += std::memcmp(candidate[0].texel(x, y), golden[0].texel(x, y), static_cast<std::size_t>(bytes_per_channel(type))) != 0;
      }
    }
    const DiffResult result = diff(list, frame, golden, candidate);
    REQUIRE(changed > 100);
    // What lies within the device's bound above a code may have been rounded down; at 16 bits that bound is a tenth of a code.
    CHECK(result.counts[TexelClass::unexplained] > 0.8 * changed);
    CHECK(result.unexplained_by[static_cast<std::size_t>(Cause::value)] == result.counts[TexelClass::unexplained]);
    if (type == ChannelType::half) {
      // Declared, the same truncation is what the contract asks for.
      Frame truncating = frame;
      truncating.state.half_rounding = HalfRounding::toward_zero;
      CHECK(diff(list, truncating, exact(list, truncating), candidate).agreed());
    }
  }
}

TEST_CASE("nearest: the neighbour across a border within the bound is a tie, any other texel is not") {
  // u·16 = x + ½ exactly at every sample shifted by half a texel: each sample lies on the border of texels x and x + 1.
  const auto texture = test::busy_texture(16, 16);
  const DrawList list =
      test::quad(16, 16, {0.5f / 16, 0.25f / 16}, {1 + 0.5f / 16, 1 + 0.25f / 16}, texture, {Filter::nearest, Wrap::repeat, Wrap::repeat});
  const Frame frame = frame_of(16, 16, {{TargetContent::color, kRgba8}});
  const auto golden = exact(list, frame);
  const auto put = [&](int dx, int dy) {
    auto candidate = golden;
    std::memcpy(candidate[0].texel(5, 7), texture->texel(5 + dx, 7 + dy), 4);
    return diff(list, frame, golden, candidate);
  };
  REQUIRE(std::memcmp(golden[0].texel(5, 7), texture->texel(6, 7), 4) == 0);
  const DiffResult tie = put(0, 0);
  CHECK(tie.counts[TexelClass::tie] == 1);
  CHECK(tie.agreed());
  CHECK(tie.worst[0].sentence.find("tie, the texel beyond a border") != std::string::npos);
  for (const auto& [dx, dy] : {std::pair{2, 0}, std::pair{1, 1}, std::pair{0, 1}, std::pair{1, -1}}) {
    const DiffResult wrong = put(dx, dy);
    CHECK(wrong.counts[TexelClass::unexplained] == 1);
    CHECK(wrong.unexplained_by[static_cast<std::size_t>(Cause::texel_choice)] == 1);
  }
  auto byte = golden;
  byte[0].texel(5, 7)[1] ^= std::byte{1};
  const DiffResult wrong_byte = diff(list, frame, golden, byte);
  CHECK(wrong_byte.counts[TexelClass::unexplained] == 1);
  CHECK(wrong_byte.unexplained_by[static_cast<std::size_t>(Cause::value)] == 1);
}

TEST_CASE("coverage has bound 0: a texel missing or drawn beyond an edge is unexplained, with ids and without") {
  const DrawList list = list_of({at(2.5, 2.5, {}, {1, 1, 1, 1}), at(12.5, 2.5, {}, {1, 1, 1, 1}), at(2.5, 12.5, {}, {1, 1, 1, 1})});
  for (const bool with_ids : {true, false}) {
    CAPTURE(with_ids);
    const Frame frame = frame_of(
        16, 16,
        with_ids ? std::vector<TargetSpec>{{TargetContent::color, kRgba8}, kId} : std::vector<TargetSpec>{{TargetContent::color, kRgba8}});
    const auto golden = exact(list, frame);
    // (2, 5) lies on the left edge, which owns it; (5, 9) on the diagonal, which does not.
    REQUIRE(golden[0].texel(2, 5)[0] == std::byte{255});
    REQUIRE(golden[0].texel(5, 9)[0] == std::byte{0});
    auto candidate = golden;
    for (std::size_t i = 0; i < golden.size(); ++i) {
      std::memcpy(candidate[i].texel(2, 5), golden[i].texel(0, 0), 4);
      std::memcpy(candidate[i].texel(5, 9), golden[i].texel(4, 4), 4);
    }
    const DiffResult result = diff(list, frame, golden, candidate);
    CHECK(result.counts[TexelClass::unexplained] == 2);
    CHECK(result.unexplained_by[static_cast<std::size_t>(Cause::coverage)] == 2);
  }
}

TEST_CASE("depth order: nearly equal planes are a tie with the other triangle's values, a clear gap is not") {
  const auto pair = [](float gap) {
    const Vec4f white{1, 1, 1, 1}, grey{0.5f, 0.5f, 0.5f, 1};
    return list_of({at(0, 0, {}, white, 0.3f), at(32, 0, {}, white, 0.7f), at(0, 32, {}, white, 0.4f), at(0, 0, {}, grey, 0.3f + gap),
                    at(32, 0, {}, grey, 0.7f + gap), at(0, 32, {}, grey, 0.4f + gap)});
  };
  for (const bool with_ids : {true, false}) {
    CAPTURE(with_ids);
    const Frame frame = frame_of(
        32, 32,
        with_ids ? std::vector<TargetSpec>{{TargetContent::color, kRgba8}, kId} : std::vector<TargetSpec>{{TargetContent::color, kRgba8}});
    const auto swap_at = [&](const DrawList& list, const DeviceModel& device = llvmpipe_model()) {
      const auto golden = exact(list, frame);
      auto candidate = golden;
      for (int c = 0; c < 3; ++c) candidate[0].texel(5, 6)[c] = std::byte{128};
      if (with_ids) *candidate[1].channels<std::uint32_t>(5, 6) = 1;
      return diff(list, frame, golden, candidate, device);
    };
    CHECK(swap_at(pair(0x1p-24f)).counts[TexelClass::tie] == 1);
    CHECK(swap_at(pair(0x1p-24f), contract_model()).counts[TexelClass::unexplained] == 1);  // the contract decides each of them
    const DiffResult wrong = swap_at(pair(0x1p-10f));
    CHECK(wrong.counts[TexelClass::unexplained] == 1);
    CHECK(wrong.unexplained_by[static_cast<std::size_t>(Cause::depth_order)] == 1);
  }
}

TEST_CASE("an id that changes without the values of its triangle is unexplained") {
  const Frame frame = frame_of(32, 32, {{TargetContent::color, kRgba8}, kId});
  const Vec4f white{1, 1, 1, 1}, grey{0.5f, 0.5f, 0.5f, 1};
  const DrawList list = list_of(
      {at(0, 0, {}, white), at(32, 0, {}, white), at(0, 32, {}, white), at(0, 0, {}, grey), at(32, 0, {}, grey), at(0, 32, {}, grey)});
  const auto golden = exact(list, frame);
  auto candidate = golden;
  *candidate[1].channels<std::uint32_t>(5, 6) = 1;
  CHECK(diff(list, frame, golden, candidate).counts[TexelClass::unexplained] == 1);
  *candidate[1].channels<std::uint32_t>(5, 6) = 77;  // no such triangle
  CHECK(diff(list, frame, golden, candidate).counts[TexelClass::unexplained] == 1);
}

TEST_CASE("a sliver on which float32 setup degenerates is unbounded for values, but not for coverage") {
  // 4096 texels along the diagonal of sample centres and a sub-texel of 2^-12 thick: the area is 1, the products it is a difference of 2^24.
  Frame frame = frame_of(4096, 4096, {{TargetContent::color, kR32f, {-1, 0, 0, 0}}, kId});
  frame.state.subtexel_bits = 12;
  DrawList list = list_of({at(0, 0, {}, {0, 0, 0, 1}), at(0, 0, {}, {1, 0, 0, 1}), at(0, 0, {}, {0.3f, 0, 0, 1})});
  list.vertices[1].x = list.vertices[1].y = 4096 << 12;
  list.vertices[2].x = 2048 << 12;
  list.vertices[2].y = (2048 << 12) - 1;
  const auto golden = exact(list, frame);
  REQUIRE(red(const_cast<Image&>(golden[0]), 100, 100) > 0);
  auto candidate = golden;
  red(candidate[0], 100, 100) = 1000;
  const DiffResult wild = diff(list, frame, golden, candidate);
  CHECK(wild.counts[TexelClass::unbounded] == 1);
  CHECK(wild.agreed());
  CHECK(diff(list, frame, golden, candidate, contract_model()).counts[TexelClass::unexplained] == 1);
  *candidate[1].channels<std::uint32_t>(100, 100) = kNoTriangle;  // nothing was drawn, and that is coverage
  *candidate[1].channels<std::uint32_t>(100, 101) = 0;            // and here something was, beyond the edge
  const DiffResult missing = diff(list, frame, golden, candidate);
  CHECK(missing.counts[TexelClass::unexplained] == 2);
  CHECK(missing.unexplained_by[static_cast<std::size_t>(Cause::coverage)] == 2);
}

TEST_CASE("the classes do not depend on the number of threads") {
  const test::RandomScene scene = test::make_random_scene(8, {}, 300);
  const auto golden = exact(scene.list, scene.frame);
  auto candidate = golden;
  Rng rng(5);
  for (int n = 0; n < 4000; ++n) {
    const auto i = rng.below(candidate[0].bytes().size());
    candidate[0].bytes()[i] ^= static_cast<std::byte>(1u << rng.below(8));
  }
  set_thread_count(1);
  const DiffResult one = diff(scene.list, scene.frame, golden, candidate);
  set_thread_count(4);
  const DiffResult four = diff(scene.list, scene.frame, golden, candidate);
  set_thread_count(0);
  CHECK(one.counts.texels == four.counts.texels);
  CHECK(one.unexplained_by == four.unexplained_by);
  CHECK(one.class_image == four.class_image);
  REQUIRE(one.worst.size() == four.worst.size());
  REQUIRE(one.worst.size() == 16);
  for (std::size_t i = 0; i < one.worst.size(); ++i) CHECK(one.worst[i].sentence == four.worst[i].sentence);
}

TEST_CASE("explain_texel says what diff_images counts, in a sentence") {
  const auto texture = test::busy_texture(16, 16);
  const DrawList list = test::quad(16, 16, {0, 0}, {1, 1}, texture);
  const Frame frame = frame_of(16, 16, {{TargetContent::color, kRgba8}});
  const auto golden = exact(list, frame);
  auto candidate = golden;
  std::memcpy(candidate[0].texel(5, 7), golden[0].texel(6, 7), 4);
  const TexelReport wrong = explain_texel(list, frame, llvmpipe_model(), golden, candidate, 5, 7);
  CHECK(wrong.verdict.texel_class == TexelClass::unexplained);
  CHECK(wrong.sentence.find("texture coordinate (5.5, 7.5)") != std::string::npos);
  CHECK(wrong.sentence.find("texel choice") != std::string::npos);
  const TexelReport same = explain_texel(list, frame, llvmpipe_model(), golden, candidate, 1, 1);
  CHECK(same.verdict.texel_class == TexelClass::identical);
  CHECK_THROWS_AS((void)explain_texel(list, frame, llvmpipe_model(), golden, candidate, 16, 0), InputError);
}

TEST_CASE("what cannot be compared is refused with a reason") {
  const Frame frame = frame_of(16, 16, {{TargetContent::color, kRgba8}, kId});
  const DrawList list = gradient_triangle();
  const auto golden = exact(list, frame);
  const auto refuse = [&](std::vector<Image> a, std::vector<Image> b) { CHECK_THROWS_AS((void)diff(list, frame, a, b), InputError); };
  refuse({golden[0]}, golden);                           // one image short
  refuse(golden, {Image(16, 15, kRgba8), golden[1]});    // another size
  refuse(golden, {Image(16, 16, kRgba32f), golden[1]});  // another format
  refuse({golden[0], Image()}, {Image(), golden[1]});    // nothing on both sides
  CHECK(diff(list, frame, {golden[0], Image()}, {golden[0], golden[1]}).agreed());
}

TEST_CASE("a measured bound is never called proven") {
  const Frame frame = frame_of(16, 16, {{TargetContent::color, kRgba8}});
  const DrawList list = gradient_triangle();
  const auto golden = exact(list, frame);
  const DiffResult result = diff(list, frame, golden, golden, measured_model("some device", 4, "probe of 2026-11-22, times 4"));
  CHECK(result.agreed());
  CHECK_FALSE(result.proven());
  CHECK(format_counts(result).find("measured") != std::string::npos);
}

}  // namespace
}  // namespace etalon::validation
