// PLY in its three encodings: the same literal content through each, then what readers meet in the wild, then bad files.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "core/io/mesh_file.h"
#include "tests/io/image_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::ScratchFolder;

template <class T>
std::string raw(T value, bool big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

LoadedModel read(const std::string& content) {
  const ScratchFolder folder;
  return read_mesh(folder.put("m.ply", content));
}

std::string error(const std::string& content) {
  const ScratchFolder folder;
  const auto path = folder.put("m.ply", content);
  const std::string message = input_error([&] { (void)read_mesh(path); });
  return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}

std::string header(const std::string& format, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\n" + rest + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces1 = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kTriangle = header("ascii", "element vertex 3\n" + kXyz + kFaces1) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST_CASE("ply: one content in three encodings is one mesh") {
  const std::string elements =
      "comment made by hand\nobj_info x\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nproperty list uchar ushort extra\nelement face 2\nproperty int flags\n"
      "property list ushort uint vertex_index\nelement edge 1\nproperty int vertex1\n";
  const float x[4] = {0.1f, 1, 1, 0};
  std::string ascii = header("ascii", elements);
  std::string binary[2] = {header("binary_little_endian", elements), header("binary_big_endian", elements)};
  for (int v = 0; v < 4; ++v) ascii += std::to_string(x[v]) + " " + std::to_string(v) + " -3 255 0 51 2 7 8\n";
  ascii += "9 4 0 1 2 3\n9 3 3 2 1\n5\n";
  for (const bool big : {false, true}) {
    std::string& out = binary[big];
    for (int v = 0; v < 4; ++v) {
      out += raw<double>(x[v], big) + raw<float>(static_cast<float>(v), big) + raw<std::int16_t>(-3, big) + "\xFF" + std::string(1, '\0') +
             "\x33" + "\x02";
      out += raw<std::uint16_t>(7, big) + raw<std::uint16_t>(8, big);
    }
    out += raw<std::int32_t>(9, big) + raw<std::uint16_t>(4, big);
    for (std::uint32_t i = 0; i < 4; ++i) out += raw(i, big);
    out += raw<std::int32_t>(9, big) + raw<std::uint16_t>(3, big);
    for (const std::uint32_t i : {3u, 2u, 1u}) out += raw(i, big);
    out += raw<std::int32_t>(5, big);
  }
  const Mesh mesh = read(ascii).mesh;
  CHECK(mesh == read(binary[0]).mesh);
  CHECK(mesh == read(binary[1]).mesh);
  CHECK(mesh.positions[0] == Vec3f(0.1f, 0, -3));
  CHECK(mesh.colors[3] == Vec4f(1, 0, 51 / 255.0f, 1));
  REQUIRE(mesh.face_count() == 3);  // the square is a fan of two
  CHECK(mesh.faces[0] == std::array{WedgeId(0u), WedgeId(1u), WedgeId(2u)});
  CHECK(mesh.faces[1] == std::array{WedgeId(0u), WedgeId(2u), WedgeId(3u)});
  CHECK(mesh.faces[2] == std::array{WedgeId(3u), WedgeId(2u), WedgeId(1u)});
  CHECK_FALSE(mesh.has_uv);
}

TEST_CASE("ply: line ends of DOS and of old Macs, also before binary data that begins with a line end") {
  std::string dos, mac;
  for (const char c : kTriangle) (c == '\n' ? dos += "\r\n" : dos += c), mac += c == '\n' ? '\r' : c;
  const Mesh mesh = read(kTriangle).mesh;
  CHECK(read(dos).mesh == mesh);
  CHECK(read(mac).mesh == mesh);
  const std::string head = header("binary_little_endian", "element vertex 3\n" + kXyz + kFaces1);
  const std::string first = raw(std::bit_cast<float>(0x3F800A0Du)).substr(0, 4);  // begins with \r\n? its low bytes are 0D 0A
  const std::string zero(8, '\0');
  const std::string body = first + zero + raw(1.0f) + zero + raw(0.0f) + raw(1.0f) + raw(0.0f) + "\x03" + raw(0) + raw(1) + raw(2);
  CHECK(read(head + body).mesh.positions[0].x == std::bit_cast<float>(0x3F800A0Du));
}

TEST_CASE("ply: colours of floats, of 16 bits, with alpha, under other names") {
  const auto color = [](const std::string& properties, const std::string& values) {
    return read(header("ascii", "element vertex 3\n" + kXyz + properties + kFaces1) + "0 0 0 " + values + "\n1 0 0 " + values + "\n0 1 0 " +
                values + "\n3 0 1 2\n")
        .mesh.colors.at(1);
  };
  CHECK(color("property float red\nproperty float green\nproperty float blue\n", "0.1 0 1") == Vec4f(0.1f, 0, 1, 1));
  CHECK(color("property ushort r\nproperty ushort g\nproperty ushort b\nproperty ushort a\n", "65535 0 13107 1") ==
        Vec4f(1, 0, 13107 / 65535.0f, 1 / 65535.0f));
  CHECK(color("property uint8 diffuse_red\nproperty uint8 diffuse_green\nproperty uint8 diffuse_blue\n", "1 2 3") ==
        Vec4f(1 / 255.0f, 2 / 255.0f, 3 / 255.0f, 1));
}

TEST_CASE("ply: coordinates of vertices under their three names; seam vertices are welded") {
  for (const char* names : {"s t", "u v", "texture_u texture_v"}) {
    const std::string u = std::string(names).substr(0, std::string(names).find(' '));
    const std::string v = std::string(names).substr(u.size() + 1);
    // Vertices 1 and 3, 2 and 4 are the ends of a seam.
    const Mesh mesh = read(header("ascii", "element vertex 6\n" + kXyz + "property float " + u + "\nproperty float " + v +
                                               "\nelement face 2\nproperty list uchar int vertex_indices\n") +
                           "0 0 0 0 0.25\n1 0 0 .5 0\n0 1 0 0 .5\n1 0 0 .75 .5\n0 1 0 .5 .75\n1 1 0 1 1\n3 0 1 2\n3 3 5 4\n")
                          .mesh;
    CHECK(mesh.has_uv);
    CHECK(mesh.vertex_count() == 4);
    CHECK(mesh.wedge_count() == 6);
    CHECK(mesh.wedge(FaceId(0u), 0).uv == Vec2f(0, 0.25f));
    CHECK(mesh.wedge(FaceId(1u), 0).uv == Vec2f(0.75f, 0.5f));
    CHECK(mesh.vertex(FaceId(1u), 0) == VertexId(1u));
  }
}

TEST_CASE("ply: coordinates and textures of faces as MeshLab writes them") {
  const ScratchFolder folder;
  folder.put("a.png", test::png_file(1, 1, 8, 0, {"\x07"}));
  const auto path = folder.put(
      "m.ply",
      header("ascii",
             "comment TextureFile a.png\ncomment TextureFile my b.png\nelement vertex 4\n" + kXyz +
                 "element face 4\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n") +
          "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1 1\n3 0 1 2 6 0 0 1 0 1 .5 0\n3 0 1 2 0 -1\n3 0 1 2 0 7\n");
  const LoadedModel model = read_mesh(path);
  CHECK(model.mesh.face_materials == std::vector<std::uint32_t>{0, 0, 1, 2, 3});
  REQUIRE(model.materials.size() == 4);
  CHECK_FALSE(model.materials[0].texture_path.has_value());
  CHECK(model.materials[1].texture_path == folder / "a.png");
  CHECK(model.mesh.wedge(FaceId(1u), 1).uv == Vec2f(1, 1));
  CHECK(model.mesh.wedge(FaceId(2u), 2).uv == Vec2f(1, 0.5f));
  CHECK(model.mesh.wedge(FaceId(3u), 2).uv == Vec2f(0, 0));
  CHECK(model.notes == std::vector<std::string>{"m.ply: 2 of 5 triangles have no texture coordinates; they get (0, 0)",
                                                "m.ply: texture 'my b.png' not found", "m.ply: texture number 7: expected below 2"});
}

TEST_CASE("ply: triangle strips, restarts and repeated indices") {
  const Mesh mesh = read(header("ascii", "element vertex 5\n" + kXyz + "element tristrips 1\nproperty list int int vertex_indices\n") +
                         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 2\n9 0 1 2 3 3 -1 4 1 0\n")
                        .mesh;
  REQUIRE(mesh.face_count() == 3);
  CHECK(mesh.faces[0] == std::array{WedgeId(0u), WedgeId(1u), WedgeId(2u)});
  CHECK(mesh.faces[1] == std::array{WedgeId(2u), WedgeId(1u), WedgeId(3u)});
  CHECK(mesh.faces[2] == std::array{WedgeId(4u), WedgeId(1u), WedgeId(0u)});
}

TEST_CASE("ply: bad headers") {
  CHECK(error("plx\n") == ":1: expected 'ply', got 'plx\\x0a'");
  CHECK(error("ply\n") == ":2: the header ends without 'end_header'");
  CHECK(error("ply\nformat ascii 2.0\n") == ":2: format version: expected 1.0, got '2.0'");
  CHECK(error("ply\nformat octal 1.0\n") == ":2: format: expected ascii, binary_little_endian or binary_big_endian, got 'octal'");
  CHECK(error("ply\nend_header\n") ==
        ":2: expected a line 'format ascii|binary_little_endian|binary_big_endian 1.0' in the header, got none");
  CHECK(error("ply\nbanana\n") == ":2: expected format, comment, obj_info, element, property or end_header, got 'banana'");
  CHECK(error("ply\nproperty int x\n") == ":2: expected an element before the first property");
  CHECK(error("ply\nelement vertex -1\n") == ":2: element 'vertex': expected a count from 0, got '-1'");
  CHECK(error("ply\nelement vertex 1e3\n") == ":2: element 'vertex': expected a count from 0, got '1e3'");
  CHECK(error("ply\nelement vertex 1\nelement vertex 1\n") == ":3: element 'vertex' is declared twice");
  CHECK(error("ply\nelement v 1\nproperty quad x\n") ==
        ":3: property type: expected char, uchar, short, ushort, int, uint, float or double, got 'quad'");
  CHECK(error("ply\nelement v 1\nproperty int\n") == ":3: property: expected a name, got nothing");
  CHECK(error("ply\nelement v 1\nproperty list float int x\n") == ":3: list count: expected an integer type, got a real one");
  CHECK(error(header("ascii", "element vertex 1\n")) == ":4: element 'vertex': expected at least one property");
}

TEST_CASE("ply: a header that claims more than the file holds is refused before anything is allocated") {
  CHECK(error(header("binary_little_endian",
                     "element vertex 3\n" + kXyz + "element face 4000000000\nproperty list uchar int vertex_indices\n") +
              std::string(40, '\0')) == ":9: element 'face' claims 4000000000 rows: expected at least 1 bytes each, got 40 bytes in all");
  CHECK(error(header("binary_little_endian", "element vertex 9223372036854775807\n" + kXyz + kFaces1))
            .find("claims 9223372036854775807 rows") != std::string::npos);
  CHECK(error(header("ascii", "element vertex 100\n" + kXyz + kFaces1) + "0 0 0\n").find("claims 100 rows") != std::string::npos);
  const std::string lists =
      header("binary_little_endian", "element vertex 1\n" + kXyz + "element face 1\nproperty list uint int vertex_indices\n");
  CHECK(error(lists + std::string(12, '\0') + raw<std::uint32_t>(0xFFFFFFFFu)) ==
        ": byte " + std::to_string(lists.size() + 12) +
            ": list 'vertex_indices': expected a count that fits into the rest of the file, got 4294967295");
}

TEST_CASE("ply: bad bodies") {
  const std::string head = header("ascii", "element vertex 3\n" + kXyz + kFaces1);
  const std::string good = "0 0 0\n1 0 0\n0 1 0\n";
  CHECK(error(kTriangle) == "no error");
  CHECK(error(head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n") == ":11: expected a finite number, got 'nan'");
  CHECK(error(head + "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n") == ":11: expected a finite number, got 'inf'");
  CHECK(error(head + good + "3 0 1 3\n") == ":13: face 0: vertex index expected 0 to 2, got 3");
  CHECK(error(head + good + "3 0 1 -1\n") == ":13: face 0: vertex index expected 0 to 2, got -1");
  CHECK(error(head + good + "2 0 1\n") == ":13: face 0: expected at least 3 corners, got 2");
  CHECK(error(head + good + "3 0 1.5 2\n") == ":13: expected an integer, got '1.5'");
  CHECK(error(head + good + "3 0 1") == ":13: list 'vertex_indices': expected a count that fits into the rest of the file, got 3");
  CHECK(error(head + good + "3 0 1 ") == ":13: the file ends early: expected a number");
  CHECK(error(header("ascii", "element vertex 3\n" + kXyz + "property list uchar int extra\n" + kFaces1) +
              "0 0 0 0\n1 0 0 0\n0 1 0\n\n\n\n\n") == ":18: the file ends early: expected a number");
  CHECK(error(header("ascii", "element vertex 3\n" + kXyz) + good) ==
        ": no faces: expected an element 'face', 'tristrips' or 'range_grid' with at least one row, got none");
  CHECK(error(header("ascii", "element vertex 3\n" + kXyz + "element face 0\nproperty list uchar int vertex_indices\n") + good) ==
        ": no faces: expected an element 'face', 'tristrips' or 'range_grid' with at least one row, got none");
  CHECK(error(header("ascii", kFaces1) + "3 0 1 2\n") == ":6: face 0: vertex index expected 0 to -1, got 0");
  CHECK(error(header("ascii", "element vertex 3\nproperty float x\nproperty float y\n" + kFaces1) + "0 0\n1 0\n0 1\n3 0 1 2\n") ==
        ": element 'vertex': expected the properties x, y and z once each");
  CHECK(error(header("ascii", "element vertex 3\n" + kXyz + "element face 1\nproperty int vertex_indices\n") + good + "3\n") ==
        ": element 'face': expected one list 'vertex_indices'");
  CHECK(error(header("ascii", "element vertex 3\n" + kXyz + "property int red\nproperty int green\nproperty int blue\n" + kFaces1) +
              "0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n") == ": vertex colour 'red': expected uchar, ushort, float or double");
  CHECK(error(header("ascii", "element vertex 3\n" + kXyz + "property float red\nproperty float green\nproperty float blue\n" + kFaces1) +
              "0 0 0 1 1 1\n1 0 0 1 2 1\n0 1 0 1 1 1\n3 0 1 2\n") == ":14: vertex 1: 'green': expected a colour from 0 to 1, got 2");
  CHECK(error(header("ascii", "element vertex 3\n" + kXyz + kFaces1 + "property list uchar float texcoord\n") + good +
              "3 0 1 2 4 0 0 1 1\n") == ":14: face 0: 'texcoord': expected 6 numbers, got 4");
}

TEST_CASE("ply: bad numbers in binary files are named by their offset") {
  const std::string head = header("binary_little_endian", "element vertex 3\n" + kXyz + kFaces1);
  const std::string tail = std::string(24, '\0') + "\x03" + raw(0) + raw(1) + raw(2);
  const auto at = [&](std::size_t offset) { return ": byte " + std::to_string(head.size() + offset) + ": "; };
  CHECK(error(head + raw(0.0f) + raw(std::bit_cast<float>(0x7FC00000u)) + raw(0.0f) + tail) ==
        at(4) + "vertex 0: 'y': expected a finite number, got nan");
  CHECK(error(head + raw(0.0f) + raw(0.0f) + raw(std::bit_cast<float>(0xFF800000u)) + tail) ==
        at(8) + "vertex 0: 'z': expected a finite number, got -inf");
  CHECK(error(head + std::string(36, '\0') + "\x03" + raw(0) + raw(1) + raw(3)) == at(45) + "face 0: vertex index expected 0 to 2, got 3");
  CHECK(error(head + std::string(36, '\0') + "\x03" + raw(0) + raw(1) + "ab") ==
        at(36) + "list 'vertex_indices': expected a count that fits into the rest of the file, got 3");
  const std::string doubles =
      header("binary_big_endian", "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n" + kFaces1);
  CHECK(error(doubles + raw(1e300, true) + std::string(64, '\0') + std::string(13, '\0')) ==
        ": byte " + std::to_string(doubles.size()) + ": vertex 0: 'x': expected a finite number, got inf");
}

}  // namespace
}  // namespace etalon::io
