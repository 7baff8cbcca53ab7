#include "cli/adapt_command.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "cli/call_files.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/model_input.h"
#include "cli/size_option.h"
#include "cli/usage_error.h"
#include "core/adapt/adapt_map.h"
#include "core/adapt/cell_chunks.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"
#include "core/io/mesh_file.h"
#include "core/progressive/epm_format.h"
#include "raster/cpu_renderer.h"
#include "validation/report/json_report.h"

namespace etalon::cli {
namespace {

using Json = nlohmann::ordered_json;
using validation::grouped;

struct Options {
  std::string input, texture, output, map, size = "1024", format = "float32", filter = "linear";
  std::int64_t faces = 0;
  CommonOptions common;
};

struct Work {
  progressive::ProgressiveMesh mesh;
  adapt::AdaptSequence sequence;
  std::size_t level;
  Filter filter;
};

Image adapted(const Work& work, Image map, const std::string& what, Console& console, adapt::AdaptCounts& counts) {
  raster::CpuRenderer renderer;
  adapt::AdaptOptions how{.filter = work.filter, .progress = {}};
  how.progress = [&](std::size_t done, std::size_t total) { console.progress(what, static_cast<int>(done), static_cast<int>(total)); };
  counts = adapt::adapt_map(renderer, work.sequence, work.sequence.size(), work.level, map, how);
  return map;
}

// How far, in texels of the map, a map's texels point from where the chain of cells leads without resampling; of a grid of texels.
Json map_errors(const Work& work, const Image& map) {
  constexpr int kAlong = 64;
  std::vector<double> errors;
  const auto stride = [](int size) { return std::max(1, size / kAlong); };
  for (int y = stride(map.height()) / 2; y < map.height(); y += stride(map.height()))
    for (int x = stride(map.width()) / 2; x < map.width(); x += stride(map.width())) {
      const Vec2d truth = work.sequence.follow({(x + 0.5) / map.width(), (y + 0.5) / map.height()}, work.level, work.sequence.size());
      const Vec2d at = adapt::map_coordinate(map, x, y);
      const double dx = (at.x - truth.x) * map.width(), dy = (at.y - truth.y) * map.height();
      errors.push_back(std::sqrt(dx * dx + dy * dy));
    }
  std::sort(errors.begin(), errors.end());
  return {{"median", errors[errors.size() / 2]}, {"p99", errors[errors.size() * 99 / 100]}, {"max", errors.back()}};
}

constexpr std::pair<const char*, ChannelType> kFormats[] = {
    {"float32", ChannelType::float32}, {"half", ChannelType::half}, {"unorm16", ChannelType::unorm16}, {"unorm8", ChannelType::unorm8}};

ChannelType format_named(const std::string& name) {
  return std::find_if(std::begin(kFormats), std::end(kFormats), [&](const auto& format) { return name == format.first; })->second;
}

// PNG has no two channels: a third one of zeros is added, which lookups through the map do not read.
Image with_third_channel(const Image& map) {
  Image result(map.width(), map.height(), {map.format().type, 3});
  const auto channel_bytes = static_cast<std::size_t>(bytes_per_channel(map.format().type));
  for (std::size_t n = 0; n < map.texel_count(); ++n)
    std::memcpy(result.bytes().data() + n * 3 * channel_bytes, map.bytes().data() + n * 2 * channel_bytes, 2 * channel_bytes);
  return result;
}

void write_map(const std::string& path, const Image& map) {
  const bool floating = map.format().type == ChannelType::float32 || map.format().type == ChannelType::half;
  io::write_image(path, floating ? map : with_third_channel(map));
}

void require_options(const Options& options) {
  if (options.output.empty() && options.map.empty()) throw UsageError("adapt: expected --map FILE.exr, or --texture IMG with -o MODEL");
  if (options.output.empty() != options.texture.empty()) throw UsageError("adapt: --texture IMG and -o MODEL go together");
  if (options.output == "-" || options.map == "-") throw UsageError("adapt: expected files, got '-'");
  const char* const extension = options.format.starts_with("unorm") ? ".png" : ".exr";
  if (!options.map.empty() && std::filesystem::path(options.map).extension() != extension)
    throw UsageError(fmt::format("adapt: --map {}: expected a name ending in {} for --format {}", options.map, extension, options.format));
}

int run(const Options& options) {
  apply(options.common);
  require_options(options);
  const FrameSize size = parse_size(options.size);
  const ChannelType format = format_named(options.format);
  for (const std::string& file : {options.output, options.map, options.common.json}) require_writable_file(file);
  Console console(console_options(options.common));
  CallFiles files;
  files.add_input(options.input, "the input");
  if (!options.texture.empty()) files.add_input(options.texture, "--texture");
  std::vector<io::Material> materials;
  if (!options.texture.empty()) materials.push_back({.name = "adapted", .texture_path = {}, .texture = io::read_image(options.texture)});
  std::vector<std::filesystem::path> written;
  if (!options.output.empty()) written = io::mesh_output_files(options.output, materials);
  for (const std::filesystem::path& path : written) files.add_output(path.string(), "-o");
  files.add_output(options.map, "--map");
  if (!options.map.empty()) written.emplace_back(options.map);
  files.add_output(options.common.json, "--json");

  const io::FileBytes file = io::read_file(options.input);
  progressive::EpmContent content = naming_the_model(options.input, [&] { return progressive::decode_epm(file.bytes()); });
  if (!content.complete)
    throw InputError(fmt::format("{}: expected a whole progressive mesh, got {} of {} splits: a texture belongs to the finest level",
                                 options.input, grouped(content.mesh.split_count()), grouped(content.splits_in_whole)));
  adapt::AdaptSequence sequence = naming_the_model(options.input, [&] {
    const auto progress = [&](std::size_t done, std::size_t total) {
      console.progress("cells", static_cast<int>(done), static_cast<int>(total));
    };
    if (auto stored = adapt::decode_cells(content, progress)) return std::move(*stored);
    adapt::AdaptSequence made(content.mesh, progress);
    console.line(fmt::format("note: {} has no cells: made now, the same that `etalon progressive` stores", options.input));
    return made;
  });
  content.mesh.go_to_faces(static_cast<std::size_t>(options.faces));
  const std::size_t level = content.mesh.level();
  const Work work{std::move(content.mesh), std::move(sequence), level, options.filter == "nearest" ? Filter::nearest : Filter::linear};

  std::vector<validation::VerifyInput> inputs = {file_input(options.input, "progressive mesh")};
  if (!options.texture.empty()) inputs.push_back(file_input(options.texture, "texture"));
  Json document = validation::document_head("adapt", inputs);
  adapt::AdaptCounts counts;  // of the texture where both are adapted
  Image map;
  if (!options.map.empty()) map = adapted(work, adapt::identity_map(size.width, size.height, format), "map", console, counts);
  if (!options.output.empty()) materials[0].texture = adapted(work, materials[0].texture, "texture", console, counts);
  document["faces"] = work.mesh.face_count();
  document["adaptations"] = counts.adaptations;
  document["packs"] = counts.packs;
  const std::size_t unnamed = map.empty() ? 0 : adapt::unnamed_texels(size.width, size.height, format);
  document["format"] = options.format;
  document["filter"] = options.filter;
  document["unnamed_texels"] = unnamed;
  document["map_error_texels"] = map.empty() ? Json() : map_errors(work, map);
  {
    const FinishWriting writing;
    if (!map.empty()) write_map(options.map, map);
    if (!options.output.empty()) {
      Mesh mesh = work.mesh.mesh();
      mesh.face_materials.clear();
      io::write_mesh(options.output, mesh, materials);
    }
  }
  console.line(fmt::format("level {} of {}: {} faces; {} adaptations in {} packs", grouped(level), grouped(work.mesh.split_count()),
                           grouped(work.mesh.face_count()), grouped(counts.adaptations), grouped(counts.packs)));
  const bool reached = work.mesh.face_count() <= static_cast<std::size_t>(options.faces);
  if (!reached)
    console.line(fmt::format("the base has more than the {} faces asked for", grouped(static_cast<std::uint64_t>(options.faces))));
  if (unnamed > 0)
    print_warning(
        fmt::format("--format {} cannot name {} of the {} texels of {}x{}: detail is lost before anything is adapted; float32 and "
                    "unorm16 name all up to 8192",
                    options.format, grouped(unnamed), grouped(map.texel_count()), size.width, size.height));
  for (const std::filesystem::path& path : written) console.line("wrote " + path.string());
  validation::RunInfo info = validation::current_run(options.common.start);
  info.paths = {options.input};
  if (!options.texture.empty()) info.paths.push_back(options.texture);
  for (const std::filesystem::path& path : written) info.paths.push_back(path.string());
  document["run"] = validation::to_json(info);
  write_document(options.common, document);
  return reached && unnamed == 0 ? kExitDone : kExitWarning;
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
  app->add_option("--texture", options->texture, "Texture of the finest level, written adapted with -o")
      ->type_name("IMG")
      ->check(not_empty());
  app->add_option("-o,--output", options->output, "The level's model with the adapted texture (.obj .glb .ply)")->type_name("MODEL");
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
  add_common_options(*app, options->common,
                     "  etalon adapt head.epm --faces 500 --texture head_texture.png -o head500.obj\n  (after: etalon make head -o "
                     "head.obj; etalon progressive head.obj --metric qem5 -o head.epm)");
  return {app, [options] { return run(*options); }};
}

}  // namespace etalon::cli
