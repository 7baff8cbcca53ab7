// Ways to simplify: ours and the rivals', all with the same input and output, timed around the library call alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace etalon::bench {

/// What one call gave.
struct SimplifyOutcome {
  Mesh mesh;
  double seconds = 0;  ///< CPU of this process, in the library's call; building its mesh and reading ours back are outside
};

struct SimplifyWay {
  std::string name;                                                         ///< one word, as on the command line: "ours-qem", "cgal-gh"
  std::string title;                                                        ///< for tables: library, version, method
  std::function<SimplifyOutcome(Mesh mesh, std::size_t target_faces)> run;  ///< empty where the library is absent
  std::string absent;                                                       ///< why: the package that has it
};

/// All ways, ours first; those whose library was absent when this was built have no `run`.
[[nodiscard]] const std::vector<SimplifyWay>& simplify_ways();
/// The way of this name; InputError where there is none.
[[nodiscard]] const SimplifyWay& simplify_way(const std::string& name);

// The rivals, each in a file that is built only where its library is. They give `mesh` back before the call, once they have their own.
SimplifyOutcome simplify_with_cgal(Mesh mesh, std::size_t target_faces);      ///< Garland & Heckbert, plane quadrics, optimal placement
SimplifyOutcome simplify_with_openmesh(Mesh mesh, std::size_t target_faces);  ///< DecimaterT with ModQuadricT: half-edge collapses
SimplifyOutcome simplify_with_meshopt(Mesh mesh, std::size_t target_faces);   ///< meshopt_simplify without options

/// CPU seconds of this process so far.
[[nodiscard]] double process_cpu_seconds();

}  // namespace etalon::bench
