#include "core/adapt/split_cells.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

#include "core/adapt/cell_map.h"
#include "core/base/rng.h"
#include "core/mesh/exact_orientation.h"
#include "core/mesh/weld.h"
#include "core/procedural/head.h"
#include "core/procedural/swirl.h"

using namespace etalon;
using namespace etalon::adapt;

namespace {

struct Tally {
  std::map<CellStatus, int> status;
  std::size_t cells = 0, crossings = 0;
  int u_damped = 0, crossings_damped = 0, splits = 0;
};

Tally tally_of(const Mesh& input, std::size_t faces, simplify::CollapseKind collapse = simplify::CollapseKind::half) {
  simplify::SimplifyOptions options;
  options.metric = simplify::MetricName::qem5;
  options.target_faces = faces;
  options.collapse = collapse;
  progressive::ProgressiveMesh mesh(progressive::make_progressive(welded_by_position(input), options).data);
  Tally tally;
  for (mesh.go_to(mesh.split_count()); mesh.level() > 0; mesh.go_to(mesh.level() - 1)) {
    ++tally.splits;
    const auto charts = cells_of_split(mesh, mesh.level() - 1);
    REQUIRE(charts.size() >= 1);
    REQUIRE(charts.size() <= (collapse == simplify::CollapseKind::half ? 2 : 4));
    for (const ChartCells& chart : charts) {
      ++tally.status[chart.status];
      if (chart.status != CellStatus::made) continue;
      const RingCells& cells = chart.cells;
      tally.cells += cells.cells.size(), tally.crossings += cells.nodes.size();
      tally.u_damped += cells.u_kept < 1 ? 1 : 0, tally.crossings_damped += cells.crossings_kept < 1 ? 1 : 0;
      int before = 0, after = 0;
      for (const auto& cell : cells.cells) {
        const CellNode &a = cells.nodes[cell[0]], &b = cells.nodes[cell[1]], &c = cells.nodes[cell[2]];
        before += orientation(a.before, b.before, c.before), after += orientation(a.after, b.after, c.after);
      }
      REQUIRE(std::abs(before) == static_cast<int>(cells.cells.size()));  // all turn one way: the chart's
      REQUIRE(after == before);
    }
  }
  return tally;
}

void report(const std::string& name, Tally tally) {
  MESSAGE(name << ": " << tally.splits << " splits, " << tally.status[CellStatus::made] << " with cells, " << tally.status[CellStatus::fold]
               << " folds, " << tally.status[CellStatus::no_place] << " without place, " << tally.status[CellStatus::gone] << " gone; "
               << tally.cells << " cells; u damped " << tally.u_damped << ", crossings damped " << tally.crossings_damped);
}

}  // namespace

TEST_CASE("split cells: the swirl down to 399 faces") {
  const Tally tally = tally_of(procedural::make_swirl().mesh, 399);
  report("swirl", tally);
  CHECK(tally.splits > 3000);
  CHECK(tally.status.at(CellStatus::made) >= tally.splits * 95 / 100);
}

TEST_CASE("split cells: the head down to 499 faces") {
  const Tally tally = tally_of(procedural::make_head().mesh, 499);
  report("head", tally);
  CHECK(tally.splits > 3000);
  CHECK(tally.status.at(CellStatus::made) >= tally.splits * 95 / 100);
}

TEST_CASE("split cells: full-edge collapses of the swirl and the head") {
  const Tally swirl = tally_of(procedural::make_swirl().mesh, 399, simplify::CollapseKind::full);
  report("swirl, full-edge", swirl);
  CHECK(swirl.status.at(CellStatus::made) >= swirl.splits * 99 / 100);
  const Tally head = tally_of(procedural::make_head({.faces = 3000, .texture_size = 64}).mesh, 300, simplify::CollapseKind::full);
  report("head, full-edge", head);
  CHECK(head.status.at(CellStatus::made) >= head.splits * 98 / 100);
}

TEST_CASE("split cells: faces around vertices, kept on the way down, give the same rings as looking at every face") {
  simplify::SimplifyOptions options;
  options.collapse = simplify::CollapseKind::full;
  progressive::ProgressiveMesh mesh(
      progressive::make_progressive(welded_by_position(procedural::make_head({.faces = 400, .texture_size = 64}).mesh), options).data);
  mesh.go_to(mesh.split_count());
  VertexFaces faces(mesh);
  std::size_t moved = 0;
  for (std::size_t n = mesh.split_count(); n-- > 0; mesh.go_to(n)) {
    moved += mesh.data().splits[n].move != progressive::kNone ? 1 : 0;
    REQUIRE(cells_of_split(mesh, n, &faces) == cells_of_split(mesh, n));
    faces.coarsen(mesh, n);
  }
  CHECK(moved > 50);
}
