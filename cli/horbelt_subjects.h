// The terrains of `etalon study horbelt`: davosdorf where it is found, the procedural alps, the user's own.
#pragma once

#include <string>
#include <vector>

#include "cli/call_files.h"
#include "cli/console.h"
#include "cli/size_option.h"
#include "cli/terrain_input.h"
#include "validation/studies/horbelt_study.h"

namespace etalon::cli {

struct HorbeltSubjectOptions {
  std::vector<std::string> models;  ///< davosdorf, alps, or one DEM and its IMAGE; empty: both of the former
  std::string data;                 ///< folder of real inputs; empty: $ETALON_DATA, else etalon in the user's cache
  TerrainOptions terrain;           ///< of files of one's own
  bool quick = false;               ///< small alps, and davosdorf only where named
  std::vector<std::string> views;   ///< as --view gives them; empty: the study's own five
  std::string size;                 ///< of their frames, as --size gives it; empty: a view file's own, else `frame`
  FrameSize frame{640, 480};
};

/// Reads or makes them, with their views; files are added to `files`. UsageError for a DEM without an image, and for two terrains or views of one
/// name. InputError as load_terrain(), and chosen_terrain_view()'s errors. A view of the name "TERRAIN-NAME", as a study writes them, is NAME.
[[nodiscard]] std::vector<validation::HorbeltSubject> load_horbelt_subjects(const HorbeltSubjectOptions& options, Console& console,
                                                                            CallFiles& files);

}  // namespace etalon::cli
