// glTF 2.0, text and binary: small documents put together here.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "tests/io/image_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::ScratchFolder;

template <class T>
std::string raw(std::initializer_list<T> values) {
  std::string bytes;
  for (const T v : values) bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  return bytes;
}

std::string padded(std::string text, char with) {
  text.resize((text.size() + 3) / 4 * 4, with);
  return text;
}

std::string glb(const std::string& json, const std::string& binary) {
  const std::string a = padded(json, ' '), b = padded(binary, '\0');
  return "glTF" +
         raw<std::uint32_t>({2, static_cast<std::uint32_t>(28 + a.size() + b.size()), static_cast<std::uint32_t>(a.size()), 0x4E4F534A}) +
         a + raw<std::uint32_t>({static_cast<std::uint32_t>(b.size()), 0x004E4942}) + b;
}

/// Replaces the only place of `from`.
std::string with(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(text.find(from) != text.npos);
  return text.replace(text.find(from), from.size(), to);
}

/// A square: 4 vertices, 6 indices of 16 bits, coordinates, byte colours.
const std::string kBinary = raw<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + raw<float>({0, 1, 1, 1, 1, 0, 0, 0.25f}) +
                            raw<std::uint16_t>({0, 1, 2, 0, 2, 3}) +
                            raw<std::uint8_t>({255, 0, 0, 255, 0, 51, 0, 255, 0, 0, 255, 255, 9, 9, 9, 0});
const std::string kJson = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":3},"indices":2}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"},{"bufferView":3,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},{"buffer":0,"byteOffset":80,"byteLength":12},
{"buffer":0,"byteOffset":92,"byteLength":16}],"buffers":[{"byteLength":108}]})";

LoadedModel read(const std::string& json, const std::string& binary = kBinary) {
  const ScratchFolder folder;
  return read_mesh(folder.put("m.glb", glb(json, binary)));
}

std::string error_of(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  const auto path = folder.put(name, content);
  const std::string message = input_error([&] { (void)read_mesh(path); });
  return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}
std::string error(const std::string& json, const std::string& binary = kBinary) { return error_of("m.glb", glb(json, binary)); }

TEST_CASE("gltf: positions, coordinates with v turned up, colours, indices") {
  const LoadedModel model = read(kJson);
  const Mesh& mesh = model.mesh;
  CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(mesh.colors[1] == Vec4f(0, 51 / 255.0f, 0, 1));
  CHECK(mesh.colors[3].w == 0);
  REQUIRE(mesh.face_count() == 2);
  CHECK(mesh.vertex(FaceId(1u), 2) == VertexId(3u));
  CHECK(mesh.wedge(FaceId(1u), 2).uv == Vec2f(0, 0.75f));
  CHECK(mesh.wedge(FaceId(0u), 0).uv == Vec2f(0, 0));
  CHECK(model.materials.empty());
  CHECK(mesh.face_materials.empty());
  CHECK(model.notes.empty());
}

TEST_CASE("gltf: flip_v undoes the format's convention for files that run the other way") {
  Mesh mesh = read(kJson).mesh;
  flip_v(mesh);
  CHECK(mesh.wedge(FaceId(1u), 2).uv == Vec2f(0, 0.25f));
}

