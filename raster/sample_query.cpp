#include "raster/sample_query.h"

#include <limits>

#include "core/base/float_environment.h"
#include "raster/visibility.h"

namespace etalon::raster {

SampleQuery::SampleQuery(const DrawList& list, const Frame& frame, Evaluation evaluation)
    : list_(list), frame_(frame), evaluation_(evaluation) {
  validate(list, frame);
}

const TriangleSetup& SampleQuery::setup(std::uint32_t t) const {
  if (t != current_) setup_ = make_triangle_setup(list_, t, frame_), current_ = t;
  return setup_;
}

bool SampleQuery::covers(std::uint32_t t, int i, int j) const {
  const Edges& edges = setup(t).edges;
  if (i < edges.i_min || i > edges.i_max || j < edges.j_min || j > edges.j_max) return false;
  const auto span = edges.span(j);
  return i >= span[0] && i <= span[1];
}

float SampleQuery::depth(std::uint32_t t, int i, int j) const {
  const DefaultFloatEnvironment environment;
  const TriangleSetup& s = setup(t);
  return stored_depth(s.edges.at(i, j), s.edges.area2, s.attribute[kDepth]);
}

void SampleQuery::store(std::uint32_t t, int i, int j, std::byte* const* texels) const {
  const DefaultFloatEnvironment environment;
  EvaluationCounters ignored;
  store_sample(list_, list_.draw_of(t), frame_, setup(t), t, i, j, {depth(t, i, j), std::numeric_limits<float>::infinity()}, evaluation_,
               texels, ignored);
}

}  // namespace etalon::raster
