// etalon info on drawings, depths and STL, and the same files through the verbs that use them.
#include <cstring>
#include <memory>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "core/io/draws_file.h"
#include "core/io/image_file.h"
#include "raster/cpu_renderer.h"
#include "tests/cli/run_command.h"
#include "tests/cli/schema_validator.h"
#include "validation/verify/draw_list_hash.h"

using namespace etalon;
using namespace etalon::test;
using nlohmann::json;

namespace {

json info(const ScratchFolder& folder, const std::string& file) {
  const CommandResult result = run_etalon({"info", file, "--json", "-"}, {.folder = folder.path()});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const json document = json::parse(result.out);
  const json schema = json::parse(read_text(std::string(ETALON_SCHEMAS) + "/info.json"));
  for (const std::string& violation : schema_violations(schema, document)) FAIL_CHECK(violation);
  return document;
}

std::string spoken(const ScratchFolder& folder, const std::string& file) {
  return run_etalon({"info", file}, {.folder = folder.path()}).out;
}

// A frame of 32 × 32 texels: a texture looked up through a map that transposes it, and a triangle of vertex colours before it.
struct IndexedDrawing {
  DrawList list;
  Frame frame;
};

IndexedDrawing indexed_drawing() {
  IndexedDrawing drawing;
  Image texture(8, 8, kRgba8), map(16, 16, kRg32f);
  for (std::size_t n = 0; n < texture.bytes().size(); ++n) texture.bytes()[n] = static_cast<std::byte>(n * 37 % 256);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      map.channels<float>(x, y)[0] = (static_cast<float>(y) + 0.5f) / 16;
      map.channels<float>(x, y)[1] = (static_cast<float>(x) + 0.5f) / 16;
    }
  const auto at = [](int x, int y, float u, float v, float z) {
    return RasterVertex{.x = x * 256, .y = y * 256, .z = z, .uv = {u, v}, .color = {u, v, 0.5f, 1}};
  };
  drawing.list.vertices = {at(0, 0, 0, 0, 0.5f),  at(32, 0, 1, 0, 0.5f),  at(32, 32, 1, 1, 0.5f), at(0, 32, 0, 1, 0.5f),
                           at(2, 2, 0, 0, 0.25f), at(12, 2, 1, 0, 0.25f), at(2, 12, 0, 1, 0.25f)};
  drawing.list.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
  drawing.list.draws = {
      {.triangle_count = 2, .shading = Shading::indexed, .texture = 1, .sampler = {.wrap_u = Wrap::repeat}, .indexing_map = 0},
      {.first_triangle = 2, .triangle_count = 1}};
  drawing.list.images = {std::make_shared<const Image>(map), std::make_shared<const Image>(texture)};
  drawing.frame.width = drawing.frame.height = 32;
  drawing.frame.targets = {{.content = TargetContent::color, .format = kRgba8}};
  return drawing;
}

template <class T>
void append(std::string& text, T value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Two right triangles that share a diagonal, binary, with a header that says "solid".
std::string square_stl() {
  std::string text = std::string("solid square").append(68, '\0');
  append(text, std::uint32_t{2});
  for (const auto& facet : {std::array{0.f, 0.f, 1.f, 0.f, 1.f, 1.f}, {0.f, 0.f, 1.f, 1.f, 0.f, 1.f}}) {
    text.append(12, '\0');
    for (std::size_t k = 0; k < 3; ++k) append(text, facet[2 * k]), append(text, facet[2 * k + 1]), append(text, 0.f);
    text.append(2, '\0');
  }
  return text;
}

}  // namespace

