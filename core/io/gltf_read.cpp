// glTF 2.0 scenes as one mesh: node transforms applied, primitives joined, seams welded.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/io/gltf_document.h"
#include "core/io/gltf_transform.h"
#include "core/io/image_file.h"
#include "core/io/input_error.h"
#include "core/io/mesh_formats.h"
#include "core/io/mesh_room.h"
#include "core/io/triangle_soup.h"
#include "core/mesh/weld.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;

/// Instances let a small file name many triangles: this many vertices or triangles are the most that are built.
constexpr std::size_t kMaxElements = std::size_t{1} << 27;

class GltfReader {
 public:
  GltfReader(const fs::path& path, const FileBytes& content, std::uint64_t work_bytes_per_face)
      : name_(path.filename().string()),
        document_(path, content),
        file_bytes_(content.bytes().size()),
        work_bytes_per_face_(work_bytes_per_face) {}

  LoadedModel read() {
    check_extensions();
    if (const JsonRef asset = document_.root().at("asset"); asset.has("copyright") && asset.at("copyright").is_text())
      model_.credit = one_line(asset.at("copyright").text());
    walk_scene();
    if (soup_.faces.empty())
      fail_file(document_.file(), "no faces: expected at least one mesh with triangles in the default scene, got none");
    fill_gaps();
    model_.mesh = welded_by_position(to_mesh(std::move(soup_)));
    model_.side_files = document_.buffer_files();
    return std::move(model_);
  }

 private:
  void note(const std::string& text) {
    const std::string line = fmt::format("{}: {}", name_, text);
    if (std::find(model_.notes.begin(), model_.notes.end(), line) == model_.notes.end()) model_.notes.push_back(line);
  }

  void check_extensions() {
    const JsonRef root = document_.root();
    if (!root.has("extensionsRequired")) return;
    const JsonRef required = root.at("extensionsRequired");
    for (std::size_t i = 0; i < required.size(); ++i) {
      const std::string extension = required.at(i).text();
      if (extension != "KHR_mesh_quantization" && !extension.starts_with("KHR_materials_") && !extension.starts_with("KHR_lights_"))
        required.fail(fmt::format("the required extension '{}' is not supported", printable(extension)));
    }
  }

