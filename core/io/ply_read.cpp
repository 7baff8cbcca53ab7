// PLY bodies, ascii and both binary byte orders: one reader over two sources of scalars.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/input_error.h"
#include "core/io/mesh_formats.h"
#include "core/io/mesh_room.h"
#include "core/io/ply_header.h"
#include "core/io/ply_source.h"
#include "core/io/range_file.h"
#include "core/io/range_grid.h"
#include "core/io/triangle_soup.h"
#include "core/mesh/weld.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxElements = 0x7FFFFFFF;

enum class VertexRole : std::uint8_t { none, x, y, z, red, green, blue, alpha, u, v };
enum class FaceRole : std::uint8_t { none, indices, texture_coordinates, texture_number };

VertexRole vertex_role(const PlyProperty& p) {
  struct Name {
    std::string_view name;
    VertexRole role;
  };
  static constexpr Name kNames[] = {{"x", VertexRole::x},
                                    {"y", VertexRole::y},
                                    {"z", VertexRole::z},
                                    {"red", VertexRole::red},
                                    {"green", VertexRole::green},
                                    {"blue", VertexRole::blue},
                                    {"alpha", VertexRole::alpha},
                                    {"r", VertexRole::red},
                                    {"g", VertexRole::green},
                                    {"b", VertexRole::blue},
                                    {"a", VertexRole::alpha},
                                    {"diffuse_red", VertexRole::red},
                                    {"diffuse_green", VertexRole::green},
                                    {"diffuse_blue", VertexRole::blue},
                                    {"diffuse_alpha", VertexRole::alpha},
                                    {"s", VertexRole::u},
                                    {"t", VertexRole::v},
                                    {"u", VertexRole::u},
                                    {"v", VertexRole::v},
                                    {"texture_u", VertexRole::u},
                                    {"texture_v", VertexRole::v},
                                    {"texture_s", VertexRole::u},
                                    {"texture_t", VertexRole::v}};
  if (p.is_list) return VertexRole::none;
  for (const Name& n : kNames)
    if (n.name == p.name) return n.role;
  return VertexRole::none;
}

