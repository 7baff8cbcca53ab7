#include "tests/streams/decoded_stream.h"

#include <bit>
#include <cstring>

#include "core/adapt/cell_chunks.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/io/draws_file.h"
#include "core/io/image_file.h"
#include "core/joint/joint_stream.h"
#include "core/progressive/epm_format.h"

namespace etalon::test {
namespace {

/// Numbers one after another, 8 bytes each; reals by their bits.
class Numbers {
 public:
  void add(std::uint64_t value) {
    std::byte raw[8];
    for (int k = 0; k < 8; ++k) raw[k] = static_cast<std::byte>((value >> (8 * k)) & 0xFF);
    hash_.update(raw);
  }
  void add_real(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Vec2f& v) { add_real(v.x), add_real(v.y); }
  void add(const Vec3f& v) { add_real(v.x), add_real(v.y), add_real(v.z); }
  void add(const Vec4f& v) { add_real(v.x), add_real(v.y), add_real(v.z), add_real(v.w); }
  void add(const Vec3d& v) { add_real(v.x), add_real(v.y), add_real(v.z); }
  void add(const std::string& text) {
    add(text.size());
    hash_.update(std::as_bytes(std::span(text.data(), text.size())));
  }
  [[nodiscard]] std::string hex() { return hash_.hex(); }

 private:
  Sha256 hash_;
};

void add_mesh(const Mesh& mesh, Numbers& out) {
  out.add(mesh.positions.size());
  for (const Vec3f& p : mesh.positions) out.add(p);
  for (const Vec4f& c : mesh.colors) out.add(c);
  out.add(mesh.wedges.size());
  for (const Wedge& w : mesh.wedges) out.add(w.vertex.index), out.add(w.uv);
  out.add(mesh.faces.size());
  for (const auto& face : mesh.faces)
    for (const WedgeId w : face) out.add(w.index);
  for (const std::uint32_t m : mesh.face_materials) out.add(m);
}

void add_progressive(std::span<const std::byte> bytes, Numbers& out) {
  progressive::EpmContent content = progressive::decode_epm(bytes);
  out.add(content.splits_in_whole);
  out.add(content.complete ? 1 : 0);
  for (const std::string& name : content.mesh.data().material_names) out.add(name);
  for (std::size_t level = 0; level <= content.mesh.split_count(); ++level) {
    content.mesh.go_to(level);
    add_mesh(content.mesh.mesh(), out);
  }
  const auto cells = adapt::decode_cells(content);
  out.add(cells ? cells->size() : 0);
  for (std::size_t n = 0; cells && n < cells->size(); ++n)
    for (const adapt::ChartCells& chart : cells->split(n)) {
      out.add(static_cast<std::uint64_t>(chart.status));
      for (const adapt::CellNode& node : chart.cells.nodes) out.add(node.before), out.add(node.after);
      for (const auto& cell : chart.cells.cells)
        for (const std::uint16_t node : cell) out.add(node);
    }
}

void add_terrain(const terrain::DecodedTerrain& terrain, Numbers& out) {
  const terrain::HeightField& field = terrain.field;
  out.add(static_cast<std::uint64_t>(field.bits));
  for (const double value : {field.spacing, field.unit, field.uv_start, field.uv_step}) out.add_real(value);
  for (const std::int32_t height : field.heights) out.add(static_cast<std::uint64_t>(std::int64_t{height}));
  for (const std::uint32_t count : terrain.levels.vertex_counts) out.add(count);
  for (const std::uint16_t level : terrain.levels.first_level) out.add(level);
  out.add(terrain.view ? 1 : 0);
  if (terrain.view) {
    const terrain::TerrainView& view = *terrain.view;
    out.add(view.eye), out.add(view.target), out.add(view.up);
    for (const double value : {view.tan_half_fov_y, view.near, view.far}) out.add_real(value);
    out.add(static_cast<std::uint64_t>(view.width)), out.add(static_cast<std::uint64_t>(view.height));
  }
  out.add(terrain.levels_in_whole), out.add(terrain.is_complete ? 1 : 0), out.add(terrain.bytes_used);
  for (std::size_t level = 0; level < terrain.levels.count(); ++level) add_mesh(terrain::level_mesh(field, terrain.levels, level), out);
}

void add_joint(std::span<const std::byte> bytes, Numbers& out) {
  const joint::DecodedJoint decoded = joint::decode_joint(bytes);
  add_terrain(decoded.terrain, out);
  out.add(decoded.texture.sha256());
  for (const std::size_t n : {decoded.pair.mesh, decoded.pair.texture, decoded.mesh_levels, decoded.texture_levels, decoded.bytes_used})
    out.add(n);
  out.add(decoded.is_complete ? 1 : 0);
}

void add_draws(const std::filesystem::path& path, std::span<const std::byte> bytes, Numbers& out) {
  const auto load = [](const std::filesystem::path& image, const std::string&) { return io::read_image(image); };
  const io::DrawsFile file = io::decode_draws(bytes, path.string(), path.parent_path(), load);
  out.add(static_cast<std::uint64_t>(file.frame.width)), out.add(static_cast<std::uint64_t>(file.frame.height));
  for (const RasterVertex& v : file.list.vertices) {
    out.add(static_cast<std::uint64_t>(std::int64_t{v.x})), out.add(static_cast<std::uint64_t>(std::int64_t{v.y}));
    out.add_real(v.z), out.add_real(v.w);
    out.add(v.uv), out.add(v.color);
  }
  for (const auto& triangle : file.list.triangles)
    for (const std::uint32_t v : triangle) out.add(v);
  for (const auto& image : file.list.images) out.add(image->sha256());
  for (const Draw& draw : file.list.draws) {
    out.add(draw.first_triangle), out.add(draw.triangle_count), out.add(static_cast<std::uint64_t>(draw.shading));
    out.add(draw.texture), out.add(static_cast<std::uint64_t>(draw.sampler.filter));
    out.add(static_cast<std::uint64_t>(draw.sampler.wrap_u)), out.add(static_cast<std::uint64_t>(draw.sampler.wrap_v));
  }
}

}  // namespace

std::string decoded_sha256(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string extension = path.extension().string();
  Numbers out;
  if (extension == ".epm") {
    add_progressive(bytes, out);
  } else if (extension == ".ettm") {
    add_terrain(terrain::decode_terrain(bytes), out);
  } else if (extension == ".etws") {
    const wavelet::DecodedTexture decoded = wavelet::decode_texture(bytes);
    out.add(decoded.image.sha256()), out.add(decoded.significant), out.add(decoded.is_complete ? 1 : 0);
  } else if (extension == ".ejt") {
    add_joint(bytes, out);
  } else if (extension == ".draws") {
    add_draws(path, bytes, out);
  } else {
    throw InputError(path.string() + ": expected .epm, .ettm, .etws, .ejt or .draws");
  }
  return out.hex();
}

}  // namespace etalon::test
