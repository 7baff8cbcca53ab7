// Mesh files: Wavefront OBJ (+MTL), PLY, glTF 2.0 (.glb, .gltf); STL is read, never written (it would lose colours and coordinates).
// Does not: subdivision surfaces, curves, points and lines, normals, animation, skins, shading beyond the base colour texture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/mesh/mesh.h"

namespace etalon::io {

/// How a texture is meant to be looked up.
enum class TextureLookup : std::uint8_t {
  any,      ///< as a viewer does
  nearest,  ///< the nearest texel
  linear,   ///< between four texels, in level 0 alone
  mipmap,   ///< between four texels in each of two mip levels
};

struct Material {
  std::string name;
  std::optional<std::filesystem::path> texture_path;  ///< of an existing file beside the model, ready to open
  Image texture;                                      ///< embedded in the model file (GLB), rows as everywhere; else empty
  /// Written to .glb (a sampler that says so, and no wrapping), never read; OBJ and PLY cannot say it.
  TextureLookup lookup = TextureLookup::any;
};

struct LoadedModel {
  Mesh mesh;
  std::vector<Material> materials;                ///< those that faces use, in order of first use; empty where the file names none
  std::vector<std::string> notes;                 ///< one line each: what was skipped or missing, and where
  std::string credit;                             ///< who must be named, on one line: asset.copyright of glTF
  std::vector<std::filesystem::path> side_files;  ///< what was read beside `path`, textures apart: material libraries, glTF buffers
};

/// Reads the mesh at `path`; the extension must be .obj, .ply, .stl, .glb or .gltf (any case), the content decides where it says otherwise.
///
/// Common to all: polygons become fans around their first corner; every triangle of the file is kept, degenerate ones too; vertices keep
/// the file's order, also unused ones. Wedges are the different (vertex, uv) pairs: where the file has coordinates at corners, in order of
/// first use by the faces; where it has them at vertices (glTF, some PLY), vertices are welded by equal position and colour
/// (core/mesh/weld.h) and both keep the order of first appearance; without coordinates wedge i is vertex i. Colours are in [0, 1] as
/// stored, integers divided by their maximum in float32; double coordinates are rounded to float32. Faces without texture coordinates in
/// a model that has some get (0, 0), with a note.
/// - OBJ: v is up and stays. `v x y z r g b [a]` are colours. A missing material library or texture is a note.
/// - PLY: texture coordinates s t | u v | texture_u texture_v of vertices, or a `texcoord` list of faces with `texnumber` and
///   `comment TextureFile NAME`; v is up and stays. Elements `tristrips`, `range_grid` too.
/// - STL: no colours, no texture coordinates; points of equal coordinates are welded into one vertex, which keeps the order (and, of zeros,
///   the sign) of its first appearance. Normals and attribute bytes are skipped, the latter with a note where they are not 0.
/// - glTF: v runs down there, so v = 1 − v_file in float32: exact for v_file in [0.5, 2] (Sterbenz' lemma), else rounded once.
///   Node transforms are applied in double and rounded once; a mirrored one turns its triangles around. All meshes of the default scene
///   are joined.
///
/// InputError ("FILE:LINE: …", "FILE: byte OFFSET: …" or "FILE: JSON-PATH: …") for anything missing, truncated, malformed, not finite,
/// out of range, or without faces; no count of a header is believed before it is held against the size of the file.
/// InputError too, before anything is parsed, where the mesh and `work_bytes_per_face` for what the caller does with it cannot fit into a
/// limit on this process (core/base/memory_limit.h); it states the need.
[[nodiscard]] LoadedModel read_mesh(const std::filesystem::path& path, std::uint64_t work_bytes_per_face = 0);

/// The base colour texture of `material`: the embedded one, else read from texture_path, else an empty image.
[[nodiscard]] Image load_texture(const Material& material);

/// Replaces every v by 1 − v (float32, rounded): for files whose rows run the other way than their format says.
void flip_v(Mesh& mesh);

/// Writes .obj (+ .mtl, + .png per embedded texture), .ply (binary little-endian) or .glb, each file atomically, the model itself last.
/// `materials` may be empty; otherwise every entry of mesh.face_materials must be below its size. Textures: an embedded image is
/// written as STEM_texture.png (several: STEM_texture_0.png, …) or into the GLB; otherwise texture_path is named relative to the model's folder, and for
/// GLB its file is embedded.
/// Lossless: read_mesh gives back positions, colours, faces, the uv of every corner, and the materials bit by bit (wedges are renumbered),
/// except that glTF rounds v as above, welds vertices of equal position and colour and groups the faces by material, and that PLY keeps the
/// textures of materials, not their names.
/// WriteError where a file cannot be written, its extension is none of these, or the format cannot hold the mesh (no faces, numbers that
/// are not finite, indices or list sizes that do not fit each other).
/// `credit`: who must be named, as asset.copyright (GLB) or a comment; control characters become blanks.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const std::vector<Material>& materials = {},
                const std::string& credit = {});

/// The files that write_mesh would write, the model itself first; nothing is written or checked here.
[[nodiscard]] std::vector<std::filesystem::path> mesh_output_files(const std::filesystem::path& path,
                                                                   const std::vector<Material>& materials = {});

}  // namespace etalon::io
