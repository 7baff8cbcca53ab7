// The explainer's question of values: are these bytes what the device may legally store for this triangle at this texel?
#include <algorithm>
#include <cmath>

#include "validation/texel_explainer.h"

namespace etalon::validation {

TexelExplainer::Outcome TexelExplainer::check_background(const TargetSpec& spec, const std::byte* stored) const {
  std::array<Bounded, 4> clear{};
  for (std::size_t c = 0; c < 4; ++c) clear[c] = {static_cast<double>(spec.clear[c]), 0};
  if (spec.content == TargetContent::depth) clear[0] = {1, 0};
  if (spec.content == TargetContent::triangle_id) clear[0] = {static_cast<double>(kNoTriangle), 0};
  const StoredCheck check = check_texel(stored, spec.format, input_.frame.state.half_rounding, clear, input_.device);
  return {check.legal ? TexelClass::rounding : TexelClass::unexplained, check.share, 0, 0, -1};
}

TexelExplainer::Outcome TexelExplainer::check_color(BoundedTriangle& p, const Sample& s, const TargetSpec& spec, const std::byte* stored,
                                                    double widen) {
  const DeviceModel& device = input_.device;
  const auto stored_as = [&](const std::array<Bounded, 4>& value) {
    return check_texel(stored, spec.format, input_.frame.state.half_rounding, value, device);
  };
  const Draw& draw = p.evaluator().draw();
  if (draw.shading == Shading::vertex_color) {
    std::array<Bounded, 4> value{};
    bool useless = false;
    for (int c = 0; c < spec.format.channels; ++c) {
      value[static_cast<std::size_t>(c)] = p.color(s, c);
      useless = useless || is_useless(value[static_cast<std::size_t>(c)].bound, p.evaluator().color(c));
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
        const double u = static_cast<double>(canonical(static_cast<float>(second.u))),
                     v = static_cast<double>(canonical(static_cast<float>(second.v)));
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
      BoundedTriangle& p = prepared(triangle);
      const Sample s = p.evaluator().sample(x, y);
      if (spec.content == TargetContent::color) {
        one = check_color(p, s, spec, stored, widen);
      } else {
        std::array<Bounded, 4> value{{{0, 0}, {0, 0}, {0, 0}, {1, 0}}};
        bool useless = false;
        if (spec.content == TargetContent::coordinate) {
          const Coordinate at = p.coordinate(s);
          value[0] = {at.u, at.error_u};
          value[1] = {at.v, at.error_v};
          useless = is_useless(at.error_u, p.evaluator().u()) || is_useless(at.error_v, p.evaluator().v());
        } else if (spec.content == TargetContent::barycentrics) {
          for (int k = 0; k < 3; ++k) {
            value[static_cast<std::size_t>(k)] = p.barycentric(s, k);
            useless = useless || is_useless(value[static_cast<std::size_t>(k)].bound, {0, 0, 1});
          }
        } else {
          value[0] = p.depth(s);
          useless = is_useless(value[0].bound, p.evaluator().z());
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

}  // namespace etalon::validation