TEST_CASE("gltf: text with its buffer inside, and beside under an escaped name") {
  const ScratchFolder folder;
  const Mesh mesh = read(kJson).mesh;
  // One VEC3 triangle of zeros and ones: 36 bytes.
  const std::string tiny = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  CHECK(read_mesh(folder.put("tiny.gltf", tiny)).mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(error_of("m.gltf", with(tiny, "AAAA", "A!AA")).find("expected a base64 digit, got '!'") != std::string::npos);
  CHECK(error_of("m.gltf", with(tiny, "AAAAAAAA", "")) == ": buffers[0]: byteLength: expected at most 30, got 36");
  folder.put("my buffer.bin", kBinary);
  const std::string beside = with(kJson, R"({"byteLength":108})", R"({"byteLength":108,"uri":"my%20buffer.bin"})");
  CHECK(read_mesh(folder.put("m.gltf", beside)).mesh == mesh);
  CHECK(read_mesh(folder / "m.gltf").side_files == std::vector<std::filesystem::path>{folder / "my buffer.bin"});
  CHECK(error_of("m.gltf", beside) == ": buffers[0]: expected a file 'my%20buffer.bin', got none");
  CHECK(error_of("m.gltf", kJson) == ": buffers[0]: expected a 'uri' or the binary chunk of a .glb, got neither");
}

TEST_CASE("gltf: transforms of nodes, parents last; a mirrored one turns its triangles") {
  const auto positions = [](const std::string& nodes) { return read(with(kJson, R"([{"mesh":0}])", nodes)).mesh.positions; };
  CHECK(positions(R"([{"mesh":0,"translation":[1,2,3]}])")[2] == Vec3f(2, 3, 3));
  // A quarter turn about z: x → y.
  CHECK(positions(R"([{"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476]}])")[1].y == 1);
  CHECK(positions(R"([{"mesh":0,"matrix":[2,0,0,0, 0,3,0,0, 0,0,1,0, 5,0,0,1]}])")[2] == Vec3f(7, 3, 0));
  CHECK(positions(R"([{"children":[1],"scale":[2,2,2]},{"mesh":0,"translation":[1,0,0]}])")[2] == Vec3f(4, 2, 0));
  CHECK(positions(R"([{"children":[1],"translation":[1,0,0]},{"mesh":0,"scale":[2,2,2]}])")[2] == Vec3f(3, 2, 0));
  const Mesh mirrored = read(with(kJson, R"([{"mesh":0}])", R"([{"mesh":0,"scale":[-1,1,1]}])")).mesh;
  CHECK(mirrored.vertex(FaceId(0u), 1) == VertexId(2u));
  CHECK(mirrored.vertex(FaceId(0u), 2) == VertexId(1u));
  CHECK(error(with(kJson, R"([{"mesh":0}])", R"([{"mesh":0,"scale":[1,1]}])")) == ": nodes[0].scale: expected 3 numbers, got 2");
  CHECK(error(with(kJson, R"([{"mesh":0}])", R"([{"mesh":0,"scale":[1e300,1,1]}])")) ==
        ": accessors[0]: element 1: expected a finite position after its node's transform");
  CHECK(error(with(kJson, R"([{"mesh":0}])", R"([{"mesh":0,"children":[0]}])")) ==
        ": nodes[0]: expected at most one parent, got a second one (or a cycle)");
  CHECK(error(with(kJson, R"([{"mesh":0}])", R"([{"mesh":0,"children":[7]}])")) == ": nodes: index expected below 1, got 7");
}

TEST_CASE("gltf: without scenes every node that is nobody's child is a root") {
  std::string json = with(kJson, R"("scene":0,"scenes":[{"nodes":[0]}],)", "");
  json = with(json, R"([{"mesh":0}])", R"([{"mesh":0},{"children":[0]},{"mesh":0,"translation":[0,0,5]}])");
  CHECK(read(json).mesh.face_count() == 4);
}

TEST_CASE("gltf: seam vertices are welded, vertices of different colour are not") {
  std::string binary = kBinary;
  std::memcpy(binary.data() + 36, raw<float>({0, 0, 0}).data(), 12);  // vertex 3 falls onto vertex 0, their colours differ
  CHECK(read(kJson, binary).mesh.vertex_count() == 4);
  const std::string plain = with(kJson, R"(,"COLOR_0":3)", "");
  const Mesh mesh = read(plain, binary).mesh;
  CHECK(mesh.vertex_count() == 3);
  CHECK(mesh.wedge_count() == 4);
}

TEST_CASE("gltf: strips and fans") {
  const std::string plain = with(kJson, R"(,"indices":2)", "");
  const auto faces = [&](const char* mode) {
    const Mesh mesh = read(with(plain, R"("primitives":[{)", std::string(R"("primitives":[{"mode":)") + mode + ",")).mesh;
    std::string text;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
      for (int k = 0; k < 3; ++k) text += std::to_string(mesh.vertex(FaceId(f), k).index);
    return text;
  };
  CHECK(faces("5") == "012132");
  CHECK(faces("6") == "120230");
  CHECK(error(plain) == ": meshes[0].primitives[0]: expected a multiple of 3 indices, got 4");
}

