// The metric `hoppe`: squared distances to planes, and of colours to those that the planes' faces have below: 23 coefficients a vertex (92
// bytes).
// [Hoppe 1999, sec. 4].
#pragma once

#include "core/simplify/attribute_metric.h"
#include "core/simplify/hoppe_quadric.h"

namespace etalon::simplify {

using HoppeMetric = AttributeMetric<HoppeQuadric, ColorAttributes>;

}  // namespace etalon::simplify
