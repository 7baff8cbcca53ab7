#include <optional>

#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#include "core/procedural/knot.h"
#include "tests/bench/simplify_bench.h"
#include "tests/support/skip.h"

namespace etalon::bench {
namespace {

std::optional<Mesh> real_mesh(const std::string& path) {
  const auto file = test::data_file(path);
  if (!file) return std::nullopt;
  return welded_by_position(io::read_mesh(*file).mesh);
}

SimplifyScene knot_scene(const std::string& name, const std::string& title, int faces, double ratio, std::vector<std::string> ways) {
  return {.name = name,
          .title = title,
          .make = [faces] { return std::optional(procedural::make_knot(procedural::knot_of_faces(faces))); },
          .ratio = ratio,
          .ways = std::move(ways)};
}

}  // namespace

std::vector<SimplifyScene> simplify_scenes() {
  const std::vector<std::string> all{"ours-qem", "ours-qem-full", "ours-kim", "ours-qem6", "ours-qem6-full", "ours-qem6-full-weighted",
                                     "cgal-gh",  "openmesh",      "meshopt"};
  std::vector<SimplifyScene> scenes;
  scenes.push_back({.name = "simplify-knot100k",
                    .title = "the knot of 100,000 faces to 10 %",
                    .make = [] { return real_mesh("knot/knot100k.ply"); },
                    .ratio = 0.1,
                    .ways = all});
  scenes.push_back(knot_scene("simplify-knot", "`make knot` of 100,000 faces to 10 %", 100'000, 0.1, all));
  scenes.push_back({.name = "simplify-head",
                    .title = "Lee Perry-Smith's head of 17,684 faces to 10 %",
                    .make = [] { return real_mesh("lee_perry_smith/LeePerrySmith.glb"); },
                    .ratio = 0.1,
                    .ways = {"ours-qem", "ours-qem-full", "cgal-gh", "openmesh", "meshopt"}});
  scenes.push_back({.name = "simplify-head283k",
                    .title = "Lee Perry-Smith's head of 282,944 faces to 10 %",
                    .make = [] { return real_mesh("lee_perry_smith/lee_perry_smith_283k.ply"); },
                    .ratio = 0.1,
                    .ways = all,
                    .most_rounds = 5});
  scenes.push_back(
      knot_scene("simplify-large", "`make knot` of 2,360,000 faces to 3 %", 2'360'000, 0.03, {"ours-qem", "cgal-gh", "meshopt"}));
  scenes.back().most_rounds = 3;
  for (const int thousands : {10, 30, 100, 300, 1000, 3000, 10'000}) {
    std::vector<std::string> ways{"ours-qem"};
    if (thousands <= 3000) ways.emplace_back("ours-kim");
    scenes.push_back(
        knot_scene("simplify-growth-" + std::to_string(thousands) + "k", "`make knot` to 10 %", 1000 * thousands, 0.1, std::move(ways)));
    scenes.back().most_rounds = thousands > 1000 ? 1 : 3;
    scenes.back().is_long = true;
  }
  return scenes;
}

}  // namespace etalon::bench
