// Writes the seeds of the fuzz targets, some hundred bytes each: etalon_make_corpus FOLDER. Streams have data/streams as seeds.
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/io/atomic_file.h"
#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "tests/io/draws_builder.h"
#include "tests/io/image_builder.h"

namespace {

namespace fs = std::filesystem;
using namespace etalon;
using namespace etalon::test;
using namespace std::literals;

void put(const fs::path& path, std::string_view content) {
  fs::create_directories(path.parent_path());
  io::write_file(path, content);
}

/// Two triangles with a seam between them, byte colours, two materials of which one has a texture.
io::LoadedModel small_model() {
  io::LoadedModel model;
  Mesh& mesh = model.mesh;
  mesh.has_uv = true;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5f}};
  mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
  for (const auto& [v, u] : {std::pair{0u, 0.0f}, {1u, 1.0f}, {2u, 0.5f}, {2u, 0.25f}, {1u, 0.75f}, {3u, 0.125f}})
    mesh.wedges.push_back({VertexId(v), {u, 0.5f}});
  mesh.faces = {{WedgeId(0u), WedgeId(1u), WedgeId(2u)}, {WedgeId(3u), WedgeId(4u), WedgeId(5u)}};
  mesh.face_materials = {0, 1};
  model.materials = {{"skin", {}, random_image(2, 2, kRgb8, 1)}, {"plain", {}, {}}};
  return model;
}

