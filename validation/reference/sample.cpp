#include "validation/reference/sample.h"

#include <algorithm>

#include "validation/reference/integer_judge.h"
#include "validation/reference/rational_judge.h"

namespace etalon::validation::reference {

namespace {

struct Fragment {
  std::uint32_t triangle;
  float depth;
};

// "With the depth test a fragment is drawn where its stored depth is less than what the texel holds; the texel starts at 1, so equal
// depths go to the earlier primitive and a fragment at depth 1 is not drawn. Without it the later primitive wins."
std::optional<Fragment> visible(const std::vector<Fragment>& fragments, bool depth_test) {
  std::optional<Fragment> held;
  for (const Fragment& fragment : fragments)
    if (!depth_test || fragment.depth < (held ? held->depth : 1.0f)) held = fragment;
  return held;
}

// "stored depth of the runner-up (the next nearer-or-equal in depth order) [...]; +inf where there is none or without depth test":
// what would be visible if the winner were not there, so a fragment at depth 1 is no runner-up.
std::optional<float> runner_up_depth(std::vector<Fragment> fragments, std::uint32_t winner, bool depth_test) {
  if (!depth_test) return std::nullopt;
  std::erase_if(fragments, [winner](const Fragment& fragment) { return fragment.triangle == winner; });
  const std::optional<Fragment> second = visible(fragments, depth_test);
  if (!second) return std::nullopt;
  return second->depth;
}

}  // namespace

std::unique_ptr<TriangleJudge> make_triangle_judge(const DrawList& list, const Frame& frame, std::uint32_t t, Arithmetic arithmetic) {
  return arithmetic == Arithmetic::integer ? make_integer_judge(list, frame, t) : make_rational_judge(list, frame, t);
}

TexelBytes stored_clear(const TargetSpec& target, HalfRounding half_rounding, Arithmetic arithmetic) {
  return arithmetic == Arithmetic::integer ? integer_clear(target, half_rounding) : rational_clear(target, half_rounding);
}

Judge::Judge(const DrawList& list, const Frame& frame, Arithmetic arithmetic) : frame_(frame) {
  for (std::uint32_t t = 0; t < list.triangles.size(); ++t) triangles_.push_back(make_triangle_judge(list, frame, t, arithmetic));
  for (const TargetSpec& target : frame.targets) clears_.push_back(stored_clear(target, frame.state.half_rounding, arithmetic));
}

std::vector<TexelBytes> Judge::texel(int i, int j) const {
  std::vector<Fragment> fragments;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const SampleVerdict verdict = triangles_[t]->verdict(i, j);
    if (verdict.covered) fragments.push_back({t, verdict.depth});
  }
  std::vector<TexelBytes> bytes = clears_;
  const std::optional<Fragment> winner = visible(fragments, frame_.state.depth_test);
  if (winner) {
    const std::optional<float> second = runner_up_depth(fragments, winner->triangle, frame_.state.depth_test);
    triangles_[winner->triangle]->store(i, j, frame_.targets, second, bytes.data());
  }
  return bytes;
}

std::vector<TexelBytes> judge_texel(const DrawList& list, const Frame& frame, int i, int j, Arithmetic arithmetic) {
  return Judge(list, frame, arithmetic).texel(i, j);
}

}  // namespace etalon::validation::reference
