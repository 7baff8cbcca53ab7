// Wavefront OBJ [Wavefront Advanced Visualizer manual, appendix B1]: v (with colours), vt, f, mtllib, usemtl; the rest does not concern us.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string_view>

#include "core/base/memory_limit.h"
#include "core/io/input_error.h"
#include "core/io/mesh_formats.h"
#include "core/io/mesh_room.h"
#include "core/io/text_scan.h"
#include "core/io/triangle_soup.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kNone = -1;
constexpr std::size_t kMaxElements = 0x7FFFFFFF;

/// Statements that have a meaning in OBJ but none here; anything else is worth a note.
constexpr std::array<std::string_view, 33> kSkipped = {
    "vn",    "vp",       "g",        "o",    "s",          "mg",        "l",     "p",     "cstype", "deg",    "bmat",
    "step",  "curv",     "curv2",    "surf", "parm",       "trim",      "hole",  "scrv",  "sp",     "end",    "con",
    "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj", "ctech", "stech", "maplib", "usemap", "call"};

/// Splits text into lines; a '\' at the end of a line joins the next one to it.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  /// The next line without its end; false at the end of the text.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    number_ = next_number_;
    line = cut();
    if (!continues(line)) return true;
    joined_.clear();
    while (continues(line)) {
      const std::string_view head = trimmed(line);
      joined_.append(head.substr(0, head.size() - 1)).push_back(' ');
      if (rest_.empty()) {
        line = {};
        break;
      }
      line = cut();
    }
    joined_.append(line);
    line = joined_;
    return true;
  }
  [[nodiscard]] std::size_t number() const { return number_; }

 private:
  std::string_view cut() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++next_number_;
    return line;
  }
  static bool continues(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return !line.empty() && line.back() == '\\';
  }
  std::string_view rest_;
  std::string joined_;
  std::size_t number_ = 0;
  std::size_t next_number_ = 1;
};

class ObjReader {
 public:
  ObjReader(const fs::path& path, std::string_view text) : path_(path), file_(path.string()), lines_(text) {}

  LoadedModel read() {
    std::string_view line;
    while (lines_.next(line)) read_line(line);
    check_references();
    if (soup_.faces.empty()) fail_file(file_, "no faces: expected at least one statement 'f', got none");
    move_uvs_to_corners();
    read_libraries();
    if (!model_.materials.empty()) soup_.face_materials = std::move(materials_of_faces_);
    model_.mesh = to_mesh(std::move(soup_));
    return std::move(model_);
  }

