// The words of the explainer: class names, and one sentence for a texel.
#include <fmt/format.h>

#include <cmath>

#include "validation/texel_explainer.h"

namespace etalon::validation {

std::string to_string(TexelClass value) {
  constexpr const char* kNames[] = {"identical", "rounding", "tie", "unbounded", "unexplained"};
  return kNames[static_cast<int>(value)];
}

std::string to_string(Cause value) {
  constexpr const char* kNames[] = {"none", "coverage", "depth order", "texel choice", "value"};
  return kNames[static_cast<int>(value)];
}

std::string TexelExplainer::describe(int x, int y, const TexelVerdict& verdict) {
  std::string text = fmt::format("texel ({}, {}): ", x, y);
  if (verdict.triangle == kNoTriangle) {
    text += "nothing is drawn here";
  } else {
    BoundedTriangle& p = prepared(verdict.triangle);
    const Sample s = p.evaluator().sample(x, y);
    text += fmt::format("triangle {}, {:.6g} sub-texels from its nearest edge", verdict.triangle, p.evaluator().edge_margin(s));
    const Draw& draw = p.evaluator().draw();
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
    case TexelClass::rounding: return text + fmt::format(": rounding, the stored value needs {:.3g} of the device's bound", verdict.share);
    case TexelClass::tie:
      if (verdict.candidate_triangle != verdict.triangle) {
        return text + fmt::format(": tie of depth, {} is visible instead; gap {:.3g}, bound {:.3g}",
                                  verdict.candidate_triangle == kNoTriangle ? std::string("the background")
                                                                            : fmt::format("triangle {}", verdict.candidate_triangle),
                                  verdict.margin, verdict.margin_bound);
      }
      return text + fmt::format(": tie, the texel beyond a border {:.3g} texels away was chosen, bound {:.3g}; its value is the one stored",
                                verdict.margin, verdict.margin_bound);
    case TexelClass::unbounded:
      return text + ": unbounded, the device's own error may exceed half a texel or a quarter of the value's range here";
    case TexelClass::unexplained: break;
  }
  return text + fmt::format(": UNEXPLAINED ({})", to_string(verdict.cause));
}

}  // namespace etalon::validation
