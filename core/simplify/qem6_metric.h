// The metric `qem6`: area-weighted squared distances in the space of position and colour, 28 coefficients a vertex (112 bytes).
// [Garland & Heckbert 1998]; [Kim, Choi & Lee 2008, sec. 3.2, eqs. 10-12].
#pragma once

#include "core/simplify/attribute_metric.h"
#include "core/simplify/attribute_quadric.h"

namespace etalon::simplify {

using Qem6Metric = AttributeMetric<AttributeQuadric, ColorAttributes>;

}  // namespace etalon::simplify
