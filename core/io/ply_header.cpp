#include "core/io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/io/input_error.h"
#include "core/io/text_scan.h"

namespace etalon::io {
namespace {

std::optional<PlyType> type_named(std::string_view word) {
  struct Name {
    std::string_view old_style, sized;
    PlyType type;
  };
  static constexpr Name kNames[] = {{"char", "int8", PlyType::int8},        {"uchar", "uint8", PlyType::uint8},
                                    {"short", "int16", PlyType::int16},     {"ushort", "uint16", PlyType::uint16},
                                    {"int", "int32", PlyType::int32},       {"uint", "uint32", PlyType::uint32},
                                    {"float", "float32", PlyType::float32}, {"double", "float64", PlyType::float64}};
  for (const Name& name : kNames)
    if (word == name.old_style || word == name.sized) return name.type;
  return std::nullopt;
}

class HeaderParser {
 public:
  HeaderParser(const std::string& file, std::string_view content) : file_(file), content_(content) {
    // Lines end as the first one does: "\n", "\r\n" (the '\r' counts as a blank), or a bare '\r'.
    const std::size_t end = content.find_first_of("\r\n");
    if (end != content.npos && content[end] == '\r' && (end + 1 == content.size() || content[end + 1] != '\n')) line_end_ = '\r';
  }

  PlyHeader parse() {
    if (trimmed(next_line()) != "ply") fail(fmt::format("expected 'ply', got '{}'", printable(content_.substr(0, 16))));
    while (true) {
      std::string_view rest = next_line();
      const std::string_view keyword = take_word(rest);
      if (keyword == "end_header") break;
      read_statement(keyword, rest);
    }
    if (!has_format_) fail("expected a line 'format ascii|binary_little_endian|binary_big_endian 1.0' in the header, got none");
    header_.body_offset_bytes = at_;
    check_counts();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_at_line(file_, std::max<std::size_t>(header_.line_count, 1), what); }

  std::string_view next_line() {
    const std::size_t end = content_.find(line_end_, at_);
    if (end == content_.npos) {
      ++header_.line_count;
      fail("the header ends without 'end_header'");
    }
    const std::string_view line = content_.substr(at_, end - at_);
    at_ = end + 1;
    ++header_.line_count;
    return line;
  }

  void read_statement(std::string_view keyword, std::string_view rest) {
    if (keyword.empty()) return;
    if (keyword == "obj_info") return read_info(rest);
    if (keyword == "comment") {
      if (take_word(rest) == "TextureFile") header_.texture_names.emplace_back(trimmed(rest));
      return;
    }
    if (keyword == "format") return read_format(rest);
    if (keyword == "element") return read_element(rest);
    if (keyword == "property") return read_property(rest);
    fail(fmt::format("expected format, comment, obj_info, element, property or end_header, got '{}'", printable(keyword)));
  }

  /// The sizes of a range grid; whatever else stands there is the writer's own.
  void read_info(std::string_view rest) {
    const std::string_view key = take_word(rest);
    if (key != "num_cols" && key != "num_rows") return;
    const std::optional<std::int64_t> count = parse_integer(trimmed(rest));
    if (!count || *count < 1) fail(fmt::format("{}: expected a count from 1, got '{}'", key, printable(trimmed(rest))));
    (key == "num_cols" ? header_.grid_columns : header_.grid_rows) = static_cast<std::uint64_t>(*count);
  }

  void read_format(std::string_view rest) {
    const std::string_view encoding = take_word(rest);
    const std::string_view version = take_word(rest);
    if (encoding == "ascii")
      header_.encoding = PlyEncoding::ascii;
    else if (encoding == "binary_little_endian")
      header_.encoding = PlyEncoding::little_endian;
    else if (encoding == "binary_big_endian")
      header_.encoding = PlyEncoding::big_endian;
    else
      fail(fmt::format("format: expected ascii, binary_little_endian or binary_big_endian, got '{}'", printable(encoding)));
    if (version != "1.0") fail(fmt::format("format version: expected 1.0, got '{}'", printable(version)));
    has_format_ = true;
  }

  void read_element(std::string_view rest) {
    const std::string_view name = take_word(rest);
    const std::string_view count_word = take_word(rest);
    const std::optional<std::int64_t> count = parse_integer(count_word);
    if (name.empty() || !count || *count < 0)
      fail(fmt::format("element '{}': expected a count from 0, got '{}'", printable(name), printable(count_word)));
    for (const PlyElement& other : header_.elements)
      if (other.name == name) fail(fmt::format("element '{}' is declared twice", printable(name)));
    header_.elements.push_back({std::string(name), static_cast<std::uint64_t>(*count), {}});
  }

  void read_property(std::string_view rest) {
    if (header_.elements.empty()) fail("expected an element before the first property");
    PlyProperty property;
    std::string_view word = take_word(rest);
    if (word == "list") {
      property.is_list = true;
      property.count_type = read_type(take_word(rest));
      if (is_real(property.count_type)) fail("list count: expected an integer type, got a real one");
      word = take_word(rest);
    }
    property.type = read_type(word);
    property.name = take_word(rest);
    if (property.name.empty()) fail("property: expected a name, got nothing");
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType read_type(std::string_view word) const {
    const std::optional<PlyType> type = type_named(word);
    if (!type)
      fail(fmt::format("property type: expected char, uchar, short, ushort, int, uint, float or double, got '{}'", printable(word)));
    return *type;
  }

  void check_counts() const {
    const std::uint64_t left_bytes = content_.size() - at_;
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0) continue;
      std::uint64_t row_bytes = 0;  // the least that a row takes; in ascii a digit and a separator for each property
      for (const PlyProperty& p : element.properties)
        row_bytes += header_.encoding == PlyEncoding::ascii ? 2 : size_bytes(p.is_list ? p.count_type : p.type);
      if (row_bytes == 0) fail(fmt::format("element '{}': expected at least one property", printable(element.name)));
      // + 1: the last separator of an ascii file may be missing.
      if (element.count > (left_bytes + 1) / row_bytes)
        fail(fmt::format("element '{}' claims {} rows: expected at least {} bytes each, got {} bytes in all", printable(element.name),
                         element.count, row_bytes, left_bytes));
    }
  }

  const std::string& file_;
  std::string_view content_;
  std::size_t at_ = 0;
  char line_end_ = '\n';
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

std::size_t size_bytes(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8: return 1;
    case PlyType::int16:
    case PlyType::uint16: return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32: return 4;
    case PlyType::float64: return 8;
  }
  return 0;
}

PlyHeader parse_ply_header(const std::string& file, std::string_view content) { return HeaderParser(file, content).parse(); }

}  // namespace etalon::io