 private:
  struct Corner {
    std::int64_t vertex = kNone;
    std::int64_t uv = kNone;
  };
  /// The largest index that any face names, and where: forward references are legal, so it is judged at the end.
  struct Reference {
    std::int64_t largest = kNone;
    std::size_t line = 0;
    void see(std::int64_t index, std::size_t at_line) {
      if (index > largest) *this = {index, at_line};
    }
  };

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(file_, lines_.number(), what); }
  void note(const std::string& text) { model_.notes.push_back(fmt::format("{}:{}: {}", path_.filename().string(), lines_.number(), text)); }

  void read_line(std::string_view rest) {
    const std::string_view keyword = take_word(rest);
    if (keyword.empty() || keyword[0] == '#') return;
    if (keyword == "v") return read_vertex(rest);
    if (keyword == "vt") return read_uv(rest);
    if (keyword == "f" || keyword == "fo") return read_face(rest);
    if (keyword == "usemtl") return use_material(trimmed(rest));
    if (keyword == "mtllib") return libraries_.push_back({std::string(trimmed(rest)), lines_.number()});
    if (unknown_noted_ || std::find(kSkipped.begin(), kSkipped.end(), keyword) != kSkipped.end()) return;
    unknown_noted_ = true;
    note(fmt::format("statement '{}' skipped, it is unknown", printable(keyword)));
  }

  /// The numbers of a statement, up to `most`.
  std::size_t read_numbers(std::string_view rest, const char* what, std::array<float, 8>& numbers, std::size_t most) {
    std::size_t count = 0;
    while (true) {
      const std::string_view word = take_word(rest);
      if (word.empty() || word[0] == '#') return count;
      const std::optional<float> number = parse_float(word);
      if (!number) fail(fmt::format("{}: expected a finite number, got '{}'", what, printable(word)));
      if (count == most) fail(fmt::format("{}: expected at most {} numbers, got more", what, most));
      numbers[count++] = *number;
    }
  }

  void read_vertex(std::string_view rest) {
    std::array<float, 8> n;
    const std::size_t count = read_numbers(rest, "vertex", n, 7);
    if (count != 3 && count != 4 && count != 6 && count != 7)
      fail(fmt::format("vertex: expected 'x y z', 'x y z w', 'x y z r g b' or 'x y z r g b a', got {} numbers", count));
    if (soup_.positions.size() == kMaxElements) fail("too many vertices: expected less than 2^31");
    soup_.positions.push_back({n[0], n[1], n[2]});
    if (count < 6) {
      if (!soup_.colors.empty()) soup_.colors.push_back(Vec4f(1));
      return;
    }
    for (std::size_t i = 3; i < count; ++i)
      if (!(n[i] >= 0 && n[i] <= 1)) fail(fmt::format("vertex colour: expected 0 to 1, got {}", n[i]));
    if (soup_.colors.empty()) soup_.colors.resize(soup_.positions.size() - 1, Vec4f(1));
    soup_.colors.push_back({n[3], n[4], n[5], count == 7 ? n[6] : 1.0f});
  }

  void read_uv(std::string_view rest) {
    std::array<float, 8> n;
    const std::size_t count = read_numbers(rest, "texture coordinate", n, 3);
    if (count == 0) fail("texture coordinate: expected 'u v', got nothing");
    if (uvs_.size() == kMaxElements) fail("too many texture coordinates: expected less than 2^31");
    uvs_.push_back({n[0], count > 1 ? n[1] : 0.0f});
  }

  /// One index of a corner: 1-based, or negative from the end of the list so far; `text` loses it.
  std::int64_t read_index(std::string_view& text, std::size_t count_so_far, const char* what, std::string_view word) {
    std::int64_t index = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc{} || index == 0)
      fail(fmt::format("face: expected a {} index from 1 or negative, got '{}'", what, printable(word)));
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    if (index > 0) return index - 1;
    const auto count = static_cast<std::int64_t>(count_so_far);
    if (index < -count) fail(fmt::format("face: {} index expected -{} to -1 here, got {}", what, count, index));
    return count + index;
  }

  Corner read_corner(std::string_view word) {
    std::string_view text = word;
    Corner corner;
    corner.vertex = read_index(text, soup_.positions.size(), "vertex", word);
    if (text.empty()) return corner;
    if (text[0] != '/') fail(fmt::format("face: expected v, v/vt, v//vn or v/vt/vn, got '{}'", printable(word)));
    text.remove_prefix(1);
    if (!text.empty() && text[0] != '/') corner.uv = read_index(text, uvs_.size(), "texture coordinate", word);
    // The normal is not used, but what stands there must be an index.
    if (!text.empty()) {
      if (text[0] != '/' || (text.size() > 1 && !parse_integer(text.substr(1))))
        fail(fmt::format("face: expected v, v/vt, v//vn or v/vt/vn, got '{}'", printable(word)));
    }
    return corner;
  }

  void read_face(std::string_view rest) {
    corners_.clear();
    while (true) {
      const std::string_view word = take_word(rest);
      if (word.empty() || word[0] == '#') break;
      corners_.push_back(read_corner(word));
      vertices_seen_.see(corners_.back().vertex, lines_.number());
      uvs_seen_.see(corners_.back().uv, lines_.number());
    }
    if (corners_.size() < 3) fail(fmt::format("face: expected at least 3 corners, got {}", corners_.size()));
    const bool has_uv = std::all_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.uv != kNone; });
    const std::uint32_t material = material_index();
    for (std::size_t i = 2; i < corners_.size(); ++i) {
      if (soup_.faces.size() == kMaxElements) fail("too many faces: expected less than 2^31 triangles");
      const Corner* fan[3] = {&corners_[0], &corners_[i - 1], &corners_[i]};
      std::array<std::uint32_t, 3> vertices;
      std::array<std::uint32_t, 3> uvs;
      for (int k = 0; k < 3; ++k) {
        // An index beyond 2^31 wraps here; check_references() then refuses the file before anything is looked up.
        vertices[k] = static_cast<std::uint32_t>(fan[k]->vertex);
        uvs[k] = has_uv ? static_cast<std::uint32_t>(fan[k]->uv) : WedgeId::kInvalid;
      }
      soup_.faces.push_back(vertices);
      uvs_of_faces_.push_back(uvs);
      materials_of_faces_.push_back(material);
    }
  }

  /// The current material's place in the model; a material enters with its first face.
  std::uint32_t material_index() {
    if (current_index_ >= 0) return static_cast<std::uint32_t>(current_index_);
    const auto found =
        std::find_if(model_.materials.begin(), model_.materials.end(), [&](const Material& m) { return m.name == current_material_; });
    current_index_ = found - model_.materials.begin();
    if (found == model_.materials.end() && (any_usemtl_ || !model_.materials.empty()))
      model_.materials.push_back({current_material_, {}, {}});
    // Faces before the first 'usemtl' wait for it: they get a nameless material only if there is one.
    if (!any_usemtl_) nameless_faces_ = true;
    return static_cast<std::uint32_t>(current_index_);
  }

  void use_material(std::string_view name) {
    if (!any_usemtl_ && nameless_faces_) model_.materials.push_back({});
    any_usemtl_ = true;
    current_material_ = name;
    current_index_ = -1;
  }

  void check_references() const {
    const auto check = [&](const Reference& seen, std::size_t count, const char* what) {
      if (seen.largest >= static_cast<std::int64_t>(count))
        fail_at_line(file_, seen.line, fmt::format("face: {} index expected 1 to {}, got {}", what, count, seen.largest + 1));
    };
    check(vertices_seen_, soup_.positions.size(), "vertex");
    check(uvs_seen_, uvs_.size(), "texture coordinate");
  }

  void move_uvs_to_corners() {
    std::size_t bare_count = 0;
    for (const auto& f : uvs_of_faces_) bare_count += f[0] == WedgeId::kInvalid;
    if (bare_count == soup_.faces.size()) return;
    soup_.corner_uvs.reserve(soup_.faces.size());
    for (const auto& f : uvs_of_faces_) {
      if (f[0] == WedgeId::kInvalid)
        soup_.corner_uvs.push_back({Vec2f(0), Vec2f(0), Vec2f(0)});
      else
        soup_.corner_uvs.push_back({uvs_[f[0]], uvs_[f[1]], uvs_[f[2]]});
    }
    if (bare_count != 0)
      model_.notes.push_back(fmt::format("{}: {} of {} triangles have no texture coordinates; they get (0, 0)", path_.filename().string(),
                                         bare_count, soup_.faces.size()));
  }

  void read_libraries() {
    std::map<std::string, fs::path> textures;
    const fs::path folder = path_.parent_path();
    const auto read_library = [&](const fs::path& library) {
      model_.side_files.push_back(library);
      for (auto& [name, texture] : read_mtl(library)) textures.try_emplace(name, texture);
    };
    for (const auto& [names, line] : libraries_) {
      // One statement may name several files, and a file name may hold spaces: the whole first, then word by word.
      if (const fs::path whole = find_beside(folder, names); !whole.empty()) {
        read_library(whole);
        continue;
      }
      std::string_view rest = names;
      for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
        if (const fs::path library = find_beside(folder, word); !library.empty())
          read_library(library);
        else
          model_.notes.push_back(
              fmt::format("{}:{}: material library '{}' not found", path_.filename().string(), line, printable(word, 100)));
      }
    }
    for (Material& material : model_.materials) {
      const auto found = textures.find(material.name);
      if (found == textures.end() || found->second.empty()) continue;
      const fs::path texture = find_beside(folder, found->second.string());
      if (!texture.empty())
        material.texture_path = texture;
      else
        model_.notes.push_back(fmt::format("{}: texture '{}' of material '{}' not found", path_.filename().string(),
                                           printable(found->second.string(), 100), printable(material.name)));
    }
  }

  fs::path path_;
  std::string file_;
  Lines lines_;
  LoadedModel model_;
  TriangleSoup soup_;
  std::vector<Vec2f> uvs_;
  std::vector<std::array<std::uint32_t, 3>> uvs_of_faces_;
  std::vector<std::uint32_t> materials_of_faces_;
  std::vector<Corner> corners_;
  std::vector<std::pair<std::string, std::size_t>> libraries_;
  std::string current_material_;
  std::ptrdiff_t current_index_ = -1;
  bool any_usemtl_ = false;
  bool nameless_faces_ = false;
  bool unknown_noted_ = false;
  Reference vertices_seen_;
  Reference uvs_seen_;
};

/// Statements 'v' and 'f' at the beginnings of lines; a polygon counts as one triangle, which is the least that it is.
MeshCounts count_statements(std::string_view text) {
  MeshCounts counts;
  for (std::size_t at = 0; at + 1 < text.size();) {
    if (text[at + 1] == ' ') {
      counts.vertices += text[at] == 'v' ? 1 : 0;
      counts.faces += text[at] == 'f' ? 1 : 0;
    }
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) break;
    at = end + 1;
  }
  return counts;
}

}  // namespace

LoadedModel read_obj(const fs::path& path, const FileBytes& content, std::uint64_t work_bytes_per_face) {
  // A file without counts has to be looked through, which only pays where it could be refused.
  if (memory_limit()) require_room(path, count_statements(content.text()), content.text().size(), work_bytes_per_face);
  return ObjReader(path, content.text()).read();
}

}  // namespace etalon::io
