#include "cli/info_command.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/attribution.h"
#include "cli/call_files.h"
#include "cli/cell_report.h"
#include "cli/draws_input.h"
#include "cli/exit_code.h"
#include "cli/info_findings.h"
#include "cli/model_input.h"
#include "cli/work_bytes.h"
#include "core/adapt/cell_chunks.h"
#include "core/base/error.h"
#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/mesh/mesh_validation.h"
#include "core/progressive/epm_format.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

struct Options {
  std::string path;
  CommonOptions common;
};

Json to_json(const Defect& defect) { return {{"count", defect.count}, {"first", defect.first}}; }
Json to_json(const Vec2f& v) { return {v.x, v.y}; }
Json to_json(const Vec3f& v) { return {v.x, v.y, v.z}; }

Json uv_json(const MeshReport& report) {
  return {{"charts", report.chart_count},
          {"largest_chart_faces", report.largest_chart_faces},
          {"seam_vertices", report.seam_vertex_count},
          {"min", to_json(report.uv_min)},
          {"max", to_json(report.uv_max)},
          {"negative_faces", report.negative_uv_faces},
          {"degenerate_faces", to_json(report.degenerate_uv_faces)},
          {"folds", to_json(report.folds)},
          {"mirrored_charts", to_json(report.mirrored_charts)},
          {"mirrored_chart_faces", report.mirrored_chart_faces},
          {"tiny_charts", to_json(report.tiny_charts)},
          {"outside", to_json(report.uv_outside)},
          {"overlaps", to_json(report.uv_overlaps)},
          {"overlap_share", report.uv_overlap_share},
          {"coverage", report.uv_coverage}};
}

Json mesh_json(const Mesh& mesh, const MeshReport& report) {
  const BoundingBox box = bounding_box(mesh);
  Json object = {{"vertices", report.vertex_count},
                 {"wedges", report.wedge_count},
                 {"faces", report.face_count},
                 {"edges", report.edge_count},
                 {"components", report.component_count},
                 {"boundary_loops", report.boundary_loop_count},
                 {"euler_characteristic", report.euler_characteristic},
                 {"genus", report.genus ? Json(*report.genus) : Json(nullptr)},
                 {"closed", report.closed()},
                 {"manifold", report.manifold()},
                 {"oriented", report.oriented()},
                 {"vertex_colors", !mesh.colors.empty()},
                 {"bounding_box", {{"lo", to_json(box.lo)}, {"hi", to_json(box.hi)}}},
                 {"unreferenced_vertices", to_json(report.unreferenced_vertices)},
                 {"boundary_edges", to_json(report.boundary_edges)},
                 {"non_manifold_edges", to_json(report.non_manifold_edges)},
                 {"non_manifold_vertices", to_json(report.non_manifold_vertices)},
                 {"inconsistent_edges", to_json(report.inconsistent_edges)},
                 {"duplicate_faces", to_json(report.duplicate_faces)},
                 {"degenerate_faces", to_json(report.degenerate_faces)}};
  object["uv"] = report.has_uv ? uv_json(report) : Json(nullptr);
  return object;
}

Finding examine_mesh(const std::string& path, CallFiles& files) {
  const io::LoadedModel model = io::read_mesh(path, kMinValidateBytesPerFace);
  add_side_files(files, model);
  const MeshReport report = validate_mesh(model.mesh);
  Finding finding;
  for (const std::string& line : report.to_lines()) finding.lines.push_back(line);
  Json materials = Json::array();
  for (const io::Material& material : model.materials) {
    const Image texture = io::load_texture(material);
    Json entry = {{"name", material.name}};
    entry["texture"] = texture.empty() ? Json(nullptr)
                                       : Json{{"width", texture.width()},
                                              {"height", texture.height()},
                                              {"format", to_string(texture.format())},
                                              {"sha256", texture.sha256()}};
    finding.lines.push_back(fmt::format(
        "material '{}': {}", material.name,
        texture.empty() ? "no texture" : fmt::format("texture {}x{} {}", texture.width(), texture.height(), to_string(texture.format()))));
    materials.push_back(std::move(entry));
  }
  for (const std::string& note : model.notes) finding.lines.push_back("note: " + note);
  finding.members["kind"] = "mesh";
  finding.members["mesh"] = mesh_json(model.mesh, report);
  finding.members["materials"] = std::move(materials);
  finding.members["notes"] = model.notes;
  return finding;
}

Finding examine_image(const std::string& path) {
  const Image image = io::read_image(path);
  Finding finding;
  finding.lines.push_back(fmt::format("image {}x{} {}", image.width(), image.height(), to_string(image.format())));
  finding.members["kind"] = "image";
  finding.members["image"] = {
      {"width", image.width()}, {"height", image.height()}, {"format", to_string(image.format())}, {"sha256", image.sha256()}};
  add_depths(finding, image);
  return finding;
}

