// Wavefront OBJ and its material libraries: tiny literal files, the exact mesh or the exact complaint.
#include <doctest/doctest.h>

#include "core/io/mesh_file.h"
#include "tests/io/image_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::ScratchFolder;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

LoadedModel read(const std::string& content) {
  const ScratchFolder folder;
  return read_mesh(folder.put("m.obj", content));
}

std::string error(const std::string& content) {
  const ScratchFolder folder;
  const auto path = folder.put("m.obj", content);
  const std::string message = input_error([&] { (void)read_mesh(path); });
  return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}

/// "0 1 2, 0 2 3": the vertices of the faces.
std::string faces(const Mesh& mesh) {
  std::string text;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (f != 0) text += ", ";
    for (int k = 0; k < 3; ++k) text += (k != 0 ? " " : "") + std::to_string(mesh.vertex(FaceId(f), k).index);
  }
  return text;
}

TEST_CASE("obj: polygons become fans, indices count from either end, DOS line ends and comments do not matter") {
  CHECK(faces(read(kSquare + "f 1 2 3 4\n").mesh) == "0 1 2, 0 2 3");
  CHECK(faces(read(kSquare + "f -4 -3 -2 -1").mesh) == "0 1 2, 0 2 3");
  CHECK(faces(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -3 -2 -1\n").mesh) == "0 1 2, 1 2 3");
  CHECK(faces(read("# c\r\nv 0 0 0 # c\r\n\r\nv 1 0 0\r\nv 0 1 0\r\n  f\t1 2   3 # c\r\n").mesh) == "0 1 2");
  CHECK(faces(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n 2 \\\r\n 3\n").mesh) == "0 1 2");
  CHECK(faces(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").mesh) == "0 1 2");
  CHECK(faces(read(kSquare + "f 1 1 1\n").mesh) == "0 0 0");  // degenerate, but the file's
}

TEST_CASE("obj: without texture coordinates wedge i is vertex i, unused vertices included") {
  const Mesh mesh = read(kSquare + "f 4 2 3\n").mesh;
  CHECK_FALSE(mesh.has_uv);
  REQUIRE(mesh.wedge_count() == 4);
  for (std::uint32_t v = 0; v < 4; ++v) CHECK(mesh.wedges[v].vertex == VertexId(v));
}

TEST_CASE("obj: wedges are the different pairs of vertex and coordinate, by value") {
  // vt 1 and vt 3 hold the same numbers; −0 equals 0; vertex 2 has two coordinates.
  const Mesh mesh = read(kSquare + "vt 0 .25\nvt 1 1\nvt -0 0.25\nvt .5 2 7\nf 1/1 2/2 3/4\nf 1/3/1 3/4/1 2/1\n").mesh;
  CHECK(mesh.has_uv);
  REQUIRE(mesh.wedge_count() == 4);
  CHECK(mesh.wedges[0] == Wedge{VertexId(0u), {0, 0.25f}});
  CHECK(mesh.wedges[1] == Wedge{VertexId(1u), {1, 1}});
  CHECK(mesh.wedges[2] == Wedge{VertexId(2u), {0.5f, 2}});
  CHECK(mesh.wedges[3] == Wedge{VertexId(1u), {0, 0.25f}});
  CHECK(mesh.faces[1] == std::array{WedgeId(0u), WedgeId(2u), WedgeId(3u)});
}

TEST_CASE("obj: the pole of a sphere has as many wedges as coordinates, each once") {
  std::string text = "v 0 0 1\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 100; ++i) text += "vt " + std::to_string(i) + " 1\n";
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 1; i <= 100; ++i) text += "f 1/" + std::to_string(i) + " 2/1 3/1\n";
  const Mesh mesh = read(text).mesh;
  CHECK(mesh.wedge_count() == 102);
  for (std::uint32_t i = 0; i < 100; ++i) {
    CHECK(mesh.wedge(FaceId(i), 0) == Wedge{VertexId(0u), {static_cast<float>(i), 1}});
    CHECK(mesh.faces[i + 100] == mesh.faces[i]);
  }
}

TEST_CASE("obj: a face without coordinates among others gets (0, 0) and a note") {
  const LoadedModel model = read(kSquare + "vt 1 1\nf 1/1 2/1 3/1\nf 1//1 3 4\n");
  CHECK(model.mesh.wedge(FaceId(1u), 2).uv == Vec2f(0));
  REQUIRE(model.notes.size() == 1);
  CHECK(model.notes[0] == "m.obj: 1 of 2 triangles have no texture coordinates; they get (0, 0)");
}

TEST_CASE("obj: colours after the position, white where a vertex has none") {
  const Mesh mesh = read("v 0 0 0\nv 1 0 0 0.25 .5 1\nv 0 1 0 0 0 0 0.5\nv 0 0 1 1\nf 1 2 3\n").mesh;
  REQUIRE(mesh.colors.size() == 4);
  CHECK(mesh.colors[0] == Vec4f(1));
  CHECK(mesh.colors[1] == Vec4f(0.25f, 0.5f, 1, 1));
  CHECK(mesh.colors[2] == Vec4f(0, 0, 0, 0.5f));
  CHECK(mesh.colors[3] == Vec4f(1));
}

TEST_CASE("obj: materials in order of first use, textures found beside the model whatever the spelling") {
  const ScratchFolder folder;
  const std::string png = test::png_file(1, 1, 8, 0, {"\x07"});
  folder.put("skin map.png", png);
  folder.put("b.png", png);
  folder.put("my lib.mtl",
             "newmtl unused\nmap_Kd none.png\n newmtl skin of cow \r\nKd 1 0 0\nmap_Kd -s 1 1 1 -o 0 0 -bm 2 skin map.png\r\n"
             "newmtl b\nmap_Kd \"C:\\textures\\b.png\"\nmap_Kd second.png\nnewmtl c\nmap_Kd gone.png\n");
  const auto path =
      folder.put("m.obj", "mtllib my lib.mtl\n" + kSquare +
                              "usemtl unused\nusemtl b\nf 1 2 3\nusemtl skin of cow\nf 1 3 4\nusemtl b\nf 1 2 4\nusemtl c\nf 2 3 4\n"
                              "usemtl undeclared\nf 2 3 4\n");
  const LoadedModel model = read_mesh(path);
  REQUIRE(model.materials.size() == 4);
  CHECK(model.materials[0].name == "b");
  CHECK(model.materials[0].texture_path == folder / "b.png");
  CHECK(model.materials[1].name == "skin of cow");
  CHECK(model.materials[1].texture_path == folder / "skin map.png");
  CHECK(load_texture(model.materials[1]).channels<std::uint8_t>(0, 0)[0] == 7);
  CHECK(model.materials[2].name == "c");
  CHECK_FALSE(model.materials[2].texture_path.has_value());
  CHECK(load_texture(model.materials[2]).empty());
  CHECK(model.mesh.face_materials == std::vector<std::uint32_t>{0, 1, 0, 2, 3});
  REQUIRE(model.notes.size() == 1);
  CHECK(model.notes[0] == "m.obj: texture 'gone.png' of material 'c' not found");
}

TEST_CASE("obj: several libraries in one statement, in quotes, missing, empty") {
  const ScratchFolder folder;
  folder.put("a.mtl", "newmtl a\nmap_Kd t.png\n");
  folder.put("b.mtl", "");
  folder.put("t.png", test::png_file(1, 1, 8, 0, {"\x07"}));
  const LoadedModel model = read_mesh(folder.put("m.obj", "mtllib \"a.mtl\"\nmtllib b.mtl no.mtl\n" + kSquare + "usemtl a\nf 1 2 3\n"));
  CHECK(model.materials.at(0).texture_path == folder / "t.png");
  CHECK(model.notes == std::vector<std::string>{"m.obj:2: material library 'no.mtl' not found"});
}

TEST_CASE("obj: faces before the first usemtl share a nameless material if there are others") {
  const LoadedModel model = read(kSquare + "f 1 2 3\nusemtl a\nf 1 3 4\n");
  REQUIRE(model.materials.size() == 2);
  CHECK(model.materials[0].name.empty());
  CHECK(model.materials[1].name == "a");
  CHECK(model.mesh.face_materials == std::vector<std::uint32_t>{0, 1});
  CHECK(read(kSquare + "f 1 2 3\n").materials.empty());
  CHECK(read(kSquare + "f 1 2 3\n").mesh.face_materials.empty());
  CHECK(read(kSquare + "usemtl a\nf 1 2 3\nusemtl b\n").materials.size() == 1);
}

TEST_CASE("obj: statements of no concern are silent, unknown ones a single note") {
  CHECK(read("o a\ng b\ns 1\nvn 0 0 1\nvp 0\nl 1 2\n" + kSquare + "f 1 2 3\n").notes.empty());
  CHECK(read(kSquare + "wobble 1\nwibble\nf 1 2 3\n").notes ==
        std::vector<std::string>{"m.obj:5: statement 'wobble' skipped, it is unknown"});
}

TEST_CASE("obj: bad files, one clear line each") {
  CHECK(error("v 0 0 0\n") == ": no faces: expected at least one statement 'f', got none");
  CHECK(error("\n") == ": no faces: expected at least one statement 'f', got none");
  CHECK(error("") == ": the file is empty");
  CHECK(error("v 0 nan 0\n") == ":1: vertex: expected a finite number, got 'nan'");
  CHECK(error("\nv 0 inf 0\n") == ":2: vertex: expected a finite number, got 'inf'");
  CHECK(error("v 0 1e39 0\n") == ":1: vertex: expected a finite number, got '1e39'");
  CHECK(error("v 0 0\n") == ":1: vertex: expected 'x y z', 'x y z w', 'x y z r g b' or 'x y z r g b a', got 2 numbers");
  CHECK(error("v 0 0 0 1 1\n") == ":1: vertex: expected 'x y z', 'x y z w', 'x y z r g b' or 'x y z r g b a', got 5 numbers");
  CHECK(error("v 1 2 3 4 5 6 7 8\n") == ":1: vertex: expected at most 7 numbers, got more");
  CHECK(error("v 0 0 0 255 0 0\n") == ":1: vertex colour: expected 0 to 1, got 255");
  CHECK(error("v 0 0 0 -1 0 0\n") == ":1: vertex colour: expected 0 to 1, got -1");
  CHECK(error("vt\n") == ":1: texture coordinate: expected 'u v', got nothing");
  CHECK(error("vt nan 0\n") == ":1: texture coordinate: expected a finite number, got 'nan'");
  CHECK(error("vt 1 2 3 4\n") == ":1: texture coordinate: expected at most 3 numbers, got more");
  CHECK(error(kSquare + "f 1 2\n") == ":5: face: expected at least 3 corners, got 2");
  CHECK(error(kSquare + "f\n") == ":5: face: expected at least 3 corners, got 0");
  CHECK(error(kSquare + "f 1 2 x\n") == ":5: face: expected a vertex index from 1 or negative, got 'x'");
  CHECK(error(kSquare + "f 0 1 2\n") == ":5: face: expected a vertex index from 1 or negative, got '0'");
  CHECK(error(kSquare + "f 1 2 99999999999999999999\n") ==
        ":5: face: expected a vertex index from 1 or negative, got '99999999999999999999'");
  CHECK(error(kSquare + "f 1 2 5\n") == ":5: face: vertex index expected 1 to 4, got 5");
  CHECK(error(kSquare + "f 1 2 4294967297\nf 1 2 3\n") == ":5: face: vertex index expected 1 to 4, got 4294967297");
  CHECK(error(kSquare + "f 1 2 -5\n") == ":5: face: vertex index expected -4 to -1 here, got -5");
  CHECK(error(kSquare + "f 1 2 -9223372036854775808\n") == ":5: face: vertex index expected -4 to -1 here, got -9223372036854775808");
  CHECK(error(kSquare + "vt 0 0\nf 1/1 2/1 3/2\n") == ":6: face: texture coordinate index expected 1 to 1, got 2");
  CHECK(error(kSquare + "f 1/ 2/ 3/\n") == "no error");
  CHECK(error(kSquare + "f 1;2 2 3\n") == ":5: face: expected v, v/vt, v//vn or v/vt/vn, got '1;2'");
  CHECK(error(kSquare + "f 1//x 2 3\n") == ":5: face: expected v, v/vt, v//vn or v/vt/vn, got '1//x'");
  CHECK(error(kSquare + "f 1/1/1/1 2 3\n") == ":5: face: expected v, v/vt, v//vn or v/vt/vn, got '1/1/1/1'");
}

}  // namespace
}  // namespace etalon::io
