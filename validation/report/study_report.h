// What a study found, as plain data: claims of a paper with their verdicts, tables, figures. study_page.h turns it into files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// A figure of a table: what a person reads, and the number behind it.
struct StudyCell {
  std::string text;
  std::optional<double> value;  ///< none: the text is all there is
};
/// "0.0731" with so many digits after the point; "–" for no value.
[[nodiscard]] StudyCell number_cell(std::optional<double> value, int digits);
[[nodiscard]] StudyCell count_cell(std::uint64_t value);

struct StudyTable {
  std::string name;  ///< [a-z0-9-]: also the stem of its CSV file
  std::string title;
  std::string note;  ///< what the numbers are, in which unit
  std::vector<std::string> columns;
  std::vector<std::vector<StudyCell>> rows;
  bool timed = false;   ///< holds times: in the document it stands inside `run`
  bool folded = false;  ///< long: the page shows it on demand
};

struct StudyPicture {
  std::string file;  ///< name of its PNG in the study's folder; equal names are one picture
  std::string label;
  Image image;  ///< RGB unorm8
};

/// Any other file beside the page, which links it: bytes as they are.
struct StudyFile {
  std::string file;  ///< its name in the study's folder
  std::string label;
  std::string bytes;
};

/// A page or table elsewhere.
struct StudyLink {
  std::string href;  ///< relative to the study's folder
  std::string label;
};

struct StudyFigure {
  std::string id;  ///< [a-z0-9-]
  std::string title;
  std::string caption;
  std::string svg;  ///< inline drawing; empty where there is none
  std::vector<StudyPicture> pictures;
  int columns = 3;               ///< pictures side by side
  std::vector<StudyFile> files;  ///< linked below the caption
  bool is_film = false;          ///< the page shows one picture at a time, with a slider; all of them without scripts
  std::vector<StudyLink> links;  ///< as files, but written by someone else
};

enum class ClaimVerdict : std::uint8_t { holds, partly, fails };
[[nodiscard]] const char* to_string(ClaimVerdict verdict);

struct StudyClaim {
  std::string where;  ///< in the paper: "table 2"
  std::string claim;
  std::string measured;
  std::string why;  ///< empty where it holds
  ClaimVerdict verdict = ClaimVerdict::holds;
  bool timed = false;  ///< rests on times: in the document it stands inside `run`
};

struct StudyReport {
  std::string name;   ///< "kim"
  std::string title;  ///< of the page
  std::string paper;  ///< who is studied
  std::string lede;
  std::vector<VerifyInput> inputs;
  std::vector<StudyClaim> claims;
  std::vector<StudyTable> tables;
  std::vector<StudyFigure> figures;  ///< those after the tables
  std::vector<std::string> notes;    ///< how it was measured, one sentence or two each
};

}  // namespace etalon::validation
