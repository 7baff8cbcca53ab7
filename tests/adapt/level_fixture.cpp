#include "tests/adapt/level_fixture.h"

#include <utility>

#include "core/mesh/weld.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"

namespace etalon::test {
namespace {

progressive::ProgressiveData levels_of(const Mesh& input, std::size_t base_faces, simplify::CollapseKind collapse) {
  simplify::SimplifyOptions options;
  options.metric = simplify::MetricName::qem5;
  options.target_faces = base_faces;
  options.collapse = collapse;
  return progressive::make_progressive(welded_by_position(input), options).data;
}

}  // namespace

ModelLevels::ModelLevels(procedural::Model input, std::size_t base_faces, simplify::CollapseKind collapse)
    : model(std::move(input)), mesh(levels_of(model.mesh, base_faces, collapse)), sequence(mesh) {}

ModelLevels& swirl() {
  static ModelLevels made(procedural::make_swirl({.faces = 7688, .texture_size = 512}), 399);
  return made;
}

ModelLevels& head() {
  static ModelLevels made(procedural::make_head(), 499);
  return made;
}

}  // namespace etalon::test
