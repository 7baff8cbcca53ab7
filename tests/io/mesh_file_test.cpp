// The format-independent part: extensions and contents, round trips through every format, refusals to write.
#include "core/io/mesh_file.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/io/image_file.h"
#include "tests/io/mesh_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::check_same_surface;
using test::Colors;
using test::input_error;
using test::ScratchFolder;
using test::seam_mesh;
using test::write_error;

TEST_CASE("mesh file: every kind of mesh comes back bit by bit from every format") {
  const ScratchFolder folder;
  std::uint64_t seed = 1;
  for (const char* name : {"m.obj", "m.ply", "m.glb"})
    for (const bool has_uv : {false, true})
      for (const Colors colors : {Colors::none, Colors::bytes, Colors::reals})
        for (const bool alpha : {false, true}) {
          CAPTURE(name);
          const Mesh mesh = seam_mesh(has_uv, colors, alpha, seed++);
          write_mesh(folder / name, mesh);
          const LoadedModel back = read_mesh(folder / name);
          check_same_surface(back.mesh, mesh);
          CHECK(back.materials.empty());
          CHECK(back.notes.empty());
        }
}

TEST_CASE("mesh file: no colour and no coordinate is lost on the way from any format through any other to any third") {
  const ScratchFolder folder;
  std::uint64_t seed = 100;
  for (const char* first : {"a.obj", "a.ply", "a.glb"})
    for (const char* second : {"b.obj", "b.ply", "b.glb"})
      for (const char* third : {"c.obj", "c.ply", "c.glb"})
        for (const Colors colors : {Colors::bytes, Colors::reals}) {
          CAPTURE(first);
          CAPTURE(second);
          CAPTURE(third);
          const Mesh mesh = seam_mesh(true, colors, true, seed++);
          write_mesh(folder / first, mesh);
          write_mesh(folder / second, read_mesh(folder / first).mesh);
          write_mesh(folder / third, read_mesh(folder / second).mesh);
          check_same_surface(read_mesh(folder / third).mesh, mesh);
        }
}

TEST_CASE("mesh file: glTF rounds small v once, the other formats do not") {
  const ScratchFolder folder;
  Mesh mesh = seam_mesh(true, Colors::none, false, 1);
  mesh.wedges[0].uv.y = 0.1f;
  for (const char* name : {"m.obj", "m.ply"}) {
    write_mesh(folder / name, mesh);
    CHECK(read_mesh(folder / name).mesh.wedge(FaceId(0u), 0).uv.y == 0.1f);
  }
  write_mesh(folder / "m.glb", mesh);
  CHECK(read_mesh(folder / "m.glb").mesh.wedge(FaceId(0u), 0).uv.y == 1.0f - (1.0f - 0.1f));
}

TEST_CASE("mesh file: materials and textures come back from every format") {
  const ScratchFolder folder;
  const LoadedModel model = test::textured_model();
  for (const char* name : {"my model.obj", "my model.ply", "my model.glb"}) {
    CAPTURE(name);
    write_mesh(folder / name, model.mesh, model.materials);
    const LoadedModel back = read_mesh(folder / name);
    check_same_surface(back.mesh, model.mesh);
    REQUIRE(back.materials.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(load_texture(back.materials[i]) == model.materials[i].texture);
      if (name != std::string("my model.ply")) CHECK(back.materials[i].name == model.materials[i].name);
    }
    CHECK(back.notes.empty());
    CHECK(back.side_files.size() == (name == std::string("my model.obj") ? 1 : 0));
    for (const std::filesystem::path& file : mesh_output_files(folder / name, model.materials)) CHECK(std::filesystem::exists(file));
  }
}

TEST_CASE("mesh file: the files that are written, and no picture called like the model") {
  const ScratchFolder folder;
  LoadedModel model = test::textured_model();
  model.mesh.face_materials = {0, 0, 0};
  model.materials = {{"a", {}, test::random_image(3, 3, kRgb8, 9)}};
  using Paths = std::vector<std::filesystem::path>;
  CHECK(mesh_output_files("d/m.obj", model.materials) == Paths{"d/m.obj", "d/m.mtl", "d/m_texture.png"});
  CHECK(mesh_output_files("m.PLY", model.materials) == Paths{"m.PLY", "m_texture.png"});
  CHECK(mesh_output_files("m.glb", model.materials) == Paths{"m.glb"});
  CHECK(mesh_output_files("m.obj") == Paths{"m.obj"});
  write_mesh(folder / "m.obj", model.mesh, model.materials);
  CHECK_FALSE(std::filesystem::exists(folder / "m.png"));
  CHECK(test::content_of(folder / "m.mtl") == "newmtl a\nKd 1 1 1\nmap_Kd m_texture.png\n");
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / ".")) count += entry.is_regular_file();
  CHECK(count == 3);
}

