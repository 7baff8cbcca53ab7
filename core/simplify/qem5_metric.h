// The metric `qem5`: area-weighted squared distances in the space of position and texture coordinate, 21 coefficients a wedge (84 bytes).
// [Garland & Heckbert 1998, sec. 3, table of coefficients]; wedges [Hoppe 1999, sec. 5].
#pragma once

#include "core/simplify/attribute_metric.h"
#include "core/simplify/attribute_quadric.h"

namespace etalon::simplify {

using Qem5Metric = AttributeMetric<AttributeQuadric, UvAttributes>;

}  // namespace etalon::simplify
