#include "tests/bench/surface_benches.h"

#include <filesystem>
#include <functional>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/simplify/simplify.h"
#include "tests/bench/machine.h"
#include "tests/bench/simplify_document.h"
#include "tests/support/skip.h"

namespace etalon::bench {
namespace {

constexpr const char* kMetroTitle = "distance of the knot of 100,000 faces and its tenth, beside MeshLab";

void report(SurfaceResults& results, const std::string& scene, const std::vector<Figure>& figures) {
  for (const Figure& figure : figures) {
    const nlohmann::ordered_json json = figure_json(figure);
    if (figure.values.empty()) {
      test::report_skip(fmt::format("bench {}: {}", scene, figure.title), figure.skipped);
      ++results.skipped;
      continue;
    }
    fmt::print("{:24} {:48} {:8.3f} {} {} {}\n", scene, figure.title, json.at("median").get<double>(), json.at("sense").get<std::string>(),
               figure.goal, json.at("verdict").get<std::string>());
  }
  std::fflush(stdout);
}

void absent(SurfaceResults& results, const std::string& scene) {
  test::report_skip("bench " + scene, "a real input is absent");
  ++results.skipped;
}

void measure_texture_scenes(const BenchOptions& options, SurfaceResults& results) {
  for (const TextureScene& scene : texture_scenes()) {
    if (!wants(options, scene.name)) continue;
    const std::optional<Image> image = scene.make();
    if (!image) {
      absent(results, scene.name);
      continue;
    }
    results.textures.push_back(measure_textures(scene, *image, openjpeg(), std::min(options.repetitions, kFewestRounds)));
    ++results.measured;
    report(results, scene.name, results.textures.back().figures);
  }
}

void measure_distance_scene(const BenchOptions& options, SurfaceResults& results) {
  for (const SimplifyScene& scene : simplify_scenes()) {
    if (scene.name != "simplify-knot100k") continue;
    const std::optional<Mesh> mesh = scene.make();
    if (!mesh) return absent(results, kMetroScene);
    const Mesh small = simplify::simplify_mesh(*mesh, {.target_faces = mesh->face_count() / 10}).mesh;
    results.metro = measure_metro(*mesh, small, std::min(options.repetitions, kFewestRounds));
    ++results.measured;
    report(results, kMetroScene, results.metro->figures);
  }
}

std::string with_machine(const nlohmann::ordered_json& document, const std::function<std::string()>& make_tables,
                         const std::string& how = "One thread, CPU seconds of the library's call.") {
  try {
    const std::string tables = make_tables();
    if (tables.empty()) return tables;
    const auto& machine = document.at("machine");
    return fmt::format("Measured on {}: {}, {} cores, {}, {}; load {:.1f} at the start. {}\n\n", machine.at("date").get<std::string>(),
                       machine.at("cpu").get<std::string>(), machine.at("cores").get<int>(), machine.at("system").get<std::string>(),
                       machine.at("compiler").get<std::string>(), machine.at("load").get<double>(), how) +
           tables;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("expected a document of --json: {}", error.what()));
  }
}

std::string with_block(const std::string& page, const std::string& tables, const std::string& first_line, const std::string& last_line) {
  const auto begin = page.find(first_line), end = page.find(last_line);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw InputError(fmt::format("expected the lines {} and {}", first_line.substr(0, first_line.size() - 1),
                                 last_line.substr(0, last_line.size() - 1)));
  return page.substr(0, begin) + first_line + "\n" + tables + "\n" + page.substr(end);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> surface_scene_titles() {
  std::vector<std::pair<std::string, std::string>> titles;
  for (const SimplifyScene& scene : simplify_scenes()) titles.emplace_back(scene.name, scene.title + (scene.is_long ? " (--long)" : ""));
  titles.emplace_back(kMetroScene, kMetroTitle);
  for (const TextureScene& scene : texture_scenes()) titles.emplace_back(scene.name, scene.title + ", beside OpenJPEG");
  for (const auto& title : bake_scene_titles()) titles.push_back(title);
  for (const auto& title : joint_scene_titles()) titles.push_back(title);
  return titles;
}

SurfaceResults measure_surface_scenes(const BenchOptions& options, const MakePairRival& make_rival) {
  SurfaceResults results;
  const SimplifyBenchOptions bench{
      .program = std::filesystem::read_symlink("/proc/self/exe").string(), .rounds = options.repetitions, .seconds = options.seconds};
  for (const SimplifyScene& scene : simplify_scenes()) {
    if (!wants(options, scene.name) || (scene.is_long && !options.long_scenes)) continue;
    const std::optional<Mesh> mesh = scene.make();
    if (!mesh) {
      absent(results, scene.name);
      continue;
    }
    results.simplifications.push_back(measure_simplification(scene, *mesh, bench));
    ++results.measured;
    report(results, scene.name, results.simplifications.back().figures);
  }
  if (wants(options, kMetroScene)) measure_distance_scene(options, results);
  measure_texture_scenes(options, results);
  results.baking = measure_bake_scenes(options, ETALON_PROGRAM);
  for (const std::string& scene : results.baking.absent) absent(results, scene);
  results.measured += results.baking.measured;
  report(results, "bake", bake_figures(results.baking.result));
  results.joint = measure_joint_scenes(options, bench.program, make_rival);
  for (const std::string& scene : results.joint.absent) absent(results, scene);
  results.measured += results.joint.measured();
  report(results, "joint", joint_figures(results.joint));
  return results;
}

void add_surface_results(const SurfaceResults& results, nlohmann::ordered_json& document) {
  if (!results.simplifications.empty()) document["simplification"] = simplify_document(results.simplifications);
  if (results.metro) document["metro"] = metro_document(*results.metro);
  if (results.baking.measured > 0) document["baking"] = bake_document(results.baking.result);
  if (results.joint.measured() > 0) document["joint"] = joint_document(results.joint);
  if (!results.textures.empty()) document["textures"] = texture_document(results.textures);
}

std::string surface_tables(const nlohmann::ordered_json& document) {
  return with_machine(document, [&] {
    std::string tables;
    if (document.contains("simplification")) tables += simplify_tables(document.at("simplification"));
    if (document.contains("metro")) tables += metro_tables(document.at("metro"));
    return tables;
  });
}

std::string stream_tables(const nlohmann::ordered_json& document) {
  return with_machine(document, [&] { return document.contains("textures") ? texture_tables(document.at("textures")) : ""; });
}

std::string bake_block(const nlohmann::ordered_json& document) {
  return with_machine(document, [&] { return document.contains("baking") ? bake_tables(document.at("baking")) : ""; });
}

std::string joint_block(const nlohmann::ordered_json& document) {
  const int threads = document.contains("threads") ? document.at("threads").get<int>() : 0;
  const std::string rival = document.contains("rival") ? document.at("rival").get<std::string>() : "";
  return with_machine(
      document, [&] { return document.contains("joint") ? joint_tables(document.at("joint")) : ""; },
      fmt::format("Ours: {} threads. Rival: {}.", threads, rival.empty() ? "none" : rival));
}

std::string surface_picture(const nlohmann::ordered_json& document) {
  if (document.contains("simplification"))
    if (const std::string picture = growth_picture(document.at("simplification")); !picture.empty()) return picture;
  if (document.contains("baking"))
    if (const std::string picture = bake_growth_picture(document.at("baking")); !picture.empty()) return picture;
  return document.contains("joint") ? quadtree_picture(document.at("joint")) : "";
}

std::string with_surface_tables(const std::string& page, const std::string& tables) {
  return with_block(page, tables, kSurfaceBlockBegin, kSurfaceBlockEnd);
}

std::string with_stream_tables(const std::string& page, const std::string& tables) {
  return with_block(page, tables, kStreamBlockBegin, kStreamBlockEnd);
}

std::string with_joint_tables(const std::string& page, const std::string& tables) {
  return with_block(page, tables, kJointBlockBegin, kJointBlockEnd);
}

}  // namespace etalon::bench