Finding examine_exr(const std::string& path) {
  const io::ExrContent content = io::read_exr(path);
  Finding finding;
  Json channels = Json::array();
  const Image& first = content.layers.front().image;
  finding.lines.push_back(fmt::format("image {}x{} OpenEXR", first.width(), first.height()));
  for (const io::ExrLayer& layer : content.layers) {
    const std::string type = to_string(layer.image.format().type);
    for (const std::string& name : layer.channel_names) {
      finding.lines.push_back(fmt::format("channel {} {}", name, type));
      channels.push_back({{"name", name}, {"type", type}, {"sha256", layer.image.sha256()}});
    }
  }
  Json attributes = Json::object();
  for (const auto& [name, text] : content.attributes) {
    finding.lines.push_back(fmt::format("{}: {}", name, text));
    attributes[name] = text;
  }
  finding.members["kind"] = "exr";
  finding.members["image"] = {{"width", first.width()}, {"height", first.height()}};
  finding.members["channels"] = std::move(channels);
  finding.members["attributes"] = std::move(attributes);
  if (content.layers.size() == 1) add_depths(finding, first);
  return finding;
}

Finding examine_progressive(const std::string& path) {
  const io::FileBytes file = io::read_file(path);
  progressive::EpmContent content = naming_the_model(path, [&] { return progressive::decode_epm(file.bytes()); });
  std::optional<CellReport> cells;
  if (const auto stored = naming_the_model(path, [&] { return adapt::decode_cells(content); }))
    cells = {adapt::cell_statistics(*stored), adapt::cell_chunk_bytes(content.extras)};
  const progressive::ProgressiveData& data = content.mesh.data();
  const std::size_t splits = content.mesh.split_count();
  Finding finding;
  finding.lines.push_back(fmt::format("progressive mesh: {} to {} faces, {} to {} vertices in {} splits",
                                      grouped(content.mesh.face_count_at(0)), grouped(content.mesh.face_count_at(splits)),
                                      grouped(data.base_vertices), grouped(data.positions.size()), grouped(splits)));
  finding.lines.push_back(fmt::format("texture coordinates: {}; colours: {}; materials: {}", data.has_uv ? "yes" : "no",
                                      data.has_colors ? "yes" : "no", data.has_materials ? "yes" : "no"));
  if (cells)
    for (const std::string& line : cell_lines(*cells)) finding.lines.push_back(line);
  else if (data.has_uv)
    finding.lines.push_back("cells for texture adaptation: none");
  if (!content.complete)
    finding.lines.push_back(fmt::format("cut short: {} of {} splits are there", grouped(splits), grouped(content.splits_in_whole)));
  finding.members["kind"] = "progressive";
  finding.members["progressive"] = {{"version", progressive::kEpmVersion},
                                    {"complete", content.complete},
                                    {"records", splits},
                                    {"records_in_whole", content.splits_in_whole},
                                    {"faces_base", content.mesh.face_count_at(0)},
                                    {"faces", content.mesh.face_count_at(splits)},
                                    {"vertices_base", data.base_vertices},
                                    {"vertices", data.positions.size()},
                                    {"wedges", data.wedges.size()},
                                    {"texture_coordinates", data.has_uv},
                                    {"vertex_colors", data.has_colors},
                                    {"materials", data.has_materials},
                                    {"bytes", file.bytes().size()}};
  add_cell_members(cells, finding.members["progressive"]);
  return finding;
}

Finding examine(const std::string& path, CallFiles& files) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  const auto is_one_of = [&](std::initializer_list<const char*> list) {
    return std::any_of(list.begin(), list.end(), [&](const char* e) { return extension == e; });
  };
  if (is_one_of({".obj", ".ply", ".stl", ".glb", ".gltf"})) return examine_mesh(path, files);
  if (is_draws_name(path)) return examine_draws(path, files);
  if (extension == ".epm") return examine_progressive(path);
  if (extension == ".exr") return examine_exr(path);
  if (is_one_of({".png", ".jpg", ".jpeg", ".tif", ".tiff"})) return examine_image(path);
  throw InputError(fmt::format("{}: expected .obj .ply .stl .glb .gltf .epm .draws .png .jpg .tif or .exr, got '{}'", path, extension));
}

int run(const Options& options) {
  apply(options.common);
  Console console(console_options(options.common));
  CallFiles files;
  files.add_input(options.path, "the input");
  files.add_output(options.common.json, "--json");
  require_writable_file(options.common.json);
  validation::VerifyInput input;
  input.name = std::filesystem::path(options.path).filename().string();
  input.role = "file";
  input.sha256 = io::file_sha256(options.path);
  input.attribution = attribution_of(input.sha256);
  Finding finding = examine(options.path, files);
  for (const std::string& line : finding.lines) console.line(line);
  if (!input.attribution.empty()) console.line("by " + input.attribution);

  Json document = validation::document_head("info", {input});
  document.update(finding.members);
  validation::RunInfo run_info = validation::current_run(options.common.start);
  run_info.paths = {options.path};
  document["run"] = validation::to_json(run_info);
  write_document(options.common, document);
  return kExitDone;
}

}  // namespace

Verb add_info(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("info", "Say what a mesh or image file holds, and what is wrong with it");
  app->add_option("file", options->path,
                  "Mesh (.obj .ply .stl .glb .gltf), progressive mesh (.epm), drawing (.draws) or image (.png .jpg .tif .exr)")
      ->required()
      ->type_name("FILE");
  add_common_options(*app, options->common, "  etalon info head.glb --json -");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