TEST_CASE("mesh file: a texture in a file is named relative to the model, and embedded by GLB") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "textures");
  std::filesystem::create_directories(folder / "out");
  const Image texture = test::random_image(3, 3, kRgb8, 9);
  write_image(folder / "textures/t.png", texture);
  LoadedModel model = test::textured_model();
  model.mesh.face_materials = {0, 0, 0};
  model.materials = {{"a", folder / "textures/t.png", {}}};
  for (const char* name : {"out/m.obj", "out/m.ply", "out/m.glb"}) {
    write_mesh(folder / name, model.mesh, model.materials);
    CHECK(load_texture(read_mesh(folder / name).materials.at(0)) == texture);
  }
  CHECK(test::content_of(folder / "out/m.mtl") == "newmtl a\nKd 1 1 1\nmap_Kd ../textures/t.png\n");
  model.materials[0].texture_path = folder / "out/m.mtl";
  CHECK(write_error([&] { write_mesh(folder / "out/n.glb", model.mesh, model.materials); }).find("GLB holds PNG or JPEG") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "out/n.glb"));
}

TEST_CASE("mesh file: names that OBJ cannot carry are changed, and stay different") {
  const ScratchFolder folder;
  LoadedModel model = test::textured_model();
  model.materials = {{"", {}, {}}, {" a\nb\\", {}, {}}, {"a_b_", {}, {}}};
  write_mesh(folder / "m.obj", model.mesh, model.materials);
  const LoadedModel back = read_mesh(folder / "m.obj");
  REQUIRE(back.materials.size() == 3);
  CHECK(back.materials[0].name == "material_0");
  CHECK(back.materials[1].name == "a_b_");
  CHECK(back.materials[2].name == "a_b__2");
}

TEST_CASE("mesh file: the extension must be known, the content wins with a note") {
  const ScratchFolder folder;
  const Mesh mesh = seam_mesh(true, Colors::none, false, 1);
  write_mesh(folder / "m.PLY", mesh);
  std::filesystem::copy(folder / "m.PLY", folder / "n.obj");
  std::filesystem::copy(folder / "m.PLY", folder / "n.xyz");
  const LoadedModel model = read_mesh(folder / "n.obj");
  check_same_surface(model.mesh, mesh);
  CHECK(model.notes == std::vector<std::string>{"n.obj: read as PLY, which is what the file holds"});
  CHECK(input_error([&] { (void)read_mesh(folder / "n.xyz"); }) ==
        (folder / "n.xyz").string() + ": mesh format: expected .obj, .ply, .stl, .glb or .gltf, got '.xyz'");
  CHECK(input_error([&] { (void)read_mesh(folder / "none.obj"); }) == (folder / "none.obj").string() + ": No such file or directory");
  std::filesystem::create_directory(folder / "d.obj");
  CHECK(input_error([&] { (void)read_mesh(folder / "d.obj"); }) == (folder / "d.obj").string() + ": expected a file, got a folder");
}

TEST_CASE("mesh file: what cannot be written is refused and no file appears") {
  const ScratchFolder folder;
  const Mesh good = seam_mesh(true, Colors::bytes, false, 1);
  const auto error = [&](const char* name, const Mesh& mesh, const std::vector<Material>& materials = {}) {
    const std::string message = write_error([&] { write_mesh(folder / name, mesh, materials); });
    CHECK(message.starts_with((folder / name).string() + ": cannot write: "));
    return message.substr(std::min(message.size(), (folder / name).string().size() + 16));
  };
  const auto changed = [&](auto&& change) {
    Mesh mesh = good;
    change(mesh);
    return mesh;
  };
  CHECK(error("m.stl", good) == "mesh format: expected .obj, .ply or .glb, got '.stl'");
  CHECK(error("m.gltf", good) == "mesh format: expected .obj, .ply or .glb, got '.gltf'");
  CHECK(error("m.obj", changed([](Mesh& m) { m.faces.clear(); })) == "the mesh has no faces");
  CHECK(error("m.obj", changed([](Mesh& m) { m.colors.pop_back(); })) == "colours: expected 5, got 4");
  CHECK(error("m.obj", changed([](Mesh& m) { m.colors[0].x = 2; })) == "colours: expected 0 to 1, got 2");
  CHECK(error("m.obj", changed([](Mesh& m) { m.positions[1].y = std::numeric_limits<float>::infinity(); })) == "expected finite positions");
  CHECK(error("m.obj", changed([](Mesh& m) { m.wedges[1].uv.y = -std::numeric_limits<float>::infinity(); })) ==
        "expected finite texture coordinates");
  CHECK(error("m.obj", changed([](Mesh& m) { m.wedges[1].vertex = VertexId(5u); })) == "wedge: vertex expected below 5, got 5");
  CHECK(error("m.obj", changed([](Mesh& m) { m.faces[1][1] = WedgeId(6u); })) == "face: wedge expected below 6, got 6");
  CHECK(error("m.obj", changed([](Mesh& m) { m.face_materials = {0}; })) == "face materials: expected 2, got 1");
  CHECK(error("m.obj", changed([](Mesh& m) { m.face_materials = {0, 1}; }), {{"a", {}, {}}}) == "face material: expected below 1, got 1");
  CHECK(error("m.obj", good, {{"a", {}, Image(1, 1, kRg32f)}}) == "PNG holds r, rgb or rgba of unorm8 or unorm16, got rg float32");
  CHECK(error("none/m.obj", good) == "No such file or directory");
  CHECK(folder.entry_count() == 0);
}

}  // namespace
}  // namespace etalon::io
