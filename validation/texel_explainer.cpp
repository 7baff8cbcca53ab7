#include "validation/texel_explainer.h"

#include <algorithm>
#include <cstring>

namespace etalon::validation {

namespace {

constexpr std::size_t kCacheSlots = 256;

std::uint32_t id_at(const Image& image, int x, int y) { return *image.channels<std::uint32_t>(x, y); }

bool same_bytes(const Image& a, const Image& b, int x, int y) {
  return std::memcmp(a.texel(x, y), b.texel(x, y), static_cast<std::size_t>(bytes_per_texel(a.format()))) == 0;
}

}  // namespace

const TriangleGrid& TexelExplainer::SharedGrid::get(const DrawList& list, const Frame& frame) {
  std::call_once(once_, [&] { grid_ = std::make_unique<TriangleGrid>(list, frame); });
  return *grid_;
}

TexelExplainer::TexelExplainer(const DiffInput& input, SharedGrid& grid) : input_(input), grid_(grid), cache_(kCacheSlots) {
  for (std::size_t i = 0; i < input.frame.targets.size(); ++i) {
    if (input.frame.targets[i].content != TargetContent::triangle_id) continue;
    if (!input.golden[i].empty()) golden_id_ = static_cast<int>(i);
    if (!input.candidate[i].empty()) candidate_id_ = static_cast<int>(i);
  }
}

BoundedTriangle& TexelExplainer::prepared(std::uint32_t triangle) {
  auto& slot = cache_[triangle % kCacheSlots];
  if (slot == nullptr || slot->evaluator().id() != triangle) {
    slot = std::make_unique<BoundedTriangle>(input_.list, triangle, input_.frame, input_.device);
  }
  return *slot;
}

std::vector<TexelExplainer::Fragment> TexelExplainer::fragments(int x, int y) {
  std::vector<Fragment> found;
  const TriangleGrid& grid = grid_.get(input_.list, input_.frame);
  for (auto it = grid.begin(x, y); it != grid.end(x, y); ++it) {
    BoundedTriangle& p = prepared(*it);
    if (!p.evaluator().covers(x, y)) continue;
    const Bounded depth = p.depth(p.evaluator().sample(x, y));
    found.push_back({*it, depth.value, depth.bound, is_useless(depth.bound, p.evaluator().z())});
  }
  return found;
}

std::uint32_t TexelExplainer::visible(const std::vector<Fragment>& fragments) const {
  if (!input_.frame.state.depth_test) return fragments.empty() ? kNoTriangle : fragments.back().triangle;
  std::uint32_t best = kNoTriangle;
  float nearest = 1;
  for (const Fragment& f : fragments) {
    const float stored = static_cast<float>(f.depth);
    if (stored < nearest) {
      nearest = stored;
      best = f.triangle;
    }
  }
  return best;
}

std::optional<TexelExplainer::Outcome> TexelExplainer::depth_tie(const std::vector<Fragment>& fragments, std::uint32_t golden,
                                                                 std::uint32_t other) const {
  if (!input_.frame.state.depth_test) return std::nullopt;
  // What is visible as `other` must be able to come out nearer than every fragment, and nearer than the cleared depth, 1.
  const auto fragment_of = [&](std::uint32_t t) -> const Fragment* {
    for (const Fragment& f : fragments) {
      if (f.triangle == t) return &f;
    }
    return nullptr;
  };
  const Fragment cleared{kNoTriangle, 1, 0, false};
  const Fragment* mine = other == kNoTriangle ? &cleared : fragment_of(other);
  const Fragment* oracle = golden == kNoTriangle ? &cleared : fragment_of(golden);
  if (mine == nullptr || oracle == nullptr) return std::nullopt;
  // The clear is no fragment: it stays visible only where every fragment may come out at 1 or beyond; and it loses to any that may not.
  bool useless = mine->useless || oracle->useless;
  double gap = 0, bound = 0;
  const auto must_beat = [&](const Fragment& f) {
    const double this_gap = mine->depth - f.depth, this_bound = mine->bound + f.bound + 0x1p-23;
    if (this_gap > gap || (gap <= 0 && this_bound > bound)) {
      gap = std::max(gap, this_gap);
      bound = this_bound;
    }
    return f.useless || mine->useless || this_gap <= this_bound;
  };
  for (const Fragment& f : fragments) {
    if (f.triangle != other && !must_beat(f)) return std::nullopt;
    useless = useless || (f.triangle != other && f.useless);
  }
  if (other != kNoTriangle && !must_beat(cleared)) return std::nullopt;
  Outcome outcome;
  outcome.texel_class = useless ? TexelClass::unbounded : TexelClass::tie;
  outcome.margin = gap;
  outcome.margin_bound = bound;
  outcome.share = bound > 0 && !useless ? gap / bound : 0;
  return outcome;
}

Cause TexelExplainer::cause_of(int x, int y, const std::vector<Fragment>& fragments, std::uint32_t golden) {
  if (candidate_id_ >= 0) {
    const std::uint32_t shown = id_at(input_.candidate[static_cast<std::size_t>(candidate_id_)], x, y);
    if (shown != golden) {
      if (shown == kNoTriangle || golden == kNoTriangle) return Cause::coverage;
      if (shown >= input_.list.triangles.size()) return Cause::value;
      if (!prepared(shown).evaluator().covers(x, y)) return Cause::coverage;
      // Something behind shows through where the oracle's triangle was dropped on its own edge.
      return prepared(golden).evaluator().touches(x, y) ? Cause::coverage : Cause::depth_order;
    }
  } else {
    if (golden != kNoTriangle && check_values(x, y, kNoTriangle, 0).texel_class <= TexelClass::rounding) return Cause::coverage;
    if (golden == kNoTriangle) return Cause::coverage;
    for (const Fragment& f : fragments) {
      if (f.triangle != golden && check_values(x, y, f.triangle, 0).texel_class <= TexelClass::tie) {
        return prepared(golden).evaluator().touches(x, y) ? Cause::coverage : Cause::depth_order;
      }
    }
    const TriangleGrid& grid = grid_.get(input_.list, input_.frame);
    for (auto it = grid.begin(x, y); it != grid.end(x, y); ++it) {
      const TriangleEvaluator& e = prepared(*it).evaluator();
      if (!e.covers(x, y) && e.touches(x, y) && check_values(x, y, *it, 0).texel_class <= TexelClass::tie) return Cause::coverage;
    }
  }
  if (golden == kNoTriangle) return Cause::value;
  constexpr double kNeighbourhood = 2;  // texels: how far a wrong choice is looked for
  return check_values(x, y, golden, kNeighbourhood).texel_class == TexelClass::tie ? Cause::texel_choice : Cause::value;
}

TexelVerdict TexelExplainer::explain(int x, int y) {
  TexelVerdict verdict;
  bool same = true, compared = false;
  for (std::size_t i = 0; i < input_.frame.targets.size() && same; ++i) {
    if (!is_compared(input_.frame.targets[i].content) || input_.golden[i].empty() || input_.candidate[i].empty()) continue;
    compared = true;
    same = same_bytes(input_.golden[i], input_.candidate[i], x, y);
  }
  if (same && compared) return verdict;

  const auto apply = [&](const Outcome& outcome) {
    verdict.texel_class = outcome.texel_class;
    verdict.share = outcome.share;
    verdict.margin = outcome.margin;
    verdict.margin_bound = outcome.margin_bound;
    verdict.target = outcome.target;
  };

  std::vector<Fragment> covering;
  bool gathered = false;
  const auto gather = [&] {
    if (!gathered) covering = fragments(x, y);
    gathered = true;
  };
  if (golden_id_ >= 0) {
    verdict.triangle = id_at(input_.golden[static_cast<std::size_t>(golden_id_)], x, y);
  } else {
    gather();
    verdict.triangle = visible(covering);
  }
  const std::uint32_t golden = verdict.triangle;
  verdict.candidate_triangle = golden;
  if (golden != kNoTriangle && (golden >= input_.list.triangles.size() || !prepared(golden).evaluator().covers(x, y))) {
    // The oracle's own id contradicts exact coverage: no explanation may rest on it.
    verdict.texel_class = TexelClass::unexplained;
    verdict.cause = Cause::coverage;
    return verdict;
  }

  if (candidate_id_ >= 0) {
    const std::uint32_t shown = id_at(input_.candidate[static_cast<std::size_t>(candidate_id_)], x, y);
    verdict.candidate_triangle = shown;
    if (shown == golden) {
      apply(check_values(x, y, golden, 0));
    } else {
      gather();
      const auto tie = depth_tie(covering, golden, shown);
      if (tie) {
        // The other triangle's values must be what is stored.
        Outcome values = check_values(x, y, shown, 0);
        if (values.texel_class <= TexelClass::tie) {
          const int target = candidate_id_;
          apply(*tie);
          verdict.target = target;
        } else {
          apply(values);
        }
      } else {
        verdict.texel_class = TexelClass::unexplained;
        verdict.target = candidate_id_;
      }
    }
  } else {
    apply(check_values(x, y, golden, 0));
    if (verdict.texel_class == TexelClass::unexplained) {
      gather();
      // Values that the other triangle's bound cannot judge make the texel unbounded, unless a later choice is a proven tie.
      const auto try_other = [&](std::uint32_t other) {
        if (other == golden) return false;
        const auto tie = depth_tie(covering, golden, other);
        if (!tie) return false;
        const Outcome values = check_values(x, y, other, 0);
        if (values.texel_class == TexelClass::unexplained) return false;
        const bool judged = values.texel_class <= TexelClass::tie;
        if (!judged && verdict.texel_class == TexelClass::unbounded) return false;
        apply(judged ? *tie : values);
        verdict.target = values.target;
        verdict.candidate_triangle = other;
        return judged;
      };
      bool found = false;
      for (std::size_t k = 0; k < covering.size() && !found; ++k) found = try_other(covering[k].triangle);
      if (!found) found = try_other(kNoTriangle);
    }
  }
  verdict.texel_class = std::max(verdict.texel_class, TexelClass::rounding);  // the bytes differ, whatever explains them
  // Against the contract itself there is no rounding to allow, and no tie: it decides each of them.
  if (input_.device.factor == 0) verdict.texel_class = TexelClass::unexplained;
  if (verdict.texel_class == TexelClass::unexplained) {
    gather();
    verdict.cause = cause_of(x, y, covering, golden);
  }
  return verdict;
}

}  // namespace etalon::validation
