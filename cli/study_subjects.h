// The models of `etalon study kim`: procedural ones of the paper's sizes, real ones where they are found, the user's own.
#pragma once

#include <string>
#include <vector>

#include "cli/call_files.h"
#include "cli/console.h"
#include "validation/studies/kim_study.h"

namespace etalon::cli {

struct SubjectOptions {
  std::vector<std::string> models;  ///< files, or monkey, duck, statue; empty: these three, and the real ones found
  std::string data;                 ///< folder of real inputs; empty: $ETALON_DATA, else etalon in the user's cache
  double reduction = 0.9;           ///< of the files' vertices
  bool quick = false;               ///< small procedural models, and no real ones unless named
};

/// Reads or makes them; files are added to `files`. InputError where a file cannot be read or has no vertex colours.
[[nodiscard]] std::vector<validation::KimSubject> load_subjects(const SubjectOptions& options, Console& console, CallFiles& files);

/// The stem of a file's name in [a-z0-9_]: for names of files and anchors.
[[nodiscard]] std::string slug_of(const std::string& path);

/// Where real inputs are looked for: `given`, else $ETALON_DATA, else etalon in the user's cache; empty where none of them is known.
[[nodiscard]] std::string data_folder(const std::string& given);

}  // namespace etalon::cli
