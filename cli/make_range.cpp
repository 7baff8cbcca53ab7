#include "cli/make_range.h"

#include "cli/usage_error.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "core/io/range_file.h"
#include "core/procedural/test_images.h"

namespace etalon::cli {
namespace {

namespace fs = std::filesystem;

procedural::RangeKind kind_named(const std::string& name) {
  for (const procedural::RangeKind kind : procedural::range_kinds())
    if (procedural::range_name(kind) == name) return kind;
  throw UsageError("make: range: unknown --kind " + name);
}

Image image_named(const std::string& name) { return name == "ramp" ? procedural::make_ramp() : procedural::make_chessboard(); }

}  // namespace

MadeRange make_range(const RangeRequest& request) {
  const bool depths = io::names_range_image(request.output);
  MadeRange made;
  made.kind = request.kind.value_or("telephone");
  made.image = request.image.value_or(depths ? "" : "chessboard");
  made.range = procedural::make_range_scan(kind_named(made.kind));
  const Image image = made.image.empty() ? Image() : image_named(made.image);
  made.mesh = triangulate(made.range, image.bytes());
  made.outputs = {request.output};
  if (depths && !made.image.empty()) {
    const fs::path path = request.output;
    made.outputs.push_back(path.parent_path() / (path.stem().string() + "_color.png"));
  } else if (!depths) {
    made.outputs = io::mesh_output_files(request.output);
  }
  return made;
}

void write_range(const MadeRange& made) {
  const fs::path& path = made.outputs.front();
  if (!io::names_range_image(path)) return io::write_mesh(path, made.mesh);
  if (!made.image.empty()) io::write_image(made.outputs.back(), image_named(made.image));
  io::write_range_image(path, made.range, procedural::kRangeStep);
}

}  // namespace etalon::cli