TEST_CASE("gltf: materials with a texture inside, beside and of another coordinate set; parts without material") {
  const ScratchFolder folder;
  const std::string png = test::png_file(1, 2, 8, 0, {"\x07", "\x09"});
  folder.put("t.png", png);
  const std::string binary = kBinary + png;
  std::string json = with(kJson, R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"COLOR_0":3},"indices":2}]}])",
                          R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":1},
{"attributes":{"POSITION":0,"TEXCOORD_1":1},"indices":2,"material":0},{"attributes":{"POSITION":0},"indices":2},
{"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":2}]}],
"materials":[{"name":"a","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}},
{"name":"b","pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},{"pbrMetallicRoughness":{"baseColorTexture":{"index":2}}}],
"textures":[{"source":0},{"source":1},{}],"images":[{"uri":"t.png"},{"bufferView":4,"mimeType":"image/png"}])");
  json = with(json, R"("byteOffset":92,"byteLength":16})",
              R"("byteOffset":92,"byteLength":16},{"buffer":0,"byteOffset":108,"byteLength":)" + std::to_string(png.size()) + "}");
  json = with(json, R"([{"byteLength":108}])", R"([{"byteLength":)" + std::to_string(binary.size()) + "}]");
  const LoadedModel model = read_mesh(folder.put("m.glb", glb(json, binary)));
  REQUIRE(model.materials.size() == 4);
  CHECK(model.materials[0].name == "b");
  CHECK(load_texture(model.materials[0]).channels<std::uint8_t>(0, 0)[0] == 9);
  CHECK(model.materials[1].name == "a");
  CHECK(model.materials[1].texture_path == folder / "t.png");
  CHECK(model.materials[2].name.empty());
  CHECK(model.mesh.face_materials == std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3});
  CHECK(model.mesh.vertex_count() == 4);
  CHECK(model.mesh.wedge(FaceId(3u), 2).uv == Vec2f(0, 0.75f));
  CHECK(model.mesh.wedge(FaceId(5u), 2).uv == Vec2f(0, 0));
  CHECK(model.notes == std::vector<std::string>{"m.glb: meshes[0].primitives[3]: points and lines are skipped",
                                                "m.glb: textures[2]: a texture without PNG or JPEG source is skipped",
                                                "m.glb: 2 of 8 triangles have no texture coordinates; they get (0, 0)"});
  const std::string broken = binary.substr(0, binary.size() - 3) + "xyz";
  CHECK(error_of("m.glb", glb(json, broken)).starts_with(": images[1]: byte "));
}

TEST_CASE("gltf: bad containers") {
  const std::string good = glb(kJson, kBinary);
  CHECK(error_of("m.glb", "glTF") == ": byte 4: the file ends early: expected the container version");
  CHECK(error_of("m.glb", "xyz") == ": byte 0: expected glTF: the magic word 'glTF' or a JSON object, got 'xyz'");
  std::string bad = good;
  bad[4] = 1;
  CHECK(error_of("m.glb", bad) == ": byte 4: container version: expected 2, got 1");
  bad = good;
  bad[16] = 'X';
  CHECK(error_of("m.glb", bad) == ": byte 16: first chunk: expected type JSON, got 4e4f5358");
  bad = good;
  bad[15] = 1;
  CHECK(error_of("m.glb", bad).starts_with(": byte 12: chunk length: expected at most"));
  CHECK(error_of("m.glb", good.substr(0, good.size() - 1)).starts_with(": byte 8: the file ends early: expected"));
}

