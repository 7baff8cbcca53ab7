// A source file as the rules see it: its #include lines, and its code without comments and literals.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etalon::test {

struct SourceFile {
  std::string path;  ///< from the root of the tree, with '/': "core/mesh/mesh.h"
  std::string text;
};

struct Include {
  int line = 0;
  std::string target;   ///< between the quotes or angle brackets
  bool quoted = false;  ///< "target", not <target>
};

/// What a rule found: one line for a person.
struct Violation {
  std::string path;
  int line = 0;  ///< from 1; 0 where the whole file is meant
  std::string rule;
  std::string detail;
  [[nodiscard]] std::string text() const;
};

/// Every #include outside comments, with any spacing ("#  include").
[[nodiscard]] std::vector<Include> includes_of(std::string_view text);

/// The same text with the characters of comments, string and character literals (raw ones too) replaced by spaces; line breaks stay.
[[nodiscard]] std::string code_only(std::string_view text);

/// Folder of a path: "core/mesh" for "core/mesh/mesh.h"; "" at the root.
[[nodiscard]] std::string folder_of(std::string_view path);

/// Whether `path` is `folder` or lies below it.
[[nodiscard]] bool is_under(std::string_view path, std::string_view folder);

/// Every .h, .cpp and .inc file of the tree below `root` (build folders excluded), sorted by path.
[[nodiscard]] std::vector<SourceFile> read_tree(const std::string& root);

}  // namespace etalon::test
