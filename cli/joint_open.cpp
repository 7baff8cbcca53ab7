#include "cli/joint_open.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/call_files.h"
#include "cli/interrupt.h"
#include "core/base/error.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/joint/joint_stream.h"
#include "raster/cpu_renderer.h"
#include "validation/joint/terrain_problem.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using validation::grouped;

joint::DecodedJoint decoded(const std::string& path, const io::FileBytes& file) {
  try {
    return joint::decode_joint(std::as_bytes(std::span(file.text())));
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

}  // namespace

bool is_joint_stream(const std::string& path) { return joint::has_joint_signature(std::as_bytes(std::span(io::read_file(path).text()))); }

void open_joint_stream(const std::string& path, const std::string& folder_name, Console& console) {
  const std::filesystem::path folder(folder_name);
  CallFiles files;
  files.add_input(path, "the stream");
  for (const char* name : {"model.obj", "model.mtl", "model_texture.png", "picture.png"}) files.add_output((folder / name).string(), "-o");
  const io::FileBytes file = io::read_file(path);
  const joint::DecodedJoint opened = decoded(path, file);
  const Mesh mesh = terrain::level_mesh(opened.terrain.field, opened.terrain.levels, opened.pair.mesh);
  Image picture;
  if (opened.terrain.view && opened.texture.width() > 1 && opened.texture.height() > 1) {
    raster::CpuRenderer exact;
    const validation::DrawnCoordinates drawn = validation::draw_coordinates(exact, mesh, validation::picture_frame(*opened.terrain.view));
    picture = validation::without_alpha(validation::CoordinatePicture(drawn, opened.texture.width(), opened.texture.height())
                                            .picture(validation::opaque_rgba(opened.texture)));
  }
  {
    const FinishWriting writing;
    std::filesystem::create_directories(folder);
    io::write_mesh(folder / "model.obj", mesh, {{.name = "model", .texture_path = {}, .texture = opened.texture}});
    if (!picture.empty()) io::write_image(folder / "picture.png", picture);
  }
  console.line(fmt::format("{}: mesh {} of {}, {} vertices; texture {} of {}, {}x{} texels", path, opened.pair.mesh + 1, opened.mesh_levels,
                           grouped(mesh.vertex_count()), opened.pair.texture + 1, opened.texture_levels, opened.texture.width(),
                           opened.texture.height()));
  if (!opened.is_complete)
    console.line(
        fmt::format("note: a prefix: {} of its {} bytes hold whole segments", grouped(opened.bytes_used), grouped(file.text().size())));
  console.line("wrote " + folder_name);
}

}  // namespace etalon::cli