TEST_CASE("gltf: bad documents, each named by its place") {
  CHECK(error("{").starts_with(": byte 2"));
  CHECK(error("{}") == ": glTF: expected a member 'asset', got none");
  CHECK(error("[]") == ": glTF: expected an object, got array");
  CHECK(error(R"({"asset":{"version":"1.0"}})") == ": asset.version: expected 2.x, got '1.0'");
  CHECK(error(R"({"asset":{"version":"2.0"}})") == ": no faces: expected at least one mesh with triangles in the default scene, got none");
  CHECK(error(with(kJson, R"("scene":0,)", R"("extensionsRequired":["KHR_draco_mesh_compression"],)")) ==
        ": extensionsRequired: the required extension 'KHR_draco_mesh_compression' is not supported");
  CHECK(error(with(kJson, R"("scene":0,)", R"("scene":1,)")) == ": scenes: index expected below 1, got 1");
  CHECK(error(with(kJson, R"("scene":0,)", R"("scene":-1,)")) == ": scene: expected an integer from 0, got -1");
  CHECK(error(with(kJson, R"("scene":0,)", R"("scene":0.0,)")) == "no error");
  CHECK(error(with(kJson, R"("nodes":[0])", R"("nodes":0)")) == ": scenes[0].nodes: expected an array, got number");
  CHECK(error(with(kJson, R"("POSITION":0,)", "")) == ": meshes[0].primitives[0].attributes: expected a member 'POSITION', got none");
  CHECK(error(with(kJson, R"("POSITION":0,)", R"("POSITION":1,)")) == ": accessors[1]: expected 3 to 3 components, got 2");
  CHECK(error(with(kJson, R"("indices":2)", R"("indices":0)")) == ": accessors[0]: indices: expected unsigned scalars");
  CHECK(error(with(kJson, R"("indices":2)", R"("indices":2,"mode":9)")) == ": meshes[0].primitives[0]: mode: expected 0 to 6, got 9");
  CHECK(error(with(kJson, R"("count":6)", R"("count":7)")) ==
        ": accessors[2]: expected to lie within the view's 12 bytes, got 7 elements at offset 0");
  CHECK(error(with(kJson, R"("count":6)", R"("count":4000000000)")) ==
        ": accessors[2]: expected to lie within the view's 12 bytes, got 4000000000 elements at offset 0");
  CHECK(error(with(kJson, R"("count":6)", R"("count":18446744073709551615)")).find("got 18446744073709551615 elements") !=
        std::string::npos);
  CHECK(error(with(kJson, R"("count":6)", R"("count":6,"byteOffset":18446744073709551615)")).find("at offset 18446744073709551615") !=
        std::string::npos);
  CHECK(error(with(kJson, R"("count":6)", R"("count":6,"sparse":{})")) == ": accessors[2]: sparse accessors are not supported");
  CHECK(error(with(kJson, R"("bufferView":2,)", "")) == ": accessors[2]: expected a member 'bufferView', got none");
  CHECK(error(with(kJson, R"("componentType":5123)", R"("componentType":5130)")) ==
        ": accessors[2]: expected a scalar or vector of a glTF component type");
  CHECK(error(with(kJson, R"("type":"SCALAR")", R"("type":"MAT4")")) ==
        ": accessors[2]: expected a scalar or vector of a glTF component type");
  CHECK(error(with(kJson, R"("byteLength":12})", R"("byteLength":12,"byteStride":1})")) ==
        ": accessors[2]: byteStride: expected 2 to 252, got 1");
  CHECK(error(with(kJson, R"("byteOffset":92)", R"("byteOffset":99)")) ==
        ": bufferViews[3]: expected to lie within the buffer's 108 bytes, got offset 99 and length 16");
  CHECK(error(with(kJson, R"({"byteLength":108})", R"({"byteLength":109})")) == ": buffers[0]: byteLength: expected at most 108, got 109");
  CHECK(error(with(kJson, R"("TEXCOORD_0":1)", R"("TEXCOORD_0":0)")) == ": accessors[0]: expected 2 to 2 components, got 3");
}

TEST_CASE("asset.copyright: read, and written into every format on one line") {
  CHECK(read(kJson).credit.empty());
  CHECK(read(with(kJson, R"("version":"2.0")", R"("version":"2.0","copyright":7)")).credit.empty());
  const LoadedModel model = read(with(kJson, R"("version":"2.0")", R"("version":"2.0","copyright":"by A\nand B\\")"));
  CHECK(model.credit == "by A and B\\ ");
  const ScratchFolder folder;
  const auto written = [&](const std::string& name) {
    write_mesh(folder.path() / name, model.mesh, {}, model.credit);
    const FileBytes bytes = read_file(folder.path() / name);
    const LoadedModel back = read_mesh(folder.path() / name);
    CHECK(back.mesh == model.mesh);
    CHECK(back.materials.empty());
    return std::pair(std::string(bytes.text()), back.credit);
  };
  CHECK(written("m.glb").second == model.credit);
  CHECK(written("m.obj").first.starts_with("# credit: by A and B\\ \n"));
  CHECK(written("m.ply").first.find("\ncomment credit: by A and B\\ \n") != std::string::npos);
}

TEST_CASE("gltf: bad numbers in buffers") {
  const auto put = [](std::size_t offset, const std::string& bytes) {
    std::string binary = kBinary;
    return binary.replace(offset, bytes.size(), bytes);
  };
  CHECK(error(kJson, put(16, raw<std::uint32_t>({0x7FC00000}))) == ": accessors[0]: element 1: expected a finite number, got nan");
  CHECK(error(kJson, put(52, raw<std::uint32_t>({0x7F800000}))) == ": accessors[1]: element 0: expected a finite number, got inf");
  CHECK(error(kJson, put(84, raw<std::uint16_t>({4}))) == ": accessors[2]: element 2: vertex index expected below 4, got 4");
  const std::string floats =
      with(kJson, R"("componentType":5121,"normalized":true,"count":4,"type":"VEC4")", R"("componentType":5121,"count":4,"type":"VEC4")");
  CHECK(error(floats) == ": accessors[3]: element 0: expected a colour from 0 to 1, got 255");
}

}  // namespace
}  // namespace etalon::io
