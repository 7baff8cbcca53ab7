#include "tests/validation/reference/compare_sample.h"

#include <fmt/format.h>

#include <cstring>

namespace etalon::validation::reference {

namespace {

bool reads_image(const DrawList& list, std::uint32_t t) { return list.draw_of(t).shading != Shading::vertex_color; }

// The judge's margins say whether a coordinate lies exactly on a border between texels.
bool on_texel_border(const TexelBytes& margins) {
  float distance[2];
  std::memcpy(distance, margins.data() + 4, 8);
  return distance[0] == 0 || distance[1] == 0;
}

void compare_values(const DrawList& list, const Frame& frame, std::uint32_t t, int i, int j, const TriangleJudge& judge,
                    const SampleSubject& subject, const std::string& label, Tally& tally) {
  const std::size_t count = frame.targets.size();
  std::vector<TexelBytes> expected(count), got(count, TexelBytes{});
  std::vector<std::byte*> at(count);
  for (std::size_t n = 0; n < count; ++n) at[n] = got[n].data();
  judge.store(i, j, frame.targets, std::nullopt, expected.data());
  subject.store(t, i, j, at.data());
  for (std::size_t n = 0; n < count; ++n) {
    ++tally.values;
    const TargetSpec& target = frame.targets[n];
    if (target.content == TargetContent::margins && reads_image(list, t) && on_texel_border(expected[n])) ++tally.texel_ties;
    if (expected[n] == got[n]) continue;
    const int size = bytes_per_texel(target.format);
    tally.mismatch(fmt::format("{}, triangle {}, texel ({}, {}), target {} {} {}: expected {}, got {}; {}", label, t, i, j, n,
                               to_string(target.content), to_string(target.format), hex_of(expected[n], size), hex_of(got[n], size),
                               describe(list, frame, t)));
  }
}

std::string describe(const Sampler& s) { return fmt::format("{}/{}/{}", to_string(s.filter), to_string(s.wrap_u), to_string(s.wrap_v)); }

std::string describe(const DrawList& list, std::uint32_t image) {
  const Image& i = *list.images[image];
  return fmt::format("{}x{} {}", i.width(), i.height(), to_string(i.format()));
}

}  // namespace

void compare_sample(const DrawList& list, const Frame& frame, std::uint32_t t, int i, int j, const TriangleJudge& judge,
                    const SampleSubject& subject, bool with_values, const std::string& label, Tally& tally) {
  const SampleVerdict verdict = judge.verdict(i, j);
  const bool covered = subject.covers(t, i, j);
  ++tally.samples;
  tally.covered += verdict.covered ? 1 : 0;
  tally.edge_ties += verdict.on_edge ? 1 : 0;
  if (covered != verdict.covered)
    return tally.mismatch(fmt::format("{}, triangle {}, texel ({}, {}): expected {}, got {}; {}", label, t, i, j,
                                      verdict.covered ? "covered" : "not covered", covered ? "covered" : "not covered",
                                      describe(list, frame, t)));
  if (covered && with_values) compare_values(list, frame, t, i, j, judge, subject, label, tally);
}

std::string hex_of(const TexelBytes& bytes, int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += fmt::format("{:02x}", std::to_integer<int>(bytes[static_cast<std::size_t>(n)]));
  return text;
}

std::string describe(const DrawList& list, const Frame& frame, std::uint32_t t) {
  std::string text = fmt::format("{} bits, {}, half {}", frame.state.subtexel_bits, to_string(frame.state.fill_rule),
                                 to_string(frame.state.half_rounding));
  for (const std::uint32_t corner : list.triangles[t]) {
    const RasterVertex& v = list.vertices[corner];
    text += fmt::format("; ({}, {}) z {:a} w {:a} uv ({:a}, {:a}) color ({:a}, {:a}, {:a}, {:a})", v.x, v.y, v.z, v.w, v.uv.x, v.uv.y,
                        v.color.x, v.color.y, v.color.z, v.color.w);
  }
  const Draw& draw = list.draw_of(t);
  if (draw.shading != Shading::vertex_color) text += fmt::format("; texture {} {}", describe(list, draw.texture), describe(draw.sampler));
  if (draw.shading == Shading::indexed)
    text += fmt::format("; through {} {}", describe(list, draw.indexing_map), describe(draw.map_sampler));
  return text;
}

}  // namespace etalon::validation::reference
