#include "cli/render_command.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/draws_input.h"
#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/size_option.h"
#include "cli/usage_error.h"
#include "cli/view_option.h"
#include "core/io/draws_file.h"
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
  std::string write_draws;  ///< empty: not asked for
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

bool holds(OutputKind kind, PixelFormat format) {
  const bool real = format.type == ChannelType::half || format.type == ChannelType::float32;
  return kind == OutputKind::exr ? real : !real && format.type != ChannelType::uint32 && format.channels != 2;
}

// The colour first, in the format that `wanted` asks for where the file can hold it; a PNG holds nothing else.
std::vector<TargetSpec> targets_of(const Options& options, OutputKind kind, const std::vector<TargetSpec>& wanted) {
  std::vector<TargetSpec> targets{{TargetContent::color, kind == OutputKind::png ? kRgba8 : kRgba32f, {0, 0, 0, 0}}};
  for (const TargetSpec& target : wanted) {
    if (target.content == TargetContent::color) {
      targets.front().clear = target.clear;
      if (holds(kind, target.format)) targets.front().format = target.format;
    } else if (kind == OutputKind::exr) {
      targets.push_back(target);
      const bool real = holds(kind, target.format) || target.format == kR32ui;
      if (!real) targets.back().format.type = ChannelType::float32;
    }
  }
  if (!options.margins) return targets;
  const std::vector<TargetSpec> notes{{TargetContent::triangle_id, kR32ui, {}},
                                      {TargetContent::depth, kR32f, {}},
                                      {TargetContent::margins, kRgba32f, {}},
                                      {TargetContent::bound_terms, kRg32f, {}}};
  for (const TargetSpec& note : notes) {
    const auto same = [&](const TargetSpec& target) { return target.content == note.content; };
    if (std::none_of(targets.begin(), targets.end(), same)) targets.push_back(note);
  }
  return targets;
}

std::vector<std::string> channel_names(const TargetSpec& target) {
  std::vector<std::string> names;
  switch (target.content) {
    case TargetContent::color: names = {"R", "G", "B", "A"}; break;
    case TargetContent::triangle_id: names = {"id.triangle"}; break;
    case TargetContent::depth: names = {"Z"}; break;
    case TargetContent::margins: names = {"margin.edge", "margin.u", "margin.v", "margin.z"}; break;
    case TargetContent::bound_terms: names = {"bound.uv", "bound.z"}; break;
    case TargetContent::coordinate: names = {"coordinate.u", "coordinate.v"}; break;
    case TargetContent::barycentrics: names = {"barycentric.0", "barycentric.1", "barycentric.2"}; break;
  }
  names.resize(static_cast<std::size_t>(target.format.channels));
  return names;
}

// What is drawn, and where it comes from.
struct Drawing {
  DrawList list;
  Frame frame;
  std::vector<VerifyInput> inputs;
  std::string view;  ///< empty where the vertices are given
};

Drawing draws_of_file(const Options& options, OutputKind kind, CallFiles& files) {
  Drawing drawing;
  io::DrawsFile file = load_draws(options.model_path, files, drawing.inputs);
  drawing.list = std::move(file.list);
  drawing.frame = std::move(file.frame);
  drawing.frame.targets = targets_of(options, kind, drawing.frame.targets);
  return drawing;
}

Drawing draws_of_model(const Options& options, OutputKind kind, const ViewChoice& choice, FrameSize size, Renderer& renderer,
                       Console& console, CallFiles& files) {
  Drawing drawing;
  Frame& frame = drawing.frame;
  frame.width = size.width;
  frame.height = size.height;
  frame.state.subtexel_bits = options.model.snap_bits;
  frame.state = renderer.supported_state(frame.state);
  frame.targets = targets_of(options, kind, {});
  VerifyModel model = load_model(options.model_path, options.model, files);
  for (const std::string& note : model.notes) console.line("note: " + note);
  for (Material& material : model.materials) material.sampler.filter = options.filter == "linear" ? Filter::linear : Filter::nearest;
  const NamedView& view = choice.named;
  const Camera camera = view.camera ? *view.camera : named_view(view.name, bounding_box(model.mesh), frame.width, frame.height);
  drawing.list = naming_the_model(options.model_path, [&] { return make_scene(model.mesh, model.materials, camera, frame); });
  drawing.inputs = model.inputs;
  drawing.view = view.name;
  return drawing;
}

// Vertices that are given leave these options nothing to decide.
void refuse_model_options(const CLI::App& app) {
  for (const char* name : {"--view", "--size", "--filter", "--texture", "--flip-v", "--snap-bits"})
    if (app.count(name) > 0) throw UsageError(fmt::format("{}: a FILE.draws says itself how it is drawn", name));
}

// The draws are on the disk before the picture that names them.
std::string write_draws_file(const Options& options, const Drawing& drawing, CallFiles& files) {
  if (options.write_draws.empty()) return "";
  for (const std::filesystem::path& image : io::draws_image_paths(options.write_draws, drawing.list))
    files.add_output(image.string(), "a texture of --write-draws");
  return io::write_draws(options.write_draws, drawing.list, drawing.frame);
}

