#include "cli/adapt_command.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/adapt_images.h"
#include "cli/adapt_input.h"
#include "cli/adapt_psnr.h"
#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/gl_options.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/size_option.h"
#include "cli/usage_error.h"
#include "core/adapt/resolve_texture.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "core/progressive/epm_format.h"
#include "raster/cpu_renderer.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

constexpr int kPsnrViewSize = 1024;

struct Options {
  std::string input, output, map, size = "1024", format = "float32", filter = "linear";
  std::vector<std::string> textures;
  std::string backend = "cpu";
  GlOptions gl;
  bool through_map = false, analytic = false, psnr = false;
  std::int64_t faces = 0;
  CommonOptions common;
};

void require_options(const Options& options) {
  if (options.output.empty() && options.map.empty()) throw UsageError("adapt: expected --map FILE, or --texture IMG with -o MODEL");
  if (options.output.empty() != options.textures.empty()) throw UsageError("adapt: --texture IMG and -o MODEL go together");
  if (options.output == "-" || options.map == "-") throw UsageError("adapt: expected files, got '-'");
  if (options.through_map && options.textures.empty()) throw UsageError("adapt: --through-map: expected --texture IMG and -o MODEL");
  if (options.psnr && options.textures.empty()) throw UsageError("adapt: --psnr: expected --texture IMG and -o MODEL");
  if (options.through_map && options.analytic)
    throw UsageError("adapt: expected --through-map or --analytic, got both (--analytic looks textures up through exact maps)");
  const char* const extension = options.format.starts_with("unorm") ? ".png" : ".exr";
  if (!options.map.empty() && std::filesystem::path(options.map).extension() != extension)
    throw UsageError(fmt::format("adapt: --map {}: expected a name ending in {} for --format {}", options.map, extension, options.format));
}

// What is written: the model with its first texture, the others beside it, the map.
struct Outputs {
  std::vector<Image> textures;
  Image map;
};

std::vector<std::filesystem::path> output_files(const Options& options, const std::vector<Image>& textures) {
  std::vector<std::filesystem::path> files;
  if (!options.output.empty()) {
    files = io::mesh_output_files(options.output, {{.name = "adapted", .texture_path = {}, .texture = textures[0]}});
    for (std::size_t n = 2; n <= textures.size(); ++n) files.push_back(later_texture_path(options.output, n));
  }
  if (!options.map.empty()) files.emplace_back(options.map);
  return files;
}

Outputs make_outputs(const Options& options, FrameSize size, const std::vector<Image>& textures, LevelImages& level) {
  Outputs outputs;
  const ChannelType type = map_type_named(options.format);
  if (!options.map.empty() || options.through_map) outputs.map = level.map(size.width, size.height, type, "map");
  for (const Image& texture : textures) {
    if (options.through_map) {
      outputs.textures.push_back(adapt::resolve_texture(level.renderer, texture, outputs.map, level.filter));
    } else if (options.analytic) {
      const Image exact = level.map(texture.width(), texture.height(), ChannelType::float32, "texture");
      outputs.textures.push_back(adapt::resolve_texture(level.renderer, texture, exact, Filter::nearest));
    } else {
      outputs.textures.push_back(level.adapted(texture, "texture"));
    }
  }
  return outputs;
}

void write_outputs(const Options& options, const progressive::ProgressiveMesh& mesh, const Outputs& outputs) {
  const FinishWriting writing;
  if (!options.map.empty()) write_map(options.map, outputs.map);
  for (std::size_t n = 2; n <= outputs.textures.size(); ++n)
    io::write_image(later_texture_path(options.output, n), outputs.textures[n - 1]);
  if (options.output.empty()) return;
  Mesh level = mesh.mesh();
  level.face_materials.clear();
  io::write_mesh(options.output, level, {{.name = "adapted", .texture_path = {}, .texture = outputs.textures[0]}});
}

