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

nlohmann::ordered_json repair_json(const simplify::InputRepair& repair) {
  nlohmann::ordered_json document = nlohmann::ordered_json::object();
  const auto add = [&](const char* name, const Defect& defect) { document[name] = {{"count", defect.count}, {"first", defect.first}}; };
  add("repeated_corners", repair.repeated_corners);
  add("duplicate_faces", repair.duplicate_faces);
  add("non_manifold_edges", repair.non_manifold_edges);
  add("inconsistent_edges", repair.inconsistent_edges);
  add("non_manifold_vertices", repair.non_manifold_vertices);
  add("unreferenced_vertices", repair.unreferenced_vertices);
  add("color_seam_vertices", repair.color_seam_vertices);
  return document;
}

}  // namespace etalon::cli
