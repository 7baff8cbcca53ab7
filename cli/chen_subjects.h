// The models of `etalon study chen`: procedural ones of the paper's sizes, real ones where they are found, the user's own.
#pragma once

#include <string>
#include <vector>

#include "cli/call_files.h"
#include "cli/console.h"
#include "validation/studies/chen_study.h"

namespace etalon::cli {

struct ChenSubjectOptions {
  std::vector<std::string> models;  ///< files, or swirl, head, parasaur, bunny, spot; empty: all that can be made or found
  std::vector<std::size_t> levels;  ///< faces of a file's levels; empty: a quarter, an eighth, a sixteenth
  std::string texture;              ///< of the files; empty: their own
  bool flip_v = false;              ///< of the files
  std::string data;                 ///< folder of real inputs; empty: $ETALON_DATA, else etalon in the user's cache
  bool quick = false;               ///< small procedural models, and no others unless named
};

/// Reads or makes them; files are added to `files`. InputError where a file cannot be read, or has no texture coordinates or several textures.
[[nodiscard]] std::vector<validation::ChenSubject> load_chen_subjects(const ChenSubjectOptions& options, Renderer& exact, Console& console,
                                                                      CallFiles& files);

}  // namespace etalon::cli
