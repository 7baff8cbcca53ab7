// Binary glTF 2.0: one mesh, one primitive per material over shared vertices, textures embedded as PNG or as they are.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "core/io/mesh_formats.h"

namespace etalon::io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class GlbWriter {
 public:
  GlbWriter(const fs::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit)
      : path_(path), mesh_(mesh), materials_(materials), credit_(credit) {}

  std::string bytes() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "etalon"}};
    if (!credit_.empty()) json_["asset"]["copyright"] = credit_;
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array({0})}}});
    json_["nodes"] = Json::array({{{"mesh", 0}}});
    json_["bufferViews"] = Json::array();
    json_["accessors"] = Json::array();
    order_vertices();
    add_attributes();
    add_materials();
    add_primitives();
    return container();
  }

 private:
  /// glTF vertices: every wedge, and the vertices without one, ordered by vertex so that welding restores their order.
  void order_vertices() {
    std::vector<std::vector<std::uint32_t>> wedges_of(mesh_.positions.size());
    for (std::uint32_t w = 0; w < mesh_.wedges.size(); ++w) wedges_of[mesh_.wedges[w].vertex.index].push_back(w);
    place_of_wedge_.resize(mesh_.wedges.size());
    for (std::uint32_t v = 0; v < wedges_of.size(); ++v) {
      if (wedges_of[v].empty()) vertices_.push_back({v, WedgeId::kInvalid});
      for (const std::uint32_t w : wedges_of[v]) {
        place_of_wedge_[w] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back({v, w});
      }
    }
  }

  template <class T>
  void append(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    binary_.append(bytes, sizeof value);
  }

  void begin_view() {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    view_begin_ = binary_.size();
  }
  std::size_t end_view(int target) {
    Json view = {{"buffer", 0}, {"byteOffset", view_begin_}, {"byteLength", binary_.size() - view_begin_}};
    if (target != 0) view["target"] = target;
    json_["bufferViews"].push_back(std::move(view));
    return json_["bufferViews"].size() - 1;
  }
  std::size_t add_accessor(std::size_t view, int component_type, std::size_t count, const char* type) {
    json_["accessors"].push_back({{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
    return json_["accessors"].size() - 1;
  }

  void add_attributes() {
    static constexpr int kVertexTarget = 34962;
    begin_view();
    Vec3f lo = mesh_.positions[vertices_[0].vertex], hi = lo;
    for (const Out& o : vertices_)
      for (int k = 0; k < 3; ++k) {
        const float x = mesh_.positions[o.vertex][k];
        lo[k] = std::min(lo[k], x);
        hi[k] = std::max(hi[k], x);
        append(x);
      }
    const std::size_t position = add_accessor(end_view(kVertexTarget), 5126, vertices_.size(), "VEC3");
    json_["accessors"][position]["min"] = {lo.x, lo.y, lo.z};
    json_["accessors"][position]["max"] = {hi.x, hi.y, hi.z};
    attributes_["POSITION"] = position;
    if (mesh_.has_uv) {
      begin_view();
      for (const Out& o : vertices_) {
        const Vec2f uv = o.wedge == WedgeId::kInvalid ? Vec2f(0, 1) : mesh_.wedges[o.wedge].uv;
        append(uv.x);
        append(1.0f - uv.y);
      }
      attributes_["TEXCOORD_0"] = add_accessor(end_view(kVertexTarget), 5126, vertices_.size(), "VEC2");
    }
    if (mesh_.colors.empty()) return;
    begin_view();
    const bool bytes = colors_are_bytes(mesh_);
    for (const Out& o : vertices_)
      for (int k = 0; k < 4; ++k) {
        if (bytes)
          append(color_byte(mesh_.colors[o.vertex][k]));
        else
          append(mesh_.colors[o.vertex][k]);
      }
    const std::size_t color = add_accessor(end_view(kVertexTarget), bytes ? 5121 : 5126, vertices_.size(), "VEC4");
    if (bytes) json_["accessors"][color]["normalized"] = true;
    attributes_["COLOR_0"] = color;
  }

  void add_materials() {
    for (const Material& m : materials_) {
      Json material = {{"name", m.name}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}}};
      std::string image;
      if (!m.texture.empty())
        image = encode_png(m.texture, path_.string());
      else if (m.texture_path)
        image = read_file(*m.texture_path).text();
      if (!image.empty()) {
        begin_view();
        binary_ += image;
        json_["images"].push_back({{"bufferView", end_view(0)}, {"mimeType", mime_type(image, m)}});
        json_["textures"].push_back({{"source", json_["images"].size() - 1}});
        if (m.lookup != TextureLookup::any) json_["textures"].back()["sampler"] = sampler_of(m.lookup);
        material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", json_["textures"].size() - 1}};
      }
      json_["materials"].push_back(std::move(material));
    }
  }

  // NEAREST, LINEAR, LINEAR_MIPMAP_LINEAR; CLAMP_TO_EDGE. Equal ones once.
  std::size_t sampler_of(TextureLookup lookup) {
    const int magnified = lookup == TextureLookup::nearest ? 9728 : 9729;
    const int minified = lookup == TextureLookup::mipmap ? 9987 : magnified;
    Json sampler{{"magFilter", magnified}, {"minFilter", minified}, {"wrapS", 33071}, {"wrapT", 33071}};
    Json& samplers = json_["samplers"];
    for (std::size_t n = 0; n < samplers.size(); ++n)
      if (samplers[n] == sampler) return n;
    samplers.push_back(std::move(sampler));
    return samplers.size() - 1;
  }

  const char* mime_type(const std::string& image, const Material& m) const {
    if (image.starts_with("\x89PNG")) return "image/png";
    if (image.starts_with("\xff\xd8\xff")) return "image/jpeg";
    throw WriteError(fmt::format("{}: cannot write: the texture '{}': GLB holds PNG or JPEG", path_.string(), m.texture_path->string()));
  }

  void add_primitives() {
    const std::size_t material_count = std::max<std::size_t>(materials_.size(), 1);
    std::vector<std::vector<std::uint32_t>> faces_of(material_count);
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f)
      faces_of[materials_.empty() || mesh_.face_materials.empty() ? 0 : mesh_.face_materials[f]].push_back(f);
    Json primitives = Json::array();
    for (std::size_t m = 0; m < material_count; ++m) {
      if (faces_of[m].empty()) continue;
      begin_view();
      for (const std::uint32_t f : faces_of[m])
        for (const WedgeId w : mesh_.faces[f]) append(place_of_wedge_[w.index]);
      Json primitive = {{"attributes", attributes_}, {"indices", add_accessor(end_view(34963), 5125, faces_of[m].size() * 3, "SCALAR")}};
      if (!materials_.empty()) primitive["material"] = m;
      primitives.push_back(std::move(primitive));
    }
    json_["meshes"] = Json::array({{{"primitives", std::move(primitives)}}});
  }

  std::string container() {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    // Names that are not UTF-8 get replacement characters rather than failing the whole file.
    std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + binary_.size();
    if (total > 0xFFFFFFFFu)
      throw WriteError(fmt::format("{}: cannot write: GLB holds at most 4 GiB, got {} bytes", path_.string(), total));
    std::string binary = std::move(binary_);
    binary_.clear();
    binary_.reserve(total);
    binary_ += "glTF";
    for (const std::size_t word : {std::size_t{2}, total, text.size(), std::size_t{0x4E4F534A}}) append(static_cast<std::uint32_t>(word));
    binary_ += text;
    append(static_cast<std::uint32_t>(binary.size()));
    append(std::uint32_t{0x004E4942});
    binary_ += binary;
    return std::move(binary_);
  }

  struct Out {
    std::uint32_t vertex;
    std::uint32_t wedge;
  };
  const fs::path& path_;
  const Mesh& mesh_;
  const std::vector<Material>& materials_;
  const std::string& credit_;
  Json json_;
  Json attributes_;
  std::string binary_;
  std::size_t view_begin_ = 0;
  std::vector<Out> vertices_;
  std::vector<std::uint32_t> place_of_wedge_;
};

}  // namespace

void write_glb(const fs::path& path, const Mesh& mesh, const std::vector<Material>& materials, const std::string& credit) {
  write_file(path, GlbWriter(path, mesh, materials, credit).bytes());
}

}  // namespace etalon::io
