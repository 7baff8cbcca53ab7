#include "validation/texel_explainer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace etalon::validation {

namespace {

constexpr std::size_t kCacheSlots = 256;

std::uint32_t id_at(const Image& image, int x, int y) { return *image.channels<std::uint32_t>(x, y); }

bool same_bytes(const Image& a, const Image& b, int x, int y) {
  return std::memcmp(a.texel(x, y), b.texel(x, y), static_cast<std::size_t>(bytes_per_texel(a.format()))) == 0;
}

// Contents that are compared; margins and bound terms are the oracle's own notes.
bool is_compared(TargetContent content) { return content != TargetContent::margins && content != TargetContent::bound_terms; }

}  // namespace

std::string to_string(TexelClass value) {
  constexpr const char* kNames[] = {"identical", "rounding", "tie", "unbounded", "unexplained"};
  return kNames[static_cast<int>(value)];
}

std::string to_string(Cause value) {
  constexpr const char* kNames[] = {"none", "coverage", "depth order", "texel choice", "value"};
  return kNames[static_cast<int>(value)];
}

/// Planes are made as they are asked for: most draws need two of the ten.
struct TexelExplainer::Prepared {
  Prepared(const DrawList& list, std::uint32_t t, const Frame& frame, const DeviceModel& device_model)
      : evaluator(list, t, frame), device(device_model) {
    const auto& w = evaluator.geometry().w;
    affine = w[0] == w[1] && w[1] == w[2];
  }

  // |device − exact| of the interpolated attribute a at the sample, whose exact value is `value`.
  double attribute_bound(std::optional<PlaneBound>& plane, const std::array<double, 3>& a, const Sample& s, double value) {
    const auto& w = evaluator.geometry().w;
    const double slack = device.factor == 0 ? 0 : kEvaluationError * std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
    // Equal w reach the device as w = 1: the plane of 1/w is 1 and the quotient exact.
    if (affine) {
      if (!plane) plane.emplace(evaluator.geometry(), a, 0, device);
      return plane->at(s.x, s.y) + slack;
    }
    if (!plane) {
      const std::array<double, 3> p{a[0] / w[0], a[1] / w[1], a[2] / w[2]};
      plane.emplace(evaluator.geometry(), p, 3 * kUnitRoundoff * std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}), device);
    }
    if (!q_plane) {
      const std::array<double, 3> q{1 / w[0], 1 / w[1], 1 / w[2]};
      q_plane.emplace(evaluator.geometry(), q, 2 * kUnitRoundoff * std::max({q[0], q[1], q[2]}), device);
    }
    return quotient_bound(plane->at(s.x, s.y), q_plane->at(s.x, s.y), value, s.q, device) + slack;
  }

  Bounded color(const Sample& s, int c) {
    const auto& a = evaluator.color(c);
    const double value = evaluator.perspective(s, a);
    return {value, attribute_bound(color_plane[static_cast<std::size_t>(c)], a, s, value)};
  }

  Coordinate coordinate(const Sample& s) {
    Coordinate at;
    at.u = evaluator.perspective(s, evaluator.u());
    at.v = evaluator.perspective(s, evaluator.v());
    at.error_u = attribute_bound(u_plane, evaluator.u(), s, at.u);
    at.error_v = attribute_bound(v_plane, evaluator.v(), s, at.v);
    return at;
  }

  Bounded barycentric(const Sample& s, int vertex) {
    std::array<double, 3> a{};
    for (std::size_t k = 0; k < 3; ++k) a[k] = evaluator.order()[k] == vertex ? 1.0 : 0.0;
    const double value = evaluator.perspective(s, a);
    return {value, attribute_bound(barycentric_plane[static_cast<std::size_t>(vertex)], a, s, value)};
  }

  Bounded depth(const Sample& s) {
    const auto& z = evaluator.z();
    if (!z_plane) {
      const double vertex = std::max({vertex_depth_error(z[0], device), vertex_depth_error(z[1], device), vertex_depth_error(z[2], device)});
      std::array<double, 3> magnitude = z;
      z_plane.emplace(evaluator.geometry(), magnitude, vertex, device);
    }
    return {evaluator.linear(s, z), z_plane->at(s.x, s.y) + device.depth_quantum + (device.factor == 0 ? 0 : kEvaluationError)};
  }

  TriangleEvaluator evaluator;
  const DeviceModel& device;
  bool affine = true;
  std::optional<PlaneBound> u_plane, v_plane, q_plane, z_plane;
  std::array<std::optional<PlaneBound>, 4> color_plane;
  std::array<std::optional<PlaneBound>, 3> barycentric_plane;
};

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

