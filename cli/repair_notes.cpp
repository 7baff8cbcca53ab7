#include "cli/repair_notes.h"

#include <fmt/format.h>

#include "validation/report/json_report.h"

namespace etalon::cli {

void print_repair(Console& console, const simplify::InputRepair& repair) {
  const auto say = [&](const Defect& defect, const char* what, const char* place, const char* done) {
    if (defect.found())
      console.line(fmt::format("note: {}: {} ({} {}{}): {}", what, validation::grouped(defect.count), place, defect.first[0],
                               defect.count > 1 ? ", …" : "", done));
  };
  say(repair.repeated_corners, "faces that name a vertex twice", "face", "dropped");
  say(repair.duplicate_faces, "faces that repeat an earlier one", "face", "dropped");
  say(repair.non_manifold_edges, "edges of more than two faces", "face", "kept as they are");
  say(repair.inconsistent_edges, "edges between faces of opposite orientation", "face", "kept as they are");
  say(repair.non_manifold_vertices, "vertices whose faces are not one fan", "vertex", "kept as they are");
  say(repair.color_seam_vertices, "boundary vertices that share their place with another colour", "vertex", "kept as they are");
  say(repair.unreferenced_vertices, "vertices of no face", "vertex", "dropped");
}

}  // namespace etalon::cli