void put_meshes(const fs::path& folder) {
  put(folder / "obj/statements.obj",
      "mtllib fuzz.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 1 1 .5e0 1 1 1\nvt 0 0\nvt 1 0\nvt .5 1\nvn 0 0 1\ng b\n"
      "usemtl skin\ns 1\nf 1/1/1 2/2/1 3/3/1\nusemtl plain\nf -1/-1 -2/-2 -3/-3 1/1\nl 1 2\n\0newmtl skin\nKd 1 1 1\nmap_Kd -s 1 1 1 skin.png\nnewmtl plain\n"sv);
  put(folder / "obj/relative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
  const std::string head = "ply\nformat ascii 1.0\n";
  put(folder / "ply/ascii.ply",
      head +
          "comment TextureFile x.png\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
          "property uchar green\nproperty uchar blue\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar int "
          "vertex_indices\n"
          "property int texnumber\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0 1 2 3 0 0\n1 0 0 1 2 3 1 "
          "0\n"
          "0 1 0 1 2 3 0 1\n3 0 1 2 0\n4 0 1 2 -1\n");
  put(folder / "ply/grid.ply",
      head +
          "obj_info num_cols 3\nobj_info num_rows 2\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nelement "
          "range_grid 6\n"
          "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n2 0 .1\n0 1 0\n1 1 0\n2 1 0\n1 0\n1 1\n1 2\n1 3\n1 4\n1 5\n");
  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty short z\nelement face 1\n"
      "property list uchar uint vertex_indices\nproperty list uchar float texcoord\nend_header\n";
  for (const char* vertex : {"\0\0\0\0\0\0\0\0\0\0\0\0\0\0", "\x3f\x80\0\0\0\0\0\0\0\0\0\0\0\0", "\0\0\0\0\x3f\xf0\0\0\0\0\0\0\0\1"})
    big += std::string(vertex, 14);
  put(folder / "ply/big_endian.ply", big + "\3\0\0\0\0\0\0\0\1\0\0\0\2\6"s + std::string(24, '\0'));
  put(folder / "stl/text.stl",
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid x\n");
  put(folder / "stl/binary.stl", "solid but binary" + std::string(64, '\0') + "\1\0\0\0"s + std::string(24, '\0') + "\0\0\x80\x3f"s +
                                     std::string(12, '\0') + "\0\0\x80\x3f"s + std::string(6, '\0'));
  const io::LoadedModel model = small_model();
  fs::create_directories(folder / "gltf");
  io::write_mesh(folder / "ply/little_endian.ply", model.mesh);
  io::write_mesh(folder / "gltf/container.glb", model.mesh, model.materials);
  put(folder / "gltf/plain.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[-1,1,1],"children":[1]},{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,2,0,0,1]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],)"
      R"("buffers":[{"byteLength":39,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}]})");
}

void put_images(const fs::path& folder) {
  const auto image = [&](const char* name, PixelFormat format) {
    fs::create_directories((folder / name).parent_path());
    io::write_image(folder / name, random_image(5, 4, format, 1));
  };
  image("png/rgba8.png", kRgba8);
  image("png/grey16.png", {ChannelType::unorm16, 1});
  put(folder / "png/palette.png",
      png_file(4, 2, 2, 3, {"\x1b", "\xe4"}, png_chunk("PLTE", "\1\2\3\4\5\6\7\10\11\12\13\14") + png_chunk("tRNS", "\1\2")));
  put(folder / "png/interlaced_grey_alpha.png", png_file(2, 2, 8, 4, {"\1\2\3\4", "\5\6\7\10"}));
  image("tiff_little/rgb8.tif", kRgb8);
  image("tiff_little/rgba_float.tif", kRgba32f);
  put(folder / "tiff_big/grey.tif",
      "MM\0*"
      "\0\0\0\x0c\1\2\3\4\0\x0a\1\0\0\3\0\0\0\1\0\2\0\0\1\1\0\3\0\0\0\1\0\2\0\0\1\2\0\3\0\0\0\1\0\x08\0\0\1\3\0\3\0\0\0\1\0\1\0\0\1\6\0\3\0"
      "\0\0\1\0\1\0\0"
      "\1\x11\0\4\0\0\0\1\0\0\0\x08\1\x15\0\3\0\0\0\1\0\1\0\0\1\x16\0\3\0\0\0\1\0\2\0\0\1\x17\0\4\0\0\0\1\0\0\0\4\1\x1c\0\3\0\0\0\1\0\1\0\0\0\0\0\0"sv);
  image("exr/half.exr", {ChannelType::half, 4});
  image("exr/uint.exr", kR32ui);
  io::write_exr(folder / "exr/mixed.exr",
                {{{{"Z"}, random_image(3, 2, {ChannelType::float32, 1}, 2)}, {{"id.triangle"}, random_image(3, 2, kR32ui, 3)}},
                 {{"drawListSha256", "0"}}});
  // Baseline, grey, 8×8 of value 128: one block of DC difference 0 and end of block; each Huffman table has one code.
  std::string jpeg = "\xff\xd8\xff\xdb\x00\x43\x00"s + std::string(64, '\1') + "\xff\xc0\x00\x0b\x08\x00\x08\x00\x08\x01\x01\x11\x00"s;
  for (const char table : {'\x00', '\x10'}) jpeg += "\xff\xc4\x00\x14"s + table + '\1' + std::string(16, '\0');
  put(folder / "jpeg/grey.jpg", jpeg + "\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00\x3f\xff\xd9"s);
}

void put_documents(const fs::path& folder) {
  put(folder / "draws/triangle.draws", draws_bytes(small_header(), small_arrays()));
  put(folder / "draws/clip.draws",
      draws_bytes(
          R"({"schema":"etalon/draws/1","frame":{"width":8,"height":8},"state":{"subtexel_bits":4,"snap":"floor","fill_rule":"right_ymax",)"
          R"("half_rounding":"toward_zero","cull":"clockwise","depth_test":false},"targets":[{"content":"color","format":"rgba half","clear":[0,0,0,1]}],)"
          R"("draws":[{"space":"clip","vertices":3,"triangles":1,"shading":"vertex_color"}]})",
          clip_record(-1, -1, 0, 1) + clip_record(3, -1, 0.5f, 2) + clip_record(-1, 3, 1, -1) + indices({0, 1, 2})));
  put(folder / "view/view.json",
      R"({"schema":"etalon/view/1","eye":[0,0,3],"target":[0,0,0],"up":[0,1,0],"tan_half_fov_y":0.5,"near":0.1,"far":100,"width":64,"height":48})");
  put(folder / "waivers/waivers.json",
      R"({"schema":"etalon/waivers/1","waivers":[{"pair":"a.png","device":"gl","reason":"driver","expires":"2027-01-31","texels":3}]})");
  put(folder / "probe/probe.json",
      R"({"schema":"etalon/probe/1","contract":1,"inputs":[],"device":{"name":"a device","renderer":"a renderer","vendor":"v",)"
      R"("version":"4.5","origin":"OSMesa","declared_subtexel_bits":8},"coverage":{"triangles":1152,"texels":393216,)"
      R"("subtexel_bits":8,"snap":"nearest_even","fill_rule":"left_ymin","differing":0,"nearest":{"subtexel_bits":8,)"
      R"("snap":"nearest_even","fill_rule":"left_ymin"}},"interpolation":{"samples":1031278,"unbounded":5,)"
      R"("affine":0.20400824513784035,"perspective":0.09585351188834164,"depth":0.20913975683271874},"nearest":{"steps":true,)"
      R"("earliest_texel":0.0,"latest_texel":0.0,"fixed_bits":null},"linear":{"unorm8":{"weight_bits":8,"weights_rounded":true,)"
      R"("largest_weight_error":0.003906309604644775,"levels_of_small_step":2,"largest_value_error":0.0054637622093473,)"
      R"("value_error_over_model":0.003125856497962995},"float32":{"weight_bits":null,"weights_rounded":false,)"
      R"("largest_weight_error":0.0,"levels_of_small_step":0,"largest_value_error":5.87228774495685e-08,)"
      R"("value_error_over_model":0.0}},"storage":{"half":"toward_zero","half_values":2789,"unorm8_nearest":true},"factor":4.0,)"
      R"("run":{"day":"2027-01-31"}})");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("etalon_make_corpus: expected FOLDER\n", stderr);
    return 64;
  }
  const fs::path folder = argv[1];
  put_meshes(folder);
  put_images(folder);
  put_documents(folder);
  return 0;
}
