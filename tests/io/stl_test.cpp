// STL, ascii and binary: welding, what readers meet in the wild, then bad files.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "core/io/mesh_file.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::ScratchFolder;

using Triangle = std::array<Vec3f, 3>;

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string binary(const std::vector<Triangle>& triangles, const std::string& header = "made by hand", std::uint16_t attribute = 0) {
  std::string text = header;
  text.resize(80, '\0');
  text += raw(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    text += std::string(12, '\0');
    for (const Vec3f& p : t) text += raw(p.x) + raw(p.y) + raw(p.z);
    text += raw(attribute);
  }
  return text;
}

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "  facet normal 0 0 1\n    outer loop\n      vertex " + a + "\n      vertex " + b + "\n      vertex " + c +
         "\n    endloop\n  endfacet\n";
}

LoadedModel read(const std::string& content) {
  const ScratchFolder folder;
  return read_mesh(folder.put("m.stl", content));
}

std::string error(const std::string& content) {
  const ScratchFolder folder;
  const auto path = folder.put("m.stl", content);
  const std::string message = input_error([&] { (void)read_mesh(path); });
  return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}

const std::vector<Triangle> kSquare{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}}}};
const std::string kAsciiSquare =
    "solid a square\n" + facet("0 0 0", "1 0 0", "1e0 +1 0") + facet("-0 0 0", "1 1 0", "0 1 .5") + "endsolid a square\n";

void check_square(const Mesh& mesh) {
  CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}});
  REQUIRE(mesh.face_count() == 2);
  CHECK_FALSE(mesh.has_uv);
  CHECK(mesh.colors.empty());
  for (const auto& [face, expected] : {std::pair{0u, std::array{0u, 1u, 2u}}, {1u, {0u, 2u, 3u}}})
    for (int k = 0; k < 3; ++k) CHECK(mesh.wedge(FaceId(face), k).vertex.index == expected[static_cast<std::size_t>(k)]);
}

TEST_CASE("stl: one content in both encodings is one mesh, welded in order of appearance") {
  check_square(read(binary(kSquare)).mesh);
  check_square(read(kAsciiSquare).mesh);
  CHECK(read(binary(kSquare)).notes.empty());
  CHECK(read(kAsciiSquare).notes.empty());
}

TEST_CASE("stl: a binary file that begins with 'solid' is binary, with and without bytes behind it") {
  check_square(read(binary(kSquare, "solid made by a program that should not")).mesh);
  const LoadedModel longer = read(binary(kSquare, "solid but binary") + "end");
  check_square(longer.mesh);
  REQUIRE(longer.notes.size() == 1);
  CHECK(longer.notes[0] == "m.stl: 3 bytes behind the last facet skipped");
}

TEST_CASE("stl: capitals, DOS line ends, blank lines, several solids, normals that are no numbers, no final newline") {
  std::string text = "\r\n SOLID\r\n\r\n" + facet("0 0 0", "1 0 0", "1 1 0") + "ENDSOLID\r\nsolid two words\n" +
                     facet("0 0 0", "1 1 0", "0 1 0.5") + "endsolid";
  text.replace(text.find("normal 0 0 1"), 12, "NORMAL nan nan nan");
  check_square(read(text).mesh);
}

TEST_CASE("stl: attribute bytes are skipped, and said to be") {
  const LoadedModel model = read(binary(kSquare, "COLOR=", 0x7FFF));
  check_square(model.mesh);
  REQUIRE(model.notes.size() == 1);
  CHECK(model.notes[0].find("2 facets have attribute bytes") != std::string::npos);
}

TEST_CASE("stl: degenerate facets are kept; thousands of points are found again") {
  std::vector<Triangle> strip;
  for (int n = 0; n < 5000; ++n) {
    const auto x = static_cast<float>(n);
    strip.push_back({{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}});
  }
  strip.push_back({{{7, 0, 0}, {7, 0, 0}, {7, 0, 0}}});
  const Mesh mesh = read(binary(strip)).mesh;
  CHECK(mesh.face_count() == 5001);
  CHECK(mesh.vertex_count() == 10001);
  CHECK(mesh.wedge(FaceId(5000u), 0).vertex == mesh.wedge(FaceId(5000u), 2).vertex);
}

TEST_CASE("stl: the content decides") {
  const ScratchFolder folder;
  const LoadedModel ply = read_mesh(folder.put("m.stl",
                                               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                               "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                               "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  CHECK(ply.mesh.face_count() == 1);
  REQUIRE(ply.notes.size() == 1);
  CHECK(ply.notes[0] == "m.stl: read as PLY, which is what the file holds");
}

TEST_CASE("stl: bad binary files") {
  CHECK(error("short") == ": STL: expected a header of 84 bytes, got 5 bytes");
  const std::string good = binary(kSquare);
  CHECK(error(good.substr(0, good.size() - 1)) == ": byte 80: 2 facets: expected 184 bytes, got 183: the file ends early");
  // Nothing is reserved for four thousand million facets that are not there.
  std::string greedy = good;
  greedy.replace(80, 4, raw(0xFFFFFFFFu));
  CHECK(error(greedy) == ": byte 80: 4294967295 facets: expected 214748364834 bytes, got 184: the file ends early");
  CHECK(error(binary({})) == ": no faces: expected at least one facet, got none");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::string broken = good;
    broken.replace(84 + 50 + 12 + 4, 4, raw(bad));
    CHECK(error(broken).rfind(": byte 150: facet 1: expected finite coordinates, got ", 0) == 0);
  }
}

TEST_CASE("stl: bad text files") {
  CHECK(error("solid x\nendsolid\n") == ": no faces: expected at least one facet, got none");
  CHECK(error("solid x\n" + facet("0 0 0", "1 0 0", "0 1 0")) == ":8: expected 'endsolid', got the end of the file");
  CHECK(error("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n") == ":4: expected 'vertex', got the end of the file");
  CHECK(error("solid x\n" + facet("0 0 0", "1 nan 0", "0 1 0") + "endsolid\n") == ":5: vertex: expected 3 finite numbers, got 'nan'");
  CHECK(error("solid x\n" + facet("0 0 0", "1 0", "0 1 0") + "endsolid\n") == ":5: vertex: expected 3 finite numbers, got ''");
  CHECK(error("solid x\n" + facet("0 0 0", "1 0 0 9", "0 1 0") + "endsolid\n") == ":5: vertex: expected 3 numbers, got '9' behind them");
  CHECK(error("solid x\n" + facet("0 0 0", "1e39 0 0", "0 1 0") + "endsolid\n") == ":5: vertex: expected 3 finite numbers, got '1e39'");
  CHECK(error("solid x\nfacet normal 0 0 1\nouter ring\n") == ":3: expected 'outer loop'");
  CHECK(error("solid x\nvertex 0 0 0\n") == ":2: expected 'facet' or 'endsolid', got 'vertex'");
  CHECK(error("solid x\nendsolid\nfacet\n") == ":3: expected 'solid', got 'facet'");
  std::string four = "solid x\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid\n";
  four.replace(four.find("    endloop"), 11, "vertex 1 1 0\n endloop");
  CHECK(error(four) == ":7: expected 'endloop', got 'vertex'");
}

TEST_CASE("stl: is not written") {
  const ScratchFolder folder;
  const Mesh mesh = read(binary(kSquare)).mesh;
  CHECK(test::write_error([&] { write_mesh(folder / "out.stl", mesh); }).find("expected .obj, .ply or .glb, got '.stl'") !=
        std::string::npos);
  CHECK(folder.entry_count() == 0);
}

}  // namespace
}  // namespace etalon::io
