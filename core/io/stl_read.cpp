// STL [3D Systems, StereoLithography Interface Specification, 1989], ascii and binary. Facets share no vertices there: points of equal
// coordinates (−0 equals 0) are welded into one vertex, in the order of their first appearance.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/base/index_table.h"
#include "core/io/input_error.h"
#include "core/io/mesh_formats.h"
#include "core/io/mesh_room.h"
#include "core/io/text_scan.h"
#include "core/io/triangle_soup.h"

namespace etalon::io {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;
constexpr std::size_t kLongestFacetText = 512, kTextBytes = 1024;  // so much must be free of NUL for a file to be text

/// The vertices so far, found again by their coordinates.
class Welder {
 public:
  explicit Welder(std::vector<Vec3f>& positions) : positions_(positions) {}

  std::uint32_t index_of(const Vec3f& p) {
    const auto bits = [](float x) { return x == 0 ? 0u : std::bit_cast<std::uint32_t>(x); };
    const auto next = static_cast<std::uint32_t>(positions_.size());
    const std::uint32_t found = table_.find_or_add(hash_words<3>({bits(p.x), bits(p.y), bits(p.z)}), next,
                                                   [&](std::uint32_t other) { return positions_[other] == p; });
    if (found == next) positions_.push_back(p);
    return found;
  }

 private:
  std::vector<Vec3f>& positions_;
  IndexTable table_;
};

std::uint32_t count_in(std::string_view text) {
  std::uint32_t count = 0;
  if (text.size() >= kHeaderBytes) std::memcpy(&count, text.data() + kHeaderBytes - sizeof count, sizeof count);
  if constexpr (std::endian::native == std::endian::big) count = __builtin_bswap32(count);
  return count;
}

// A binary file may begin with "solid" too: the size that its count implies decides, then whether it is text at all.
bool is_ascii(std::string_view text) {
  if (text.size() == kHeaderBytes + kFacetBytes * std::uint64_t{count_in(text)}) return false;
  std::string_view rest = text.substr(0, std::min(text.size(), kTextBytes));
  if (rest.find('\0') != std::string_view::npos) return false;
  while (!rest.empty() && (is_blank(rest.front()) || rest.front() == '\n')) rest.remove_prefix(1);
  return rest.size() >= 5 && (rest.starts_with("solid") || rest.starts_with("SOLID"));
}

class AsciiReader {
 public:
  AsciiReader(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  void read(TriangleSoup& soup) {
    Welder welder(soup.positions);
    bool inside = false;
    while (next_line()) {
      const std::string_view word = take_word(line_);
      if (same(word, "solid") && !inside) {
        inside = true;
      } else if (same(word, "facet") && inside) {
        read_facet(soup, welder);
      } else if (same(word, "endsolid") && inside) {
        inside = false;
      } else {
        fail(fmt::format("expected '{}', got '{}'", inside ? "facet' or 'endsolid" : "solid", printable(word)));
      }
    }
    if (inside) fail("expected 'endsolid', got the end of the file");
  }

 private:
  static bool same(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
  }
  [[noreturn]] void fail(const std::string& what) const { fail_at_line(file_, number_, what); }

  /// The next line that is not blank.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (!line_.empty()) return true;
    }
    return false;
  }
  void expect(std::string_view first, std::string_view second) {
    if (!next_line()) fail(fmt::format("expected '{}', got the end of the file", first));
    const std::string_view word = take_word(line_);
    if (!same(word, first)) fail(fmt::format("expected '{}', got '{}'", first, printable(word)));
    if (!second.empty() && !same(take_word(line_), second)) fail(fmt::format("expected '{} {}'", first, second));
  }
  void read_facet(TriangleSoup& soup, Welder& welder) {
    expect("outer", "loop");
    std::array<std::uint32_t, 3> face{};
    for (std::uint32_t& corner : face) {
      expect("vertex", "");
      Vec3f p;
      for (int k = 0; k < 3; ++k) {
        const std::string_view word = take_word(line_);
        const std::optional<float> number = parse_float(word);
        if (!number) fail(fmt::format("vertex: expected 3 finite numbers, got '{}'", printable(word)));
        p[k] = *number;
      }
      if (!trimmed(line_).empty()) fail(fmt::format("vertex: expected 3 numbers, got '{}' behind them", printable(trimmed(line_))));
      corner = welder.index_of(p);
    }
    expect("endloop", "");
    expect("endfacet", "");
    soup.faces.push_back(face);
  }

  std::string file_;
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

/// A closed surface has half as many vertices as triangles (Euler), one with a boundary more.
void require_room(const std::filesystem::path& path, std::uint64_t facets, std::uint64_t file_bytes, std::uint64_t work_bytes_per_face) {
  io::require_room(path, {.vertices = facets / 2, .faces = facets}, file_bytes, work_bytes_per_face);
}

/// How many facets had attribute bytes that are not 0.
std::size_t read_binary(const std::string& file, std::string_view text, TriangleSoup& soup) {
  if (text.size() < kHeaderBytes)
    fail_file(file, fmt::format("STL: expected a header of {} bytes, got {} bytes", kHeaderBytes, text.size()));
  const std::uint64_t count = count_in(text), needed = kHeaderBytes + kFacetBytes * count;
  if (needed > text.size())
    fail_at_byte(file, kHeaderBytes - 4,
                 fmt::format("{} facets: expected {} bytes, got {}: the file ends early", count, needed, text.size()));
  soup.faces.reserve(count);
  Welder welder(soup.positions);
  std::size_t attributes = 0;
  for (std::uint64_t f = 0; f < count; ++f) {
    const std::size_t at = kHeaderBytes + kFacetBytes * f + 12;  // past the normal
    std::array<std::uint32_t, 3> face{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec3f p;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t place = at + 12 * corner + 4 * k;
        std::uint32_t word = 0;
        std::memcpy(&word, text.data() + place, sizeof word);
        if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap32(word);
        const float number = std::bit_cast<float>(word);
        if (!std::isfinite(number)) fail_at_byte(file, place, fmt::format("facet {}: expected finite coordinates, got {}", f, number));
        p[static_cast<int>(k)] = number;
      }
      face[corner] = welder.index_of(p);
    }
    soup.faces.push_back(face);
    attributes += text[at + 36] != 0 || text[at + 37] != 0 ? 1 : 0;
  }
  return attributes;
}

}  // namespace

LoadedModel read_stl(const std::filesystem::path& path, const FileBytes& content, std::uint64_t work_bytes_per_face) {
  const std::string_view text = content.text();
  const std::string name = path.filename().string();
  TriangleSoup soup;
  LoadedModel model;
  const bool is_text = is_ascii(text);
  require_room(path, is_text ? text.size() / kLongestFacetText : std::min<std::uint64_t>(count_in(text), text.size() / kFacetBytes),
               text.size(), work_bytes_per_face);
  if (is_text) {
    AsciiReader(path.string(), text).read(soup);
  } else {
    const std::size_t attributes = read_binary(path.string(), text, soup);
    if (attributes > 0)
      model.notes.push_back(fmt::format("{}: {} facets have attribute bytes (of some programs colours, which STL does not define): skipped",
                                        name, attributes));
    const std::uint64_t behind = text.size() - kHeaderBytes - kFacetBytes * soup.faces.size();
    if (behind > 0) model.notes.push_back(fmt::format("{}: {} bytes behind the last facet skipped", name, behind));
  }
  if (soup.faces.empty()) fail_file(path.string(), "no faces: expected at least one facet, got none");
  model.mesh = to_mesh(std::move(soup));
  return model;
}

}  // namespace etalon::io
