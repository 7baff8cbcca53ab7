#include "tests/validation/cross_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace etalon::test {

using validation::ClassCounts;
using validation::DiffResult;
using validation::TexelClass;

CrossCheckTotals cross_check(Renderer& golden, Renderer& candidate, const validation::DeviceModel& device, const CrossCheckOptions& options) {
  CrossCheckTotals totals;
  totals.first_seed = totals.next_seed = options.first_seed;
  const RasterState state = candidate.supported_state({});
  while (totals.total.total() < options.texels) {
    const std::uint64_t seed = totals.next_seed++;
    const RandomScene scene = make_random_scene(seed, state, options.largest);
    const std::vector<Image> a = golden.render(scene.list, scene.frame), b = candidate.render(scene.list, scene.frame);
    const DiffResult diff = validation::diff_images(scene.list, scene.frame, device, a, b, {.worst_count = 3, .keep_class_image = false});
    totals.by_kind[static_cast<std::size_t>(scene.kind)] += diff.counts;
    totals.total += diff.counts;
    for (std::size_t i = 0; i < diff.unexplained_by.size(); ++i) totals.unexplained_by[i] += diff.unexplained_by[i];
    totals.largest_rounding_share = std::max(totals.largest_rounding_share, diff.largest_rounding_share);
    totals.largest_tie_share = std::max(totals.largest_tie_share, diff.largest_tie_share);
    if (!diff.agreed() && totals.failures.size() < 40) {
      totals.failures.push_back(fmt::format("seed {} ({}, {} x {}, guard {}): {} unexplained", seed, to_string(scene.kind), scene.frame.width,
                                            scene.frame.height, scene.frame.guard, diff.counts[TexelClass::unexplained]));
      for (const auto& report : diff.worst) {
        std::string bytes;
        for (std::size_t i = 0; i < report.golden_bytes.size(); ++i) {
          bytes += fmt::format(" [{} {} | {}]", to_string(scene.frame.targets[i].content), report.golden_bytes[i], report.candidate_bytes[i]);
        }
        totals.failures.push_back("  " + report.sentence + bytes);
      }
    }
    if (options.progress) options.progress(totals);
  }
  return totals;
}

std::string format_totals(const CrossCheckTotals& totals) {
  std::string text = fmt::format("{:<20}{:>14}{:>14}{:>12}{:>10}{:>10}{:>12}\n", "scenes", "texels", "identical", "rounding", "tie", "unbounded", "unexplained");
  const auto line = [&](const std::string& name, const ClassCounts& n) {
    text += fmt::format("{:<20}{:>14}{:>14}{:>12}{:>10}{:>10}{:>12}\n", name, n.total(), n[TexelClass::identical], n[TexelClass::rounding], n[TexelClass::tie],
                        n[TexelClass::unbounded], n[TexelClass::unexplained]);
  };
  for (int k = 0; k < kSceneKindCount; ++k) line(to_string(static_cast<SceneKind>(k)), totals.by_kind[static_cast<std::size_t>(k)]);
  line("all", totals.total);
  text += fmt::format("seeds {} to {}; largest share of a bound: rounding {:.3f}, tie {:.3f}\n", totals.first_seed, totals.next_seed - 1,
                      totals.largest_rounding_share, totals.largest_tie_share);
  for (const std::string& failure : totals.failures) text += failure + "\n";
  return text;
}

}  // namespace etalon::test
