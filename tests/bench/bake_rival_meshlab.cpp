// MeshLab's own way from a coloured scan to a textured simple mesh.
#include <fmt/format.h>

#include <sstream>

#include "core/base/error.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/simplify/simplify.h"
#include "tests/bench/bake_bench.h"
#include "tests/bench/child.h"

namespace etalon::bench {
namespace {

constexpr int kMap = 512;
constexpr const char* kMark = "etalon-time";

// What MeshLab's dialogs begin with, but for the map's size: borders of 2 texels, smaller triangles where faces are small, what is farther than 2 %
// of the diagonal is left out, and the texels of no triangle are filled from their neighbours.
std::string script(double most) {
  return fmt::format(R"xml(<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Parametrization: Trivial Per-Triangle">
  <Param type="RichInt" value="0" name="sidedim"/>
  <Param type="RichInt" value="{0}" name="textdim"/>
  <Param type="RichInt" value="2" name="border"/>
  <Param type="RichEnum" value="1" enum_cardinality="2" enum_val0="Basic" enum_val1="Space-optimizing" name="method"/>
 </filter>
 <filter name="Transfer: Vertex Attributes to Texture (1 or 2 meshes)">
  <Param type="RichMesh" value="0" name="sourceMesh"/>
  <Param type="RichMesh" value="1" name="targetMesh"/>
  <Param type="RichEnum" value="0" enum_cardinality="4"
   enum_val0="Vertex Color" enum_val1="Vertex Normal" enum_val2="Vertex Quality" enum_val3="Texture Color" name="AttributeEnum"/>
  <Param type="RichAbsPerc" value="{1}" min="0" max="{2}" name="upperBound"/>
  <Param type="RichString" value="baked.png" name="textName"/>
  <Param type="RichInt" value="{0}" name="textW"/>
  <Param type="RichInt" value="{0}" name="textH"/>
  <Param type="RichBool" value="false" name="overwrite"/>
  <Param type="RichBool" value="true" name="assign"/>
  <Param type="RichBool" value="true" name="pullpush"/>
 </filter>
</FilterScript>
)xml",
                     kMap, most / 50, most);
}

struct Seconds {
  double wall = 0, cpu = 0;
};

/// Of the last words alone, not of what stands before them. UnavailableError where they cannot be run.
Seconds timed(std::vector<std::string> before, const std::vector<std::string>& program, const std::filesystem::path& errors) {
  for (const std::string& word :
       {std::string("bash"), std::string("-c"), fmt::format("TIMEFORMAT='{} %R %U %S'; time \"$@\"", kMark), std::string("bash")})
    before.push_back(word);
  before.insert(before.end(), program.begin(), program.end());
  const ChildCost cost = run_program(before, errors);
  const std::string said = cost.output + std::string(io::read_file(errors).text());
  const auto at = said.rfind(kMark);
  if (cost.exit_code != 0 || at == std::string::npos)
    throw UnavailableError(fmt::format("{} ended with exit code {}", program[0], cost.exit_code));
  std::istringstream numbers(said.substr(at + std::string(kMark).size()));
  double wall = 0, user = 0, system = 0;
  numbers >> wall >> user >> system;
  return {wall, user + system};
}

}  // namespace

BakeRivalResult measure_bake_rival(const BakeScan& scan, const std::string& program, int rounds) {
  BakeRivalResult result{.title = scan.title};
  const ScratchDirectory scratch;
  const auto path = [&](const char* name) { return (scratch / name).string(); };
  io::write_mesh(path("high.ply"), *scan.mesh);
  io::write_mesh(path("low.ply"), simplify::simplify_mesh(*scan.mesh, {.target_faces = kBakedFaces}).mesh);
  io::write_file(path("bake.mlx"), script(bounding_box(*scan.mesh).diagonal()));
  try {
    for (int round = 0; round < rounds; ++round) {
      const auto baked = [&](std::vector<std::string> options, const char* output) {
        std::vector<std::string> command{
            program, "bake",      path("high.ply"), "--faces", fmt::to_string(kBakedFaces), "--size", fmt::format("{0}x{0}", kMap),
            "-o",    path(output)};
        command.insert(command.end(), options.begin(), options.end());
        return timed({"timeout", "300"}, command, scratch / "errors");
      };
      const Seconds ours = baked({}, "ours.obj"), sampled = baked({"--fill", "sampled", "--gutter", "0"}, "sampled.obj");
      const Seconds theirs = timed(
          {"env", "QT_QPA_PLATFORM=offscreen", "timeout", "300", "xvfb-run", "-a"},
          {"meshlabserver", "-i", path("high.ply"), "-i", path("low.ply"), "-s", path("bake.mlx"), "-o", path("baked.obj"), "-m", "wt"},
          scratch / "errors");
      result.our_wall.push_back(ours.wall), result.our_cpu.push_back(ours.cpu);
      result.sampled_wall.push_back(sampled.wall), result.sampled_cpu.push_back(sampled.cpu);
      result.meshlab_wall.push_back(theirs.wall), result.meshlab_cpu.push_back(theirs.cpu);
    }
    const DenseViews dense(*scan.mesh);
    const auto texture = [&](const char* name) { return std::make_shared<const Image>(io::read_image(path(name))); };
    result.rows.push_back(dense.compare("etalon bake, nearest", io::read_mesh(path("ours.obj")).mesh, texture("ours_texture.png")));
    io::write_file(path("baked.obj.mtl"), "newmtl material_0\n");  // it names the texture by an absolute path
    const Mesh theirs = io::read_mesh(path("baked.obj")).mesh;
    for (const Filter filter : {Filter::nearest, Filter::linear})
      result.rows.push_back(dense.compare(fmt::format("MeshLab, {}", to_string(filter)), theirs, texture("baked.png"), filter));
    const Mesh sampled = io::read_mesh(path("sampled.obj")).mesh;
    for (const Filter filter : {Filter::nearest, Filter::linear})
      result.rows.push_back(dense.compare(fmt::format("etalon bake --fill sampled --gutter 0, {}", to_string(filter)), sampled,
                                          texture("sampled_texture.png"), filter));
  } catch (const UnavailableError& error) {
    result.skipped = error.what();
  }
  return result;
}

}  // namespace etalon::bench
