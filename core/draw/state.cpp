#include "core/draw/state.h"

namespace etalon {

std::string to_string(SnapRounding value) {
  switch (value) {
    case SnapRounding::nearest_even: return "nearest_even";
    case SnapRounding::half_up: return "half_up";
    case SnapRounding::half_away: return "half_away";
    case SnapRounding::toward_zero: return "toward_zero";
    case SnapRounding::floor: return "floor";
  }
  return "?";
}

std::string to_string(FillRule value) {
  switch (value) {
    case FillRule::left_ymin: return "left_ymin";
    case FillRule::left_ymax: return "left_ymax";
    case FillRule::right_ymin: return "right_ymin";
    case FillRule::right_ymax: return "right_ymax";
  }
  return "?";
}

std::string to_string(HalfRounding value) { return value == HalfRounding::nearest_even ? "nearest_even" : "toward_zero"; }

std::string to_string(Filter value) { return value == Filter::nearest ? "nearest" : "linear"; }

std::string to_string(Wrap value) {
  switch (value) {
    case Wrap::clamp: return "clamp";
    case Wrap::repeat: return "repeat";
    case Wrap::mirrored_repeat: return "mirrored_repeat";
  }
  return "?";
}

std::string to_string(TargetContent value) {
  switch (value) {
    case TargetContent::color: return "color";
    case TargetContent::triangle_id: return "triangle_id";
    case TargetContent::barycentrics: return "barycentrics";
    case TargetContent::coordinate: return "coordinate";
    case TargetContent::depth: return "depth";
    case TargetContent::margins: return "margins";
    case TargetContent::bound_terms: return "bound_terms";
  }
  return "?";
}

}  // namespace etalon