TexelExplainer::~TexelExplainer() = default;

TexelExplainer::Prepared& TexelExplainer::prepared(std::uint32_t triangle) {
  auto& slot = cache_[triangle % kCacheSlots];
  if (slot == nullptr || slot->evaluator.id() != triangle) {
    slot = std::make_unique<Prepared>(input_.list, triangle, input_.frame, input_.device);
  }
  return *slot;
}

std::vector<TexelExplainer::Fragment> TexelExplainer::fragments(int x, int y) {
  std::vector<Fragment> found;
  const TriangleGrid& grid = grid_.get(input_.list, input_.frame);
  for (auto it = grid.begin(x, y); it != grid.end(x, y); ++it) {
    auto& p = prepared(*it);
    if (!p.evaluator.covers(x, y)) continue;
    const Bounded depth = p.depth(p.evaluator.sample(x, y));
    found.push_back({*it, depth.value, depth.bound, is_useless(depth.bound, p.evaluator.z())});
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

TexelExplainer::Outcome TexelExplainer::check_background(const TargetSpec& spec, const std::byte* stored) const {
  std::array<Bounded, 4> clear{};
  for (std::size_t c = 0; c < 4; ++c) clear[c] = {static_cast<double>(spec.clear[c]), 0};
  if (spec.content == TargetContent::depth) clear[0] = {1, 0};
  if (spec.content == TargetContent::triangle_id) clear[0] = {static_cast<double>(kNoTriangle), 0};
  const StoredCheck check = check_texel(stored, spec.format, input_.frame.state.half_rounding, clear, input_.device);
  return {check.legal ? TexelClass::rounding : TexelClass::unexplained, check.share, 0, 0, -1};
}

TexelExplainer::Outcome TexelExplainer::check_color(Prepared& p, const Sample& s, const TargetSpec& spec, const std::byte* stored,
                                                    double widen) {
  const DeviceModel& device = input_.device;
  const auto stored_as = [&](const std::array<Bounded, 4>& value) {
    return check_texel(stored, spec.format, input_.frame.state.half_rounding, value, device);
  };
  const Draw& draw = p.evaluator.draw();
  if (draw.shading == Shading::vertex_color) {
    std::array<Bounded, 4> value{};
    bool useless = false;
    for (int c = 0; c < spec.format.channels; ++c) {
      value[static_cast<std::size_t>(c)] = p.color(s, c);
      useless = useless || is_useless(value[static_cast<std::size_t>(c)].bound, p.evaluator.color(c));
    }
    if (useless && device.factor != 0) return {TexelClass::unbounded, 0, 0, 0, -1};
    const StoredCheck check = stored_as(value);
    return {check.legal ? TexelClass::rounding : TexelClass::unexplained, check.share, 0, 0, -1};
  }

  Outcome outcome;
  bool useless = false;
  // Keeps the mildest explanation; true where nothing milder can follow.
  const auto accept = [&](const Choice& choice, bool first_is_exact, double first_margin, double first_bound) {
    const StoredCheck check = stored_as(choice.value);
    if (!check.legal) return false;
    if (choice.is_exact && first_is_exact) {
      outcome = {TexelClass::rounding, check.share, 0, 0, -1};
      return true;
    }
    const bool by_first = !first_is_exact;
    const double margin = by_first ? first_margin : choice.margin, bound = by_first ? first_bound : choice.margin_bound;
    outcome = {TexelClass::tie, bound > 0 ? margin / bound : 0, margin, bound, -1};
    return true;
  };

  const Coordinate at = p.coordinate(s);
  const Image& texture = *input_.list.images[draw.texture];
  if (draw.shading == Shading::texture) {
    const LookupPlan plan = plan_lookup(texture, draw.sampler, at, device);
    useless = plan.useless;
    if (for_each_choice(plan, device, widen, [&](const Choice& c) { return accept(c, true, 0, 0); })) {
      if (useless) outcome.texel_class = TexelClass::unbounded;
      return outcome;
    }
  } else {
    const LookupPlan first = plan_lookup(*input_.list.images[draw.indexing_map], draw.map_sampler, at, device);
    useless = first.useless;
    const bool found = for_each_choice(first, device, widen, [&](const Choice& m) {
      Coordinate second{m.value[0].value, m.value[1].value, m.value[0].bound, m.value[1].bound};
      if (draw.map_sampler.filter == Filter::linear) {
        // The oracle goes on from the float32 nearest to the exact value.
        const double u = static_cast<double>(canonical(static_cast<float>(second.u))), v = static_cast<double>(canonical(static_cast<float>(second.v)));
        second.error_u += std::abs(u - second.u);
        second.error_v += std::abs(v - second.v);
        second.u = u;
        second.v = v;
      }
      const LookupPlan plan = plan_lookup(texture, draw.sampler, second, device);
      useless = useless || plan.useless;
      return for_each_choice(plan, device, widen, [&](const Choice& c) { return accept(c, m.is_exact, m.margin, m.margin_bound); });
    });
    if (found) {
      if (first.useless) outcome.texel_class = TexelClass::unbounded;
      return outcome;
    }
  }
  if (useless && device.factor != 0) return {TexelClass::unbounded, 0, 0, 0, -1};
  return outcome;
}

TexelExplainer::Outcome TexelExplainer::check_values(int x, int y, std::uint32_t triangle, double widen) {
  Outcome worst{TexelClass::identical, 0, 0, 0, -1};
  for (std::size_t i = 0; i < input_.frame.targets.size(); ++i) {
    const TargetSpec& spec = input_.frame.targets[i];
    if (!is_compared(spec.content) || spec.content == TargetContent::triangle_id || input_.candidate[i].empty()) continue;
    const std::byte* stored = input_.candidate[i].texel(x, y);
    Outcome one;
    if (triangle == kNoTriangle) {
      one = check_background(spec, stored);
    } else {
      auto& p = prepared(triangle);
      const Sample s = p.evaluator.sample(x, y);
      if (spec.content == TargetContent::color) {
        one = check_color(p, s, spec, stored, widen);
      } else {
        std::array<Bounded, 4> value{{{0, 0}, {0, 0}, {0, 0}, {1, 0}}};
        bool useless = false;
        if (spec.content == TargetContent::coordinate) {
          const Coordinate at = p.coordinate(s);
          value[0] = {at.u, at.error_u};
          value[1] = {at.v, at.error_v};
          useless = is_useless(at.error_u, p.evaluator.u()) || is_useless(at.error_v, p.evaluator.v());
        } else if (spec.content == TargetContent::barycentrics) {
          for (int k = 0; k < 3; ++k) {
            value[static_cast<std::size_t>(k)] = p.barycentric(s, k);
            useless = useless || is_useless(value[static_cast<std::size_t>(k)].bound, {0, 0, 1});
          }
        } else {
          value[0] = p.depth(s);
          useless = is_useless(value[0].bound, p.evaluator.z());
        }
        const StoredCheck check = check_texel(stored, spec.format, input_.frame.state.half_rounding, value, input_.device);
        one = {check.legal ? TexelClass::rounding : TexelClass::unexplained, check.share, 0, 0, -1};
        if (useless && input_.device.factor != 0) one.texel_class = TexelClass::unbounded;
      }
    }
    one.target = static_cast<int>(i);
    // Rounding that costs nothing on one target must not hide the share of another.
    if (one.texel_class > worst.texel_class || (one.texel_class == worst.texel_class && one.share > worst.share)) worst = one;
  }
  return worst;
}

Cause TexelExplainer::cause_of(int x, int y, const std::vector<Fragment>& fragments, std::uint32_t golden) {
  if (candidate_id_ >= 0) {
    const std::uint32_t shown = id_at(input_.candidate[static_cast<std::size_t>(candidate_id_)], x, y);
    if (shown != golden) {
      if (shown == kNoTriangle || golden == kNoTriangle) return Cause::coverage;
      if (shown >= input_.list.triangles.size()) return Cause::value;
      if (!prepared(shown).evaluator.covers(x, y)) return Cause::coverage;
      // Something behind shows through where the oracle's triangle was dropped on its own edge.
      return prepared(golden).evaluator.touches(x, y) ? Cause::coverage : Cause::depth_order;
    }
  } else {
    if (golden != kNoTriangle && check_values(x, y, kNoTriangle, 0).texel_class <= TexelClass::rounding) return Cause::coverage;
    if (golden == kNoTriangle) return Cause::coverage;
    for (const Fragment& f : fragments) {
      if (f.triangle != golden && check_values(x, y, f.triangle, 0).texel_class <= TexelClass::tie) {
        return prepared(golden).evaluator.touches(x, y) ? Cause::coverage : Cause::depth_order;
      }
    }
    const TriangleGrid& grid = grid_.get(input_.list, input_.frame);
    for (auto it = grid.begin(x, y); it != grid.end(x, y); ++it) {
      const auto& e = prepared(*it).evaluator;
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
  if (golden != kNoTriangle && (golden >= input_.list.triangles.size() || !prepared(golden).evaluator.covers(x, y))) {
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
      const auto try_other = [&](std::uint32_t other) {
        if (other == golden) return false;
        const auto tie = depth_tie(covering, golden, other);
        if (!tie) return false;
        const Outcome values = check_values(x, y, other, 0);
        if (values.texel_class > TexelClass::tie) return false;
        apply(*tie);
        verdict.target = values.target;
        verdict.candidate_triangle = other;
        return true;
      };
      bool found = false;
      for (std::size_t k = 0; k < covering.size() && !found; ++k) found = try_other(covering[k].triangle);
      if (!found) found = try_other(kNoTriangle);
    }
  }
  verdict.texel_class = std::max(verdict.texel_class, TexelClass::rounding);  // the bytes differ, whatever explains them
  // Against the contract itself there is no rounding to allow.
  if (verdict.texel_class == TexelClass::rounding && input_.device.factor == 0) verdict.texel_class = TexelClass::unexplained;
  if (verdict.texel_class == TexelClass::unexplained) {
    gather();
    verdict.cause = cause_of(x, y, covering, golden);
  }
  return verdict;
}

std::string TexelExplainer::describe(int x, int y, const TexelVerdict& verdict) {
  std::string text = fmt::format("texel ({}, {}): ", x, y);
  if (verdict.triangle == kNoTriangle) {
    text += "nothing is drawn here";
  } else {
    auto& p = prepared(verdict.triangle);
    const Sample s = p.evaluator.sample(x, y);
    text += fmt::format("triangle {}, {:.6g} sub-texels from its nearest edge", verdict.triangle, p.evaluator.edge_margin(s));
    const Draw& draw = p.evaluator.draw();
    if (draw.shading != Shading::vertex_color) {
      const Coordinate at = p.coordinate(s);
      const bool indexed = draw.shading == Shading::indexed;
      const Image& image = *input_.list.images[indexed ? draw.indexing_map : draw.texture];
      const Sampler& sampler = indexed ? draw.map_sampler : draw.sampler;
      const LookupPlan plan = plan_lookup(image, sampler, at, input_.device);
      const double shift = sampler.filter == Filter::linear ? 0.5 : 0.0;
      const auto margin = [shift](double c) { return std::abs(c - shift - std::round(c - shift)); };
      text += fmt::format(", {} coordinate ({:.9g}, {:.9g}) texels, margins ({:.3g}, {:.3g}), device bound ({:.3g}, {:.3g})",
                          indexed ? "map" : "texture", plan.x, plan.y, margin(plan.x), margin(plan.y), plan.bound_x, plan.bound_y);
    }
  }
  switch (verdict.texel_class) {
    case TexelClass::identical: return text + ": the bytes are the same";
    case TexelClass::rounding:
      return text + fmt::format(": rounding, the stored value needs {:.3g} of the device's bound", verdict.share);
    case TexelClass::tie:
      if (verdict.candidate_triangle != verdict.triangle) {
        return text + fmt::format(": tie of depth, {} is visible instead; gap {:.3g}, bound {:.3g}",
                                  verdict.candidate_triangle == kNoTriangle ? std::string("the background")
                                                                            : fmt::format("triangle {}", verdict.candidate_triangle),
                                  verdict.margin, verdict.margin_bound);
      }
      return text + fmt::format(": tie, the texel beyond a border {:.3g} texels away was chosen, bound {:.3g}; its value is the one stored",
                                verdict.margin, verdict.margin_bound);
    case TexelClass::unbounded: return text + ": unbounded, float32 setup degenerates on this triangle and allows anything";
    case TexelClass::unexplained: break;
  }
  return text + fmt::format(": UNEXPLAINED ({})", to_string(verdict.cause));
}

}  // namespace etalon::validation