FaceRole face_role(const PlyProperty& p) {
  if (p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index")) return FaceRole::indices;
  if (p.is_list && p.name == "texcoord") return FaceRole::texture_coordinates;
  if (!p.is_list && p.name == "texnumber") return FaceRole::texture_number;
  return FaceRole::none;
}

/// What the header promises, held against the size of the file already.
MeshCounts counts_of(const PlyHeader& header) {
  MeshCounts counts;
  for (const PlyElement& element : header.elements)
    for (const PlyProperty& p : element.properties) {
      if (element.name == "vertex") {
        counts.vertices = element.count;
        counts.has_colors = counts.has_colors || vertex_role(p) == VertexRole::red;
        counts.has_vertex_uvs = counts.has_vertex_uvs || vertex_role(p) == VertexRole::u;
      } else if (element.name == "face") {
        counts.faces = element.count;
        counts.has_corner_uvs = counts.has_corner_uvs || face_role(p) == FaceRole::texture_coordinates;
      }
    }
  return counts;
}

/// The stored integer that means 1; reals are stored as they are.
float color_maximum(PlyType type) {
  switch (type) {
    case PlyType::uint8: return 255;
    case PlyType::uint16: return 65535;
    case PlyType::float32:
    case PlyType::float64: return 1;
    default: return 0;
  }
}

template <class Source>
class BodyReader {
 public:
  BodyReader(const fs::path& path, const PlyHeader& header, std::optional<double> max_jump, Source source)
      : path_(path), header_(header), max_jump_(max_jump), source_(std::move(source)) {
    for (const PlyElement& e : header.elements)
      if (e.name == "vertex") vertex_count_ = e.count;
  }

  LoadedModel read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "tristrips")
        read_strips(element);
      else if (element.name == "range_grid")
        read_grid(element);
      else
        skip_rows(element);
    }
    if (soup_.faces.empty() && !grid_.vertices.empty()) triangulate_grid();
    if (soup_.faces.empty())
      fail_file(path_.string(), "no faces: expected an element 'face', 'tristrips' or 'range_grid' with at least one row, got none");
    drop_unused_face_data();
    // One coordinate per vertex means that the writer had to split the vertices along seams.
    const bool split_at_seams = !soup_.vertex_uvs.empty();
    model_.mesh = to_mesh(std::move(soup_));
    if (split_at_seams) model_.mesh = welded_by_position(model_.mesh);
    return std::move(model_);
  }

 private:
  void check_roles(const PlyElement& element, const std::vector<VertexRole>& roles) {
    const auto has = [&](VertexRole r) { return std::count(roles.begin(), roles.end(), r); };
    for (const VertexRole r : {VertexRole::x, VertexRole::y, VertexRole::z})
      if (has(r) != 1) fail_file(path_.string(), "element 'vertex': expected the properties x, y and z once each");
    has_color_ = has(VertexRole::red) == 1 && has(VertexRole::green) == 1 && has(VertexRole::blue) == 1 && has(VertexRole::alpha) <= 1;
    has_uv_ = has(VertexRole::u) == 1 && has(VertexRole::v) == 1;
    if (!has_color_) return;
    for (std::size_t i = 0; i < roles.size(); ++i)
      if (roles[i] >= VertexRole::red && roles[i] <= VertexRole::alpha && color_maximum(element.properties[i].type) == 0)
        fail_file(path_.string(), fmt::format("vertex colour '{}': expected uchar, ushort, float or double", element.properties[i].name));
  }

  void read_vertices(const PlyElement& element) {
    if (element.count > kMaxElements)
      fail_file(path_.string(), fmt::format("too many vertices: expected less than 2^31, got {}", element.count));
    std::vector<VertexRole> roles;
    for (const PlyProperty& p : element.properties) roles.push_back(vertex_role(p));
    check_roles(element, roles);
    soup_.positions.reserve(element.count);
    if (has_color_) soup_.colors.reserve(element.count);
    if (has_uv_) soup_.vertex_uvs.reserve(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      std::array<float, 10> values{};
      values[static_cast<std::size_t>(VertexRole::alpha)] = 1;
      for (std::size_t i = 0; i < roles.size(); ++i) {
        const PlyProperty& p = element.properties[i];
        const VertexRole role = roles[i];
        if (p.is_list || role == VertexRole::none) {
          skip_property(p);
          continue;
        }
        float value = source_.real(p.type);
        if (!std::isfinite(value))
          source_.fail(fmt::format("vertex {}: '{}': expected a finite number, got {}", row, printable(p.name), value));
        if (role >= VertexRole::red && role <= VertexRole::alpha && has_color_) {
          value /= color_maximum(p.type);
          if (!(value >= 0 && value <= 1))
            source_.fail(fmt::format("vertex {}: '{}': expected a colour from 0 to 1, got {}", row, p.name, value));
        }
        values[static_cast<std::size_t>(role)] = value;
      }
      const auto at = [&](VertexRole r) { return values[static_cast<std::size_t>(r)]; };
      soup_.positions.push_back({at(VertexRole::x), at(VertexRole::y), at(VertexRole::z)});
      if (has_color_) soup_.colors.push_back({at(VertexRole::red), at(VertexRole::green), at(VertexRole::blue), at(VertexRole::alpha)});
      if (has_uv_) soup_.vertex_uvs.push_back({at(VertexRole::u), at(VertexRole::v)});
    }
  }

  void read_faces(const PlyElement& element) {
    std::vector<FaceRole> roles;
    for (const PlyProperty& p : element.properties) roles.push_back(face_role(p));
    if (std::count(roles.begin(), roles.end(), FaceRole::indices) != 1 && element.count != 0)
      fail_file(path_.string(), "element 'face': expected one list 'vertex_indices'");
    soup_.faces.reserve(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      corner_uvs_.clear();
      std::int64_t texture_number = 0;
      for (std::size_t i = 0; i < roles.size(); ++i) {
        const PlyProperty& p = element.properties[i];
        switch (roles[i]) {
          case FaceRole::indices: read_indices(p, row); break;
          case FaceRole::texture_coordinates: read_corner_uvs(p, row); break;
          case FaceRole::texture_number: texture_number = source_.integer(p.type); break;
          case FaceRole::none: skip_property(p); break;
        }
      }
      add_fan(row, texture_number);
    }
  }

  std::uint64_t list_count(const PlyProperty& p) {
    const std::int64_t count = source_.integer(p.count_type);
    if (count < 0 || !source_.can_hold(p.type, static_cast<std::uint64_t>(count)))
      source_.fail(fmt::format("list '{}': expected a count that fits into the rest of the file, got {}", printable(p.name), count));
    return static_cast<std::uint64_t>(count);
  }

  std::uint32_t vertex_index(const PlyProperty& p, std::uint64_t row) {
    const std::int64_t index = source_.integer(p.type);
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
      source_.fail(fmt::format("face {}: vertex index expected 0 to {}, got {}", row, static_cast<std::int64_t>(vertex_count_) - 1, index));
    return static_cast<std::uint32_t>(index);
  }

  void read_indices(const PlyProperty& p, std::uint64_t row) {
    const std::uint64_t count = list_count(p);
    if (count < 3) source_.fail(fmt::format("face {}: expected at least 3 corners, got {}", row, count));
    indices_.clear();
    for (std::uint64_t i = 0; i < count; ++i) indices_.push_back(vertex_index(p, row));
  }

  void read_corner_uvs(const PlyProperty& p, std::uint64_t row) {
    const std::uint64_t count = list_count(p);
    for (std::uint64_t i = 0; i < count; ++i) {
      const float value = source_.real(p.type);
      if (!std::isfinite(value)) source_.fail(fmt::format("face {}: 'texcoord': expected a finite number, got {}", row, value));
      corner_uvs_.push_back(value);
    }
  }

  void add_fan(std::uint64_t row, std::int64_t texture_number) {
    const bool has_corner_uvs = !corner_uvs_.empty();
    if (has_corner_uvs && corner_uvs_.size() != 2 * indices_.size())
      source_.fail(fmt::format("face {}: 'texcoord': expected {} numbers, got {}", row, 2 * indices_.size(), corner_uvs_.size()));
    // MeshLab writes -1 on faces without texture.
    const auto material = static_cast<std::uint32_t>(std::clamp<std::int64_t>(texture_number, -1, 0xFFFF) + 1);
    if (soup_.faces.size() + indices_.size() > kMaxElements) source_.fail("too many faces: expected less than 2^31 triangles");
    const auto uv = [&](std::size_t corner) {
      return has_corner_uvs ? Vec2f(corner_uvs_[2 * corner], corner_uvs_[2 * corner + 1]) : Vec2f(0);
    };
    const bool wants_uvs = has_corner_uvs || !soup_.corner_uvs.empty();
    if (wants_uvs) soup_.corner_uvs.resize(soup_.faces.size());
    for (std::size_t i = 2; i < indices_.size(); ++i) {
      soup_.faces.push_back({indices_[0], indices_[i - 1], indices_[i]});
      if (wants_uvs) soup_.corner_uvs.push_back({uv(0), uv(i - 1), uv(i)});
      if (!header_.texture_names.empty()) texture_numbers_.push_back(material);
    }
    if (!has_corner_uvs) faces_without_uv_ += indices_.size() - 2;
  }

  /// Triangle strips: each row a list in which -1 starts the next strip; every second triangle of a strip turns the other way.
  void read_strips(const PlyElement& element) {
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (const PlyProperty& p : element.properties) {
        if (face_role(p) != FaceRole::indices) {
          skip_property(p);
          continue;
        }
        const std::uint64_t count = list_count(p);
        indices_.clear();
        for (std::uint64_t i = 0; i < count; ++i) {
          const std::int64_t index = source_.integer(p.type);
          if (index == -1) {
            indices_.clear();
            continue;
          }
          if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
            source_.fail(
                fmt::format("strip {}: vertex index expected -1 to {}, got {}", row, static_cast<std::int64_t>(vertex_count_) - 1, index));
          indices_.push_back(static_cast<std::uint32_t>(index));
          const std::size_t n = indices_.size();
          if (n < 3) continue;
          // A repeated index only steers the strip; it is not a triangle of the surface.
          const std::uint32_t a = indices_[n - 3], b = indices_[n - 2], c = indices_[n - 1];
          if (a == b || b == c || a == c) continue;
          soup_.faces.push_back(n % 2 == 1 ? std::array{a, b, c} : std::array{b, a, c});
          ++faces_without_uv_;
        }
      }
  }

  /// Each row a list of no or one vertex.
  void read_grid(const PlyElement& element) {
    if (element.count == 0) return;
    const std::string file = path_.string();
    grid_.columns = header_.grid_columns;
    grid_.rows = header_.grid_rows;
    if (grid_.columns == 0 || grid_.rows == 0)
      fail_file(file, "element 'range_grid': expected lines 'obj_info num_cols N' and 'obj_info num_rows N' in the header, got none");
    // By division: the product of two counts may not fit.
    if (element.count > kMaxRangeSamples || element.count % grid_.columns != 0 || element.count / grid_.columns != grid_.rows)
      fail_file(file, fmt::format("element 'range_grid': expected {} x {} rows, at most {}, got {}", grid_.columns, grid_.rows,
                                  kMaxRangeSamples, element.count));
    const auto is_indices = [](const PlyProperty& p) { return face_role(p) == FaceRole::indices; };
    if (std::count_if(element.properties.begin(), element.properties.end(), is_indices) != 1)
      fail_file(file, "element 'range_grid': expected one list 'vertex_indices'");
    grid_.vertices.reserve(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (const PlyProperty& p : element.properties) {
        if (!is_indices(p)) {
          skip_property(p);
          continue;
        }
        const std::uint64_t count = list_count(p);
        if (count > 1) source_.fail(fmt::format("range_grid {}: expected no or one vertex, got {}", row, count));
        grid_.vertices.push_back(count == 0 ? RangeGrid::kNoSample : grid_vertex(p, row));
      }
  }

  std::uint32_t grid_vertex(const PlyProperty& p, std::uint64_t row) {
    const std::int64_t index = source_.integer(p.type);
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
      source_.fail(
          fmt::format("range_grid {}: vertex index expected 0 to {}, got {}", row, static_cast<std::int64_t>(vertex_count_) - 1, index));
    return static_cast<std::uint32_t>(index);
  }

  void triangulate_grid() {
    if (soup_.positions.size() != vertex_count_) fail_file(path_.string(), "element 'range_grid': expected an element 'vertex'");
    soup_.faces = range_grid_faces(grid_, soup_.positions, max_jump_);
    if (soup_.faces.empty())
      fail_file(path_.string(),
                fmt::format("a range grid of {}x{}: expected neighbours without a jump in depth, got none", grid_.columns, grid_.rows));
    model_.notes.push_back(fmt::format(
        "{}: a range grid of {}x{} samples, {} of them there, as {} triangles", path_.filename().string(), grid_.columns, grid_.rows,
        grid_.vertices.size() - static_cast<std::size_t>(std::count(grid_.vertices.begin(), grid_.vertices.end(), RangeGrid::kNoSample)),
        soup_.faces.size()));
  }

  void skip_property(const PlyProperty& p) {
    if (!p.is_list) return source_.skip(p.type, 1);
    source_.skip(p.type, list_count(p));
  }

  void skip_rows(const PlyElement& element) {
    for (std::uint64_t row = 0; row < element.count; ++row)
      for (const PlyProperty& p : element.properties) skip_property(p);
  }

  /// Settles what the faces carry: coordinates of corners win over those of vertices; textures become materials in order of first use.
  void drop_unused_face_data() {
    const std::string name = path_.filename().string();
    if (!soup_.corner_uvs.empty()) {
      soup_.corner_uvs.resize(soup_.faces.size());
      soup_.vertex_uvs.clear();
      if (faces_without_uv_ != 0)
        model_.notes.push_back(fmt::format("{}: {} of {} triangles have no texture coordinates; they get (0, 0)", name, faces_without_uv_,
                                           soup_.faces.size()));
    }
    if (header_.texture_names.empty()) return;
    texture_numbers_.resize(soup_.faces.size(), 1);
    std::vector<std::uint32_t> material_of_number(0x10001, WedgeId::kInvalid);
    for (const std::uint32_t number : texture_numbers_) {
      std::uint32_t& material = material_of_number[number];
      if (material == WedgeId::kInvalid) {
        material = static_cast<std::uint32_t>(model_.materials.size());
        model_.materials.push_back(material_numbered(number));
      }
      soup_.face_materials.push_back(material);
    }
  }

  /// `number`: 0 for faces without texture, else 1 + the place in the list of TextureFile comments.
  Material material_numbered(std::uint32_t number) {
    Material material;
    if (number == 0) return material;
    material.name = fmt::format("texture_{}", number - 1);
    const std::string model_name = path_.filename().string();
    if (number > header_.texture_names.size()) {
      model_.notes.push_back(fmt::format("{}: texture number {}: expected below {}", model_name, number - 1, header_.texture_names.size()));
      return material;
    }
    const std::string& texture_name = header_.texture_names[number - 1];
    const fs::path texture = find_beside(path_.parent_path(), texture_name);
    if (!texture.empty())
      material.texture_path = texture;
    else
      model_.notes.push_back(fmt::format("{}: texture '{}' not found", model_name, printable(texture_name, 100)));
    return material;
  }

  const fs::path& path_;
  const PlyHeader& header_;
  std::optional<double> max_jump_;
  Source source_;
  LoadedModel model_;
  TriangleSoup soup_;
  std::uint64_t vertex_count_ = 0;
  bool has_color_ = false;
  bool has_uv_ = false;
  std::uint64_t faces_without_uv_ = 0;
  RangeGrid grid_;
  std::vector<std::uint32_t> indices_;
  std::vector<float> corner_uvs_;
  std::vector<std::uint32_t> texture_numbers_;
};

}  // namespace

LoadedModel read_ply(const fs::path& path, const FileBytes& content, std::optional<double> max_jump, std::uint64_t work_bytes_per_face) {
  const std::string file = path.string();
  const PlyHeader header = parse_ply_header(file, content.text());
  require_room(path, counts_of(header), content.bytes().size(), work_bytes_per_face);
  switch (header.encoding) {
    case PlyEncoding::ascii: return BodyReader(path, header, max_jump, AsciiSource(file, content.text(), header)).read();
    case PlyEncoding::little_endian: return BodyReader(path, header, max_jump, BinarySource<false>(file, content.bytes(), header)).read();
    case PlyEncoding::big_endian: return BodyReader(path, header, max_jump, BinarySource<true>(file, content.bytes(), header)).read();
  }
  fail_file(file, "unknown PLY encoding");
}

LoadedModel read_range_ply(const fs::path& path, std::optional<double> max_jump) {
  if (max_jump && !(*max_jump > 0)) fail_file(path.string(), fmt::format("largest jump: expected a length above 0, got {}", *max_jump));
  return read_ply(path, read_file(path), max_jump);
}

}  // namespace etalon::io
