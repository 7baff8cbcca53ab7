// The terrains of `etalon study horbelt`: davosdorf where it is found, the procedural alps, the user's own.
#pragma once

#include <string>
#include <vector>

#include "cli/call_files.h"
#include "cli/console.h"
#include "validation/studies/horbelt_study.h"

namespace etalon::cli {

struct HorbeltSubjectOptions {
  std::vector<std::string> models;  ///< davosdorf, alps, or one DEM and its IMAGE; empty: both of the former
  std::string data;                 ///< folder of real inputs; empty: $ETALON_DATA, else etalon in the user's cache
  bool quick = false;               ///< small alps, and davosdorf only where named
};

/// Reads or makes them; files are added to `files`. UsageError for a DEM without an image. InputError as load_terrain().
[[nodiscard]] std::vector<validation::HorbeltSubject> load_horbelt_subjects(const HorbeltSubjectOptions& options, Console& console,
                                                                            CallFiles& files);

}  // namespace etalon::cli