  /// Depth-first in file order, without recursion: a chain of nodes may be long.
  void walk_scene() {
    const JsonRef root = document_.root();
    if (!root.has("nodes")) return;
    const JsonRef nodes = root.at("nodes");
    struct Visit {
      std::uint64_t node;
      NodeTransform parent;
    };
    std::vector<Visit> stack;
    if (root.has("scenes")) {
      const JsonRef scene = root.at("scenes").at(root.integer_or("scene", 0));
      if (scene.has("nodes"))
        for (std::size_t i = scene.at("nodes").size(); i-- > 0;) stack.push_back({scene.at("nodes").at(i).integer(), {}});
    } else {
      for (const std::uint64_t i : parentless(nodes)) stack.push_back({i, {}});
    }
    std::vector<bool> seen(nodes.size(), false);
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const JsonRef node = nodes.at(visit.node);
      if (seen[static_cast<std::size_t>(visit.node)]) node.fail("expected at most one parent, got a second one (or a cycle)");
      seen[static_cast<std::size_t>(visit.node)] = true;
      const NodeTransform world = visit.parent.after(local_transform(node));
      if (node.has("skin")) note("skins are not applied");
      if (node.has("mesh")) add_mesh(document_.root().at("meshes").at(node.at("mesh").integer()), world);
      if (!node.has("children")) continue;
      const JsonRef children = node.at("children");
      for (std::size_t i = children.size(); i-- > 0;) stack.push_back({children.at(i).integer(), world});
    }
  }

  /// Nodes that are nobody's child, last first (they go on a stack).
  static std::vector<std::uint64_t> parentless(const JsonRef& nodes) {
    std::vector<bool> is_child(nodes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!nodes.at(i).has("children")) continue;
      const JsonRef children = nodes.at(i).at("children");
      for (std::size_t k = 0; k < children.size(); ++k) {
        const std::uint64_t child = children.at(k).integer();
        if (child >= nodes.size()) children.fail(fmt::format("node expected below {}, got {}", nodes.size(), child));
        is_child[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<std::uint64_t> result;
    for (std::size_t i = nodes.size(); i-- > 0;)
      if (!is_child[i]) result.push_back(i);
    return result;
  }

  void add_mesh(const JsonRef& mesh, const NodeTransform& world) {
    const JsonRef primitives = mesh.at("primitives");
    // Primitives of one mesh often share their vertices and differ in indices only.
    std::map<std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>, std::uint32_t> first_vertex_of;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const JsonRef primitive = primitives.at(i);
      const std::uint64_t mode = primitive.integer_or("mode", 4);
      if (mode < 4) {
        note(fmt::format("{}: points and lines are skipped", primitive.path()));
        continue;
      }
      if (mode > 6) primitive.fail(fmt::format("mode: expected 0 to 6, got {}", mode));
      if (primitive.has("targets")) note("morph targets are not applied");
      const JsonRef attributes = primitive.at("attributes");
      const std::uint32_t material = material_of(primitive);
      const std::string uv_name = fmt::format("TEXCOORD_{}", material == kNoMaterial ? 0 : texture_coordinate_sets_[material]);
      const std::uint64_t position = attributes.at("POSITION").integer();
      const auto key =
          std::tuple(position, attributes.integer_or(uv_name.c_str(), kNoAccessor), attributes.integer_or("COLOR_0", kNoAccessor));
      const std::size_t vertex_count = document_.accessor(position).count;
      const auto [known, is_new] = first_vertex_of.try_emplace(key, static_cast<std::uint32_t>(soup_.positions.size()));
      // One vertex for each index where the primitive has none.
      const std::size_t index_count = primitive.has("indices") ? document_.accessor(primitive.at("indices").integer()).count : vertex_count;
      require_room(is_new ? vertex_count : 0, mode == 4 ? index_count / 3 : 0);
      if (is_new) add_vertices(std::get<0>(key), std::get<1>(key), std::get<2>(key), world);
      add_triangles(primitive, mode, known->second, vertex_count, world.mirrors(), material);
    }
  }

  /// For what has been read and a primitive more; strips may repeat indices, so their triangles do not count.
  void require_room(std::size_t vertices, std::size_t faces) const {
    const std::uint64_t held_bytes = soup_.positions.size() * sizeof(Vec3f) + soup_.faces.size() * sizeof(soup_.faces[0]);
    io::require_room(document_.file(), {.vertices = soup_.positions.size() + vertices, .faces = soup_.faces.size() + faces}, file_bytes_,
                     work_bytes_per_face_, held_bytes);
  }

  GltfAccessor vector_accessor(std::uint64_t index, int fewest, int most, std::size_t count) {
    GltfAccessor accessor = document_.accessor(index);
    if (accessor.component_count < fewest || accessor.component_count > most)
      fail_file(document_.file(),
                fmt::format("{}: expected {} to {} components, got {}", accessor.path, fewest, most, accessor.component_count));
    if (accessor.count != count)
      fail_file(document_.file(),
                fmt::format("{}: expected {} elements, one for each vertex, got {}", accessor.path, count, accessor.count));
    return accessor;
  }

  float finite(const GltfAccessor& accessor, std::size_t i, int c) {
    const float value = accessor.real(i, c);
    if (!std::isfinite(value))
      fail_file(document_.file(), fmt::format("{}: element {}: expected a finite number, got {}", accessor.path, i, value));
    return value;
  }

  void add_vertices(std::uint64_t position, std::uint64_t uv, std::uint64_t color, const NodeTransform& world) {
    const std::size_t count = document_.accessor(position).count;
    if (soup_.positions.size() + count > kMaxElements)
      fail_file(document_.file(), fmt::format("expected at most {} vertices, got more", kMaxElements));
    const GltfAccessor positions = vector_accessor(position, 3, 3, count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f p = world.point({finite(positions, i, 0), finite(positions, i, 1), finite(positions, i, 2)});
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        fail_file(document_.file(),
                  fmt::format("{}: element {}: expected a finite position after its node's transform", positions.path, i));
      soup_.positions.push_back(p);
    }
    if (uv != kNoAccessor) {
      const GltfAccessor uvs = vector_accessor(uv, 2, 2, count);
      soup_.vertex_uvs.resize(soup_.positions.size() - count);
      for (std::size_t i = 0; i < count; ++i) soup_.vertex_uvs.push_back({finite(uvs, i, 0), 1.0f - finite(uvs, i, 1)});
    }
    if (color == kNoAccessor) return;
    const GltfAccessor colors = vector_accessor(color, 3, 4, count);
    soup_.colors.resize(soup_.positions.size() - count, Vec4f(1));
    for (std::size_t i = 0; i < count; ++i) {
      Vec4f c(1);
      for (int k = 0; k < colors.component_count; ++k) {
        c[k] = finite(colors, i, k);
        if (!(c[k] >= 0 && c[k] <= 1))
          fail_file(document_.file(), fmt::format("{}: element {}: expected a colour from 0 to 1, got {}", colors.path, i, c[k]));
      }
      soup_.colors.push_back(c);
    }
  }

  void add_triangles(const JsonRef& primitive, std::uint64_t mode, std::uint32_t first_vertex, std::size_t vertex_count, bool mirrored,
                     std::uint32_t material) {
    std::vector<std::uint32_t> indices;
    if (primitive.has("indices")) {
      const GltfAccessor accessor = document_.accessor(primitive.at("indices").integer());
      if (accessor.component_count != 1 ||
          (accessor.component_type != 5121 && accessor.component_type != 5123 && accessor.component_type != 5125))
        fail_file(document_.file(), fmt::format("{}: indices: expected unsigned scalars", accessor.path));
      if (accessor.count > kMaxElements)
        fail_file(document_.file(), fmt::format("{}: expected at most {} indices, got {}", accessor.path, kMaxElements, accessor.count));
      for (std::size_t i = 0; i < accessor.count; ++i) {
        const std::uint32_t index = accessor.index(i);
        if (index >= vertex_count)
          fail_file(document_.file(),
                    fmt::format("{}: element {}: vertex index expected below {}, got {}", accessor.path, i, vertex_count, index));
        indices.push_back(index);
      }
    } else {
      for (std::uint32_t i = 0; i < vertex_count; ++i) indices.push_back(i);
    }
    if (mode == 4 && indices.size() % 3 != 0) primitive.fail(fmt::format("expected a multiple of 3 indices, got {}", indices.size()));
    const std::size_t step = mode == 4 ? 3 : 1;
    const bool has_uv = primitive.at("attributes").has(uv_name_of(material).c_str());
    for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
      // Triangle i of a strip is (i, i+1, i+2), odd ones turned; of a fan (i+1, i+2, 0) (glTF 2.0, 3.7.2.1).
      std::array<std::uint32_t, 3> t = {indices[i], indices[i + 1], indices[i + 2]};
      if (mode == 5 && i % 2 == 1) std::swap(t[1], t[2]);
      if (mode == 6) t = {indices[i + 1], indices[i + 2], indices[0]};
      // Strips turn corners by repeating an index: no triangle of the surface.
      if (mode != 4 && (t[0] == t[1] || t[1] == t[2] || t[0] == t[2])) continue;
      if (mirrored) std::swap(t[1], t[2]);
      if (soup_.faces.size() == kMaxElements)
        fail_file(document_.file(), fmt::format("expected at most {} triangles, got more", kMaxElements));
      soup_.faces.push_back({first_vertex + t[0], first_vertex + t[1], first_vertex + t[2]});
      raw_materials_.push_back(material);
      (has_uv ? faces_with_uv_ : faces_without_uv_) += 1;
    }
  }

  std::string uv_name_of(std::uint32_t material) const {
    return fmt::format("TEXCOORD_{}", material == kNoMaterial ? 0 : texture_coordinate_sets_[material]);
  }

  /// The primitive's place in the list of the materials met so far.
  std::uint32_t material_of(const JsonRef& primitive) {
    if (!primitive.has("material")) return kNoMaterial;
    const std::uint64_t index = primitive.at("material").integer();
    const auto [known, is_new] = material_numbers_.try_emplace(index, static_cast<std::uint32_t>(met_materials_.size()));
    if (is_new) read_material(document_.root().at("materials").at(index));
    return known->second;
  }

  void read_material(const JsonRef& ref) {
    Material material;
    material.name = ref.text_or("name", "");
    std::uint64_t set = 0;
    if (ref.has("pbrMetallicRoughness") && ref.at("pbrMetallicRoughness").has("baseColorTexture")) {
      const JsonRef texture = ref.at("pbrMetallicRoughness").at("baseColorTexture");
      set = texture.integer_or("texCoord", 0);
      if (texture.has("extensions") && texture.at("extensions").has("KHR_texture_transform")) note("KHR_texture_transform is not applied");
      const JsonRef gltf_texture = document_.root().at("textures").at(texture.at("index").integer());
      if (gltf_texture.has("source"))
        read_texture(document_.root().at("images").at(gltf_texture.at("source").integer()), material);
      else
        note(fmt::format("{}: a texture without PNG or JPEG source is skipped", gltf_texture.path()));
    }
    met_materials_.push_back(std::move(material));
    texture_coordinate_sets_.push_back(set);
  }

  void read_texture(const JsonRef& image, Material& material) {
    const std::string name = fmt::format("{}: {}", document_.file(), image.path());
    if (image.has("bufferView")) {
      material.texture = decode_image(document_.buffer_view(image.at("bufferView").integer()), name);
      return;
    }
    const std::string uri = image.at("uri").text();
    if (const std::optional<FileBytes> bytes = decode_data_uri(image.at("uri"), uri)) {
      material.texture = decode_image(bytes->bytes(), name);
      return;
    }
    const fs::path file = find_beside(document_.folder(), percent_decoded(uri));
    if (!file.empty())
      material.texture_path = file;
    else
      note(fmt::format("texture '{}' not found", printable(uri, 100)));
  }

  /// Vertices and faces of parts that lack what others have.
  void fill_gaps() {
    if (!soup_.vertex_uvs.empty()) soup_.vertex_uvs.resize(soup_.positions.size());
    if (!soup_.colors.empty()) soup_.colors.resize(soup_.positions.size(), Vec4f(1));
    if (faces_with_uv_ == 0) soup_.vertex_uvs.clear();
    if (faces_with_uv_ != 0 && faces_without_uv_ != 0)
      note(fmt::format("{} of {} triangles have no texture coordinates; they get (0, 0)", faces_without_uv_, soup_.faces.size()));
    if (met_materials_.empty()) return;
    // Materials in order of first use by a face; parts without one share a nameless one.
    std::map<std::uint32_t, std::uint32_t> place;
    for (const std::uint32_t raw : raw_materials_) {
      const auto [known, is_new] = place.try_emplace(raw, static_cast<std::uint32_t>(model_.materials.size()));
      if (is_new) model_.materials.push_back(raw == kNoMaterial ? Material{} : std::move(met_materials_[raw]));
      soup_.face_materials.push_back(known->second);
    }
  }

  static constexpr std::uint32_t kNoMaterial = 0xFFFFFFFFu;
  static constexpr std::uint64_t kNoAccessor = ~std::uint64_t{0};

  std::string name_;
  GltfDocument document_;
  std::uint64_t file_bytes_, work_bytes_per_face_;
  LoadedModel model_;
  TriangleSoup soup_;
  std::vector<std::uint32_t> raw_materials_;  // one for each face: place in met_materials_
  std::map<std::uint64_t, std::uint32_t> material_numbers_;
  std::vector<Material> met_materials_;
  std::vector<std::uint64_t> texture_coordinate_sets_;  // one for each of met_materials_: n of TEXCOORD_n
  std::size_t faces_with_uv_ = 0;
  std::size_t faces_without_uv_ = 0;
};

}  // namespace

LoadedModel read_gltf(const fs::path& path, const FileBytes& content, std::uint64_t work_bytes_per_face) {
  return GltfReader(path, content, work_bytes_per_face).read();
}

}  // namespace etalon::io