int run(const Options& options) {
  apply(options.common);
  require_options(options);
  const FrameSize size = parse_size(options.size);
  for (const std::string& file : {options.output, options.map, options.common.json}) require_writable_file(file);
  Console console(console_options(options.common));
  CallFiles files;
  files.add_input(options.input, "the input");
  std::vector<Image> textures;
  int largest_side = options.map.empty() && !options.through_map ? 1 : std::max(size.width, size.height);
  for (const std::string& path : options.textures) {
    files.add_input(path, "--texture");
    textures.push_back(io::read_image(path));
    require_texture(textures.back(), path);
    largest_side = std::max({largest_side, textures.back().width(), textures.back().height()});
  }
  const std::vector<std::filesystem::path> written = output_files(options, textures);
  for (const std::filesystem::path& path : written) files.add_output(path.string(), path == options.map ? "--map" : "-o");
  files.add_output(options.common.json, "--json");

  progressive::EpmContent content = read_whole(options.input);
  progressive::ProgressiveMesh& mesh = content.mesh;
  const adapt::AdaptSequence sequence = cells_of(content, options.input, console);
  const TextureSpace space = examine_texture_space(mesh, sequence, largest_side, options.input);
  const adapt::ChartBorders borders(mesh);
  mesh.go_to_faces(static_cast<std::size_t>(options.faces));
  raster::CpuRenderer exact;
  OpenedDevice opened;
  if (options.backend == "gl") {
    opened = open_device(options.gl, options.common.threads);
    if (!opened.renderer) throw UnavailableError("GL: not available (" + opened.unavailable + ")");
  }
  LevelImages level{.sequence = sequence,
                    .borders = borders,
                    .renderer = opened.renderer ? *opened.renderer : exact,
                    .level = mesh.level(),
                    .filter = options.filter == "nearest" ? Filter::nearest : Filter::linear,
                    .analytic = options.analytic,
                    .console = console};
  const Outputs outputs = make_outputs(options, size, textures, level);
  const std::size_t unnamed = outputs.map.empty() ? 0 : adapt::unnamed_texels(size.width, size.height, outputs.map.format().type);

  std::vector<validation::VerifyInput> inputs = {file_input(options.input, "progressive mesh")};
  for (const std::string& path : options.textures) inputs.push_back(file_input(path, "texture"));
  Json document = validation::document_head("adapt", inputs);
  document["faces"] = mesh.face_count();
  document["adaptations"] = level.adaptations;
  document["packs"] = level.packs;
  document["way"] = options.analytic ? "analytic" : options.through_map ? "through map" : "direct";
  document["backend"] = options.backend;
  document["format"] = options.format;
  document["filter"] = options.filter;
  document["unnamed_texels"] = unnamed;
  document["map_error_texels"] = outputs.map.empty() ? Json() : map_errors(level, outputs.map);
  document["images"] = level.images;
  document["psnr_db"] = Json();
  if (options.psnr) {
    const Mesh coarse = mesh.mesh();
    mesh.go_to(mesh.split_count());
    document["psnr_db"] = level_psnr(mesh.mesh(), coarse, textures[0], outputs.textures[0], kPsnrViewSize, console);
    mesh.go_to(level.level);
  }
  add_texture_space(document, space);
  write_outputs(options, mesh, outputs);

  print_texture_space(console, space);
  console.line(fmt::format("level {} of {}: {} faces; {}", grouped(mesh.level()), grouped(mesh.split_count()), grouped(mesh.face_count()),
                           options.analytic ? "exact, without resampling between"
                                            : fmt::format("{} adaptations in {} packs", grouped(level.adaptations), grouped(level.packs))));
  const bool reached = mesh.face_count() <= static_cast<std::size_t>(options.faces);
  if (options.psnr) console.line(psnr_line(document["psnr_db"]));
  if (!reached)
    console.line(fmt::format("the base has more than the {} faces asked for", grouped(static_cast<std::uint64_t>(options.faces))));
  if (unnamed > 0)
    print_warning(
        fmt::format("--format {} cannot name {} of the {} texels of {}x{}: detail is lost before anything is adapted; float32 and "
                    "unorm16 name all up to 8192",
                    options.format, grouped(unnamed), grouped(outputs.map.texel_count()), size.width, size.height));
  const bool nothing = mesh.level() < sequence.size() && level.adaptations == 0;
  if (nothing) print_warning("no collapse on the way has cells: nothing was adapted, textures and map are as on the finest level");
  for (const std::filesystem::path& path : written) console.line("wrote " + path.string());
  validation::RunInfo info = validation::current_run(options.common.start);
  info.paths = {options.input};
  info.paths.insert(info.paths.end(), options.textures.begin(), options.textures.end());
  for (const std::filesystem::path& path : written) info.paths.push_back(path.string());
  if (opened.renderer) info.device = opened.renderer->name();
  document["run"] = validation::to_json(info);
  write_document(options.common, document);
  return reached && !nothing && unnamed == 0 && !space.overlaps() ? kExitDone : kExitWarning;
}

}  // namespace

Verb add_adapt(CLI::App& root) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = root.add_subcommand("adapt", "Adapt a progressive mesh's texture, or an indexing map, to one of its levels");
  app->add_option("input", options->input, "Progressive mesh (.epm) with texture coordinates")
      ->required()
      ->type_name("IN.epm")
      ->check(not_empty());
  app->add_option("--faces", options->faces, "The level: at most so many triangles")
      ->required()
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 32));
  app->add_option(
         "--texture", options->textures,
         "Texture of the finest level; may be given again: the model gets the first, later ones are written as MODEL_texture_2.png, …")
      ->type_name("IMG")
      ->allow_extra_args(false)
      ->check(not_empty());
  app->add_option("-o,--output", options->output, "The level's model with the adapted texture (.obj .glb .ply)")->type_name("MODEL");
  app->add_flag("--through-map", options->through_map,
                "Look every texture up through one indexing map of --size and --format, instead of adapting each");
  app->add_flag("--analytic", options->analytic,
                "The exact limit: follow every texel through all cells, without resampling between; maps and textures at once");
  app->add_option("--map", options->map,
                  "The indexing map of the level: where on the finest level's texture each texel looks (.exr; .png for --format unorm…)")
      ->type_name("OUT.exr|.png");
  app->add_option("--size", options->size, "Of the map, WxH or one number (default 1024)")->type_name("WxH");
  app->add_option("--format", options->format, "Of the map: float32 (default), half, unorm16 or unorm8")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"float32", "half", "unorm16", "unorm8"}));
  app->add_option("--filter", options->filter, "Of each adaptation's lookup: linear (default) or nearest")
      ->type_name("KIND")
      ->check(CLI::IsMember({"linear", "nearest"}));
  app->add_flag("--psnr", options->psnr,
                "Draw the 24 views of the full model and of the level, with the adapted first texture and without");
  app->add_option("--backend", options->backend, "What adapts and looks up: cpu, the exact rasterizer (default), or gl: OpenGL")
      ->type_name("KIND")
      ->check(CLI::IsMember({"cpu", "gl"}));
  add_gl_options(*app, options->gl);
  add_common_options(*app, options->common,
                     "  etalon adapt head.epm --faces 500 --texture head_texture.png -o head500.obj\n  (after: etalon make head -o "
                     "head.obj; etalon progressive head.obj --metric qem5 -o head.epm)");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
