// What `etalon study soucy` works on: the range images and the duck of the paper, real scans where they are found, the user's own.
#pragma once

#include <string>
#include <vector>

#include "cli/call_files.h"
#include "cli/console.h"
#include "cli/range_input.h"
#include "validation/studies/soucy_study.h"

namespace etalon::cli {

struct SoucySubjectOptions {
  std::vector<std::string>
      models;                ///< files, or shuttle, hand, soldier, teapot, telephone, duck; empty: all these, and the real scans found
  std::size_t faces = 1000;  ///< of coloured models
  std::vector<std::string> tolerances;  ///< of range image files: lengths, ascending; empty: 0.5, 1 and 2 % of the diagonal
  RangeOptions range;                   ///< how range image files are read
  std::string data;                     ///< folder of real inputs; empty: $ETALON_DATA, else etalon in the user's cache
  bool quick = false;                   ///< one range image, a small duck, and nothing else unless named
};

struct SoucySubjects {
  std::vector<validation::SoucyScan> scans;
  std::vector<validation::SoucyModel> models;
};

/// Reads or makes them; files are added to `files`. A range image file (.png .tif .exr) is studied with the test patterns and, where the image of
/// its colours is given, as a coloured model too; a mesh file as a coloured model. InputError where a file cannot be read or a mesh has no vertex
/// colours; UsageError for a tolerance that is no length above the one before, and for options of range images beside a mesh.
[[nodiscard]] SoucySubjects load_soucy_subjects(const SoucySubjectOptions& options, Console& console, CallFiles& files);

}  // namespace etalon::cli