void write_output(const Options& options, OutputKind kind, std::vector<Image> images, const std::vector<TargetSpec>& targets,
                  const std::map<std::string, std::string>& attributes) {
  if (options.output == "-") {
    write_stdout(io::encode_png(images.front(), "standard output"));
    return;
  }
  if (kind == OutputKind::png) {
    io::write_image(options.output, images.front());
    return;
  }
  io::ExrContent content{.layers = {}, .attributes = attributes};
  for (std::size_t i = 0; i < images.size(); ++i) content.layers.push_back({channel_names(targets[i]), std::move(images[i])});
  io::write_exr(options.output, content);
}

int run(const Options& options, const CLI::App& app) {
  apply(options.common);
  const OutputKind kind = output_kind(options);
  const bool given = is_draws_name(options.model_path);
  if (given) refuse_model_options(app);
  if (!options.write_draws.empty() && !is_draws_name(options.write_draws))
    throw UsageError(fmt::format("--write-draws: expected a name that ends in .draws, got '{}'", options.write_draws));
  const ViewChoice choice = given ? ViewChoice{} : parse_view(options.view);
  const FrameSize size = given ? FrameSize{} : frame_size(options.size, {choice});
  Console console(console_options(options.common, options.output));
  CallFiles files;
  files.add_input(options.model_path, given ? "the draws" : "the model");
  if (choice.named.camera) files.add_input(options.view, "--view");
  files.add_output(options.output, "-o");
  files.add_output(options.write_draws, "--write-draws");
  files.add_output(options.common.json, "--json");
  require_writable_file(options.output);
  require_writable_file(options.write_draws);
  require_writable_file(options.common.json);

  raster::CpuRenderer exact;
  OpenedDevice opened;
  Renderer* renderer = &exact;
  if (options.backend == "gl") {
    opened = open_device(options.gl, options.common.threads);
    if (!opened.renderer) throw UnavailableError("GL: not available (" + opened.unavailable + ")");
    renderer = opened.renderer.get();
  }
  console.progress("drawing", 0, 1);
  const Drawing drawing =
      given ? draws_of_file(options, kind, files) : draws_of_model(options, kind, choice, size, *renderer, console, files);
  const Frame& frame = drawing.frame;
  std::vector<Image> images = naming_the_model(options.model_path, [&] { return renderer->render(drawing.list, frame); });

  nlohmann::ordered_json document = document_head("render", drawing.inputs);
  document["backend"] = options.backend;
  if (!given) document["view"] = drawing.view;
  document["width"] = frame.width;
  document["height"] = frame.height;
  if (!given) document["filter"] = options.filter;
  document["triangles"] = drawing.list.triangles.size();
  const std::string list_sha256 = draw_list_sha256(drawing.list);
  document["draw_list_sha256"] = list_sha256;
  document["targets"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < images.size(); ++i) {
    document["targets"].push_back(
        {{"content", to_string(frame.targets[i].content)}, {"format", to_string(frame.targets[i].format)}, {"sha256", images[i].sha256()}});
  }
  {
    const FinishWriting finish;
    std::map<std::string, std::string> attributes{{"drawListSha256", list_sha256}};
    if (const std::string sha256 = write_draws_file(options, drawing, files); !sha256.empty()) {
      document["draws"] = {{"name", std::filesystem::path(options.write_draws).filename().string()}, {"sha256", sha256}};
      attributes["drawsFile"] = std::filesystem::path(options.write_draws).filename().string();
      attributes["drawsFileSha256"] = sha256;
    }
    write_output(options, kind, std::move(images), frame.targets, attributes);
  }
  console.line(fmt::format("{}: {}x{}, {}, {}", options.output, frame.width, frame.height,
                           counted(drawing.list.triangles.size(), "triangle"), renderer->name()));
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
  CLI::App* app = root.add_subcommand("render", "Draw one picture of a model, or of draws that are given");
  app->add_option("model", options->model_path,
                  "Mesh file: .obj, .ply, .stl, .glb, .gltf; or FILE.draws, whose vertices are drawn as they are")
      ->required()
      ->type_name("MODEL|FILE.draws");
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
  app->add_option("--write-draws", options->write_draws, "Also what is drawn, as FILE.draws with its textures beside it")
      ->type_name("FILE.draws")
      ->check(not_empty());
  add_model_options(*app, options->model);
  add_gl_options(*app, options->gl);
  add_common_options(*app, options->common,
                     "  etalon render head.obj --view fit --size 800x600 -o head.png\n"
                     "  etalon render head.obj --margins --write-draws golden.draws -o golden.exr\n"
                     "  etalon render golden.draws --backend gl -o candidate.png");
  return {app, [options, app] { return run(*options, *app); }};
}

}  // namespace etalon::cli