TEST_CASE("info FILE.draws: counts, state, draws, images and the hash; render gives the picture of the list through its map") {
  const ScratchFolder folder;
  const IndexedDrawing drawing = indexed_drawing();
  io::write_draws(folder.path() / "d.draws", drawing.list, drawing.frame);
  const json document = info(folder, "d.draws");
  CHECK(document["kind"] == "draws");
  const json& draws = document["draws"];
  CHECK(draws["vertices"] == 7);
  CHECK(draws["triangles"] == 3);
  CHECK(draws["width"] == 32);
  CHECK(draws["state"]["subtexel_bits"] == 8);
  CHECK(draws["state"]["fill_rule"] == "left_ymin");
  CHECK(draws["draws"][0]["shading"] == "indexed");
  CHECK(draws["draws"][0]["indexing_map"] == 0);
  CHECK(draws["draws"][0]["texture"] == 1);
  CHECK(draws["draws"][0]["sampler"]["wrap_u"] == "repeat");
  CHECK(draws["draws"][1]["shading"] == "vertex_color");
  CHECK_FALSE(draws["draws"][1].contains("texture"));
  REQUIRE(draws["images"].size() == 2);
  CHECK(draws["images"][0]["sha256"] == drawing.list.images[0]->sha256());
  CHECK(draws["images"][1]["format"] == "rgba unorm8");
  CHECK(draws["draw_list_sha256"] == validation::draw_list_sha256(drawing.list));
  const std::string text = spoken(folder, "d.draws");
  CHECK(text.find("draws: 3 triangles of 7 vertices in 2 draws, frame 32x32") != std::string::npos);
  CHECK(text.find("draw 0: 2 triangles, indexed image 1 (nearest repeat clamp) through map 0 (nearest clamp clamp)") != std::string::npos);

  REQUIRE(run_etalon({"render", "d.draws", "-o", "d.png"}, {.folder = folder.path()}).exit_code == 0);
  raster::CpuRenderer exact;
  CHECK(io::read_image(folder.path() / "d.png") == exact.render(drawing.list, drawing.frame).front());
  CHECK(run_etalon({"diff", "d.png", "d.png", "--device", "contract", "--draws", "d.draws"}, {.folder = folder.path()}).exit_code == 0);

  // What the drawing names is part of it.
  std::filesystem::remove(folder.path() / "d.1.png");
  check_refused({"info", "d.draws"}, 4, folder, "d.1.png");
  folder.file("cut.draws", read_text(folder.path() / "d.draws").substr(0, 200));
  check_refused({"info", "cut.draws"}, 4, folder, "cut.draws");
}

TEST_CASE("info: one channel of 16 bits or reals is depths or heights, and says from where to where") {
  const ScratchFolder folder;
  REQUIRE(run_etalon({"make", "range", "-o", "r.exr"}, {.folder = folder.path()}).exit_code == 0);
  const json range = info(folder, "r.exr");
  CHECK(range["kind"] == "exr");
  CHECK(range["depths"]["samples"].get<int>() > 100);
  CHECK(range["depths"]["lowest"] < range["depths"]["highest"]);
  CHECK(spoken(folder, "r.exr").find("depths of a range image (etalon bake") != std::string::npos);

  Image depths(3, 1, {ChannelType::unorm16, 1});
  depths.channels<std::uint16_t>(1, 0)[0] = 700, depths.channels<std::uint16_t>(2, 0)[0] = 500;
  io::write_image(folder.path() / "d.png", depths);
  CHECK(info(folder, "d.png")["depths"] == json::parse(R"({"samples":2,"none":1,"lowest":500,"highest":700})"));
  io::write_image(folder.path() / "empty.png", Image(3, 1, {ChannelType::unorm16, 1}));
  CHECK(info(folder, "empty.png")["depths"]["lowest"].is_null());
  io::write_image(folder.path() / "grey.png", Image(3, 1, {ChannelType::unorm8, 1}));
  CHECK_FALSE(info(folder, "grey.png").contains("depths"));
  io::write_image(folder.path() / "colour.png", Image(3, 1, {ChannelType::unorm16, 3}));
  CHECK_FALSE(info(folder, "colour.png").contains("depths"));

  folder.file("grid.ply",
              "ply\nformat ascii 1.0\nobj_info num_cols 2\nobj_info num_rows 2\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nelement range_grid 4\nproperty list uchar int vertex_indices\nend_header\n"
              "0 0 0\n1 0 0\n0 1 0\n1 1 0\n1 0\n1 1\n1 2\n1 3\n");
  CHECK(info(folder, "grid.ply")["notes"][0].get<std::string>().find("a range grid of 2x2 samples") != std::string::npos);
}

TEST_CASE("STL through the verbs: a closed surface is closed, and can be simplified, measured and drawn") {
  const ScratchFolder folder;
  folder.file("square.stl", square_stl());
  const json square = info(folder, "square.stl");
  CHECK(square["mesh"]["faces"] == 2);
  CHECK(square["mesh"]["vertices"] == 4);
  CHECK(square["mesh"]["edges"] == 5);
  CHECK(run_etalon({"metro", "square.stl", "square.stl", "--samples", "100"}, {.folder = folder.path()}).exit_code == 0);
  CHECK(run_etalon({"render", "square.stl", "--size", "16", "-o", "s.png"}, {.folder = folder.path()}).exit_code == 0);
  CHECK(run_etalon({"simplify", "square.stl", "--faces", "2", "-o", "s.ply"}, {.folder = folder.path()}).exit_code == 0);
  CHECK(info(folder, "s.ply")["mesh"]["vertices"] == 4);
  folder.file("cut.stl", square_stl().substr(0, 100));
  check_refused({"info", "cut.stl"}, 4, folder, "the file ends early");
  check_refused({"simplify", "cut.stl", "--faces", "1", "-o", "c.ply"}, 4, folder, "the file ends early");
}
