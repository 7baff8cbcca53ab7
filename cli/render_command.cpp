#include "cli/render_command.h"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/size_option.h"
#include "cli/usage_error.h"
#include "cli/view_option.h"
#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "raster/cpu_renderer.h"
#include "validation/report/json_report.h"
#include "validation/verify/draw_list_hash.h"

namespace etalon::cli {
namespace {

using namespace etalon::validation;

struct Options {
  std::string model_path;
  std::string output;
  std::string view = "fit";
  std::string size;  ///< empty: the view file's
  std::string backend = "cpu";
  std::string filter = "nearest";
  bool margins = false;
  ModelOptions model;
  GlOptions gl;
  CommonOptions common;
};

enum class OutputKind { png, exr };

OutputKind output_kind(const Options& options) {
  std::string extension = std::filesystem::path(options.output).extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  const bool png = options.output == "-" || extension == ".png";
  if (!png && extension != ".exr")
    throw UsageError(fmt::format("-o: expected a name that ends in .png or .exr, or '-', got '{}'", options.output));
  if (options.margins && png) throw UsageError("--margins needs an OpenEXR file: -o OUT.exr");
  if (options.margins && options.backend == "gl") throw UsageError("--margins needs the exact side: --backend cpu");
  return png ? OutputKind::png : OutputKind::exr;
}

Frame frame_of(const Options& options, OutputKind kind, FrameSize size) {
  Frame frame;
  frame.width = size.width;
  frame.height = size.height;
  frame.state.subtexel_bits = options.model.snap_bits;
  frame.targets = {{TargetContent::color, kind == OutputKind::png ? kRgba8 : kRgba32f, {0, 0, 0, 0}}};
  if (options.margins) {
    frame.targets.push_back({TargetContent::triangle_id, kR32ui, {}});
    frame.targets.push_back({TargetContent::depth, kR32f, {}});
    frame.targets.push_back({TargetContent::margins, kRgba32f, {}});
    frame.targets.push_back({TargetContent::bound_terms, kRg32f, {}});
  }
  return frame;
}

std::vector<io::ExrLayer> exr_layers(std::vector<Image> images) {
  static const std::vector<std::vector<std::string>> kNames{
      {"R", "G", "B", "A"}, {"id.triangle"}, {"Z"}, {"margin.edge", "margin.u", "margin.v", "margin.z"}, {"bound.uv", "bound.z"}};
  std::vector<io::ExrLayer> layers;
  for (std::size_t i = 0; i < images.size(); ++i) layers.push_back({kNames[i], std::move(images[i])});
  return layers;
}

void write_output(const Options& options, OutputKind kind, std::vector<Image> images, const std::string& list_sha256) {
  if (options.output == "-") {
    write_stdout(io::encode_png(images.front(), "standard output"));
    return;
  }
  const FinishWriting finish;
  if (kind == OutputKind::png)
    io::write_image(options.output, images.front());
  else
    io::write_exr(options.output, {exr_layers(std::move(images)), {{"drawListSha256", list_sha256}}});
}

int run(const Options& options) {
  apply(options.common);
  const OutputKind kind = output_kind(options);
  const ViewChoice choice = parse_view(options.view);
  const NamedView& view = choice.named;
  Frame frame = frame_of(options, kind, frame_size(options.size, {choice}));
  Console console(console_options(options.common, options.output));
  CallFiles files;
  files.add_input(options.model_path, "the model");
  if (view.camera) files.add_input(options.view, "--view");
  files.add_output(options.output, "-o");
  files.add_output(options.common.json, "--json");
  require_writable_file(options.output);
  require_writable_file(options.common.json);

  VerifyModel model = load_model(options.model_path, options.model, files);
  for (const std::string& note : model.notes) console.line("note: " + note);
  for (Material& material : model.materials) material.sampler.filter = options.filter == "linear" ? Filter::linear : Filter::nearest;

  raster::CpuRenderer exact;
  OpenedDevice opened;
  Renderer* renderer = &exact;
  if (options.backend == "gl") {
    opened = open_device(options.gl, options.common.threads);
    if (!opened.renderer) throw UnavailableError("GL: not available (" + opened.unavailable + ")");
    renderer = opened.renderer.get();
    frame.state = renderer->supported_state(frame.state);
  }
  console.progress("drawing", 0, 1);
  const Camera camera = view.camera ? *view.camera : named_view(view.name, bounding_box(model.mesh), frame.width, frame.height);
  auto [list, images] = naming_the_model(options.model_path, [&] {
    DrawList scene = make_scene(model.mesh, model.materials, camera, frame);
    std::vector<Image> targets = renderer->render(scene, frame);
    return std::pair(std::move(scene), std::move(targets));
  });

  nlohmann::ordered_json document = document_head("render", model.inputs);
  document["backend"] = options.backend;
  document["view"] = view.name;
  document["width"] = frame.width;
  document["height"] = frame.height;
  document["filter"] = options.filter;
  document["triangles"] = list.triangles.size();
  document["draw_list_sha256"] = draw_list_sha256(list);
  document["targets"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < images.size(); ++i) {
    document["targets"].push_back(
        {{"content", to_string(frame.targets[i].content)}, {"format", to_string(frame.targets[i].format)}, {"sha256", images[i].sha256()}});
  }
  write_output(options, kind, std::move(images), document["draw_list_sha256"]);
  console.line(fmt::format("{}: {}x{}, {}, {}", options.output, frame.width, frame.height, counted(list.triangles.size(), "triangle"),
                           renderer->name()));
  RunInfo run_info = current_run(options.common.start);
  run_info.paths = {options.model_path};
  if (options.backend == "gl") run_info.device = renderer->name();
  document["run"] = to_json(run_info);
  write_document(options.common, document);
  return kExitDone;
}

}  // namespace

Verb add_render(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("render", "Draw one picture of a model");
  app->add_option("model", options->model_path, "Mesh file: .obj, .ply, .glb, .gltf")->required()->type_name("MODEL");
  app->add_option("-o,--output", options->output, "Picture to write: .png, .exr (colour as float32), or '-' for a PNG on standard output")
      ->required()
      ->type_name("FILE");
  app->add_option("--view", options->view, "front, fit, N/24 or a view file (default fit)")->type_name("NAME|FILE");
  app->add_option("--size", options->size, "Frame, WxH or one number (default: the view file's, else 1024)")
      ->type_name("WxH")
      ->check(not_empty());
  app->add_option("--backend", options->backend, "cpu: the exact rasterizer (default); gl: OpenGL")
      ->check(CLI::IsMember({"cpu", "gl"}))
      ->type_name("SIDE");
  app->add_option("--filter", options->filter, "Texture filter: nearest (default) or linear")
      ->check(CLI::IsMember({"nearest", "linear"}))
      ->type_name("KIND");
  app->add_flag("--margins", options->margins, "Also triangle ids, depth, and how close every decision was (.exr, --backend cpu)");
  add_model_options(*app, options->model);
  add_gl_options(*app, options->gl);
  add_common_options(*app, options->common, "  etalon render head.obj --view fit --size 800x600 -o head.png");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
