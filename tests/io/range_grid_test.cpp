// Range grids in PLY files: three encodings, the way they are wound, jumps, bad files.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "core/io/mesh_file.h"
#include "core/io/range_file.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::input_error;
using test::ScratchFolder;
using Corners = std::vector<std::array<std::uint32_t, 3>>;

template <class T>
std::string raw(T value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string header(const std::string& encoding, int columns, int rows, int vertices, int samples) {
  const auto n = [](int i) { return std::to_string(i); };
  return "ply\nformat " + encoding + " 1.0\nobj_info is_mesh 0\nobj_info num_cols " + n(columns) + "\nobj_info num_rows " + n(rows) +
         "\nelement vertex " + n(vertices) + "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n" +
         "property uchar green\nproperty uchar blue\nelement range_grid " + n(samples) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// 3 × 2 samples of which the last is missing; `down`: rows go toward −y.
std::string grid(const std::string& encoding, bool down = false, float last_z = 0) {
  const bool ascii = encoding == "ascii", big = encoding == "binary_big_endian";
  std::string out = header(encoding, 3, 2, 5, 6);
  for (int v = 0; v < 5; ++v) {
    const float x = static_cast<float>(v % 3), y = static_cast<float>(v / 3) * (down ? -1.0f : 1.0f), z = v == 4 ? last_z : 0;
    if (ascii)
      out += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " 255 0 51\n";
    else
      out += raw(x, big) + raw(y, big) + raw(z, big) + "\xFF" + std::string(1, '\0') + "\x33";
  }
  for (int s = 0; s < 6; ++s) {
    if (ascii)
      out += s < 5 ? "1 " + std::to_string(s) + "\n" : "0\n";
    else
      out += s < 5 ? "\x01" + raw(std::int32_t{s}, big) : std::string(1, '\0');
  }
  return out;
}

Corners corners_of(const Mesh& mesh) {
  Corners corners;
  for (const auto& f : mesh.faces) corners.push_back({f[0].index, f[1].index, f[2].index});
  return corners;
}

std::string error(const std::string& content) {
  const ScratchFolder folder;
  const auto path = folder.put("g.ply", content);
  const std::string message = input_error([&] { (void)read_mesh(path); });
  return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}

TEST_CASE("range grid: one content in three encodings is one mesh") {
  const ScratchFolder folder;
  const LoadedModel ascii = read_mesh(folder.put("g.ply", grid("ascii")));
  CHECK(ascii.mesh.vertex_count() == 5);
  CHECK(corners_of(ascii.mesh) == Corners{{0, 1, 4}, {0, 4, 3}, {4, 1, 2}});
  CHECK(ascii.mesh.colors[2] == Vec4f(1, 0, 0.2f, 1));
  CHECK(ascii.notes == std::vector<std::string>{"g.ply: a range grid of 3x2 samples, 5 of them there, as 3 triangles"});
  for (const char* encoding : {"binary_little_endian", "binary_big_endian"})
    CHECK(read_mesh(folder.put("g.ply", grid(encoding))).mesh == ascii.mesh);
}

TEST_CASE("range grid: faces look toward +z whichever way rows run") {
  const ScratchFolder folder;
  const Mesh mesh = read_mesh(folder.put("g.ply", grid("ascii", true))).mesh;
  CHECK(corners_of(mesh) == Corners{{0, 4, 1}, {0, 3, 4}, {4, 2, 1}});
}

TEST_CASE("range grid: a jump of more than four spacings, or as asked, is a border") {
  const ScratchFolder folder;
  const auto path = folder.put("g.ply", grid("ascii", false, 4.5f));
  CHECK(input_error([&] { (void)read_mesh(path); }) == "no error");
  CHECK(corners_of(read_mesh(path).mesh) == Corners{{0, 1, 3}});
  CHECK(read_range_ply(path, 5).mesh.face_count() == 3);
  CHECK(input_error([&] { (void)read_range_ply(path, 0); }) == path.string() + ": largest jump: expected a length above 0, got 0");
}

TEST_CASE("range grid: refusals") {
  const std::string vertex = "0 0 0 0 0 0\n";
  const std::string no_size =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "element range_grid 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0\n";
  CHECK(error(no_size) == ": element 'range_grid': expected lines 'obj_info num_cols N' and 'obj_info num_rows N' in the header, got none");
  CHECK(error(header("ascii", 2, 2, 1, 3) + vertex + "0\n0\n0\n") ==
        ": element 'range_grid': expected 2 x 2 rows, at most 67108864, got 3");
  CHECK(error(header("ascii", 1 << 30, 4, 1, 1) + vertex + "0\n").find("expected 1073741824 x 4 rows") != std::string::npos);
  CHECK(error(header("ascii", 0, 2, 1, 3) + vertex) == ":4: num_cols: expected a count from 1, got '0'");
  CHECK(error(header("ascii", 1, 1, 1, 1) + vertex + "2 0 0\n") == ":17: range_grid 0: expected no or one vertex, got 2");
  CHECK(error(header("ascii", 1, 1, 1, 1) + vertex + "1 1\n") == ":17: range_grid 0: vertex index expected 0 to 0, got 1");
  CHECK(error(header("ascii", 1, 1, 1, 1) + vertex + "1 -1\n") == ":17: range_grid 0: vertex index expected 0 to 0, got -1");
  CHECK(error(header("ascii", 1, 1, 1, 1) + vertex + "1 0\n") ==
        ": a range grid of 1x1: expected neighbours without a jump in depth, got none");
  CHECK(error(header("ascii", 1, 1, 1, 1) + "0 0 nan 0 0 0\n1 0\n").find("finite") != std::string::npos);
  CHECK(error(header("ascii", 100, 100, 1, 10000) + vertex).find("claims 10000 rows") != std::string::npos);
}

TEST_CASE("range grid: cut short anywhere, a file is refused") {
  for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string whole = grid(encoding);
    for (std::size_t size = 1; size + 2 < whole.size(); ++size) {
      CAPTURE(size);
      CHECK(error(whole.substr(0, size)) != "no error");
    }
  }
}

}  // namespace
}  // namespace etalon::io
