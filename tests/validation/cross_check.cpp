#include "tests/validation/cross_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace etalon::test {

using validation::ClassCounts;
using validation::DiffResult;
using validation::TexelClass;

CrossCheckTotals cross_check(Renderer& golden, Renderer& candidate, const validation::DeviceModel& device,
                             const CrossCheckOptions& options) {
  CrossCheckTotals totals;
  totals.first_seed = totals.next_seed = options.first_seed;
  const RasterState state = candidate.supported_state({});
  while (totals.total.total() < options.texels) {
    const std::uint64_t seed = totals.next_seed++;
    const RandomScene scene =
        options.exact ? make_exact_scene(seed, state, options.largest, options.nearest) : make_random_scene(seed, state, options.largest);
    const std::vector<Image> a = golden.render(scene.list, scene.frame), b = candidate.render(scene.list, scene.frame);
    const DiffResult diff = validation::diff_images(scene.list, scene.frame, device, a, b, {.worst_count = 3, .keep_class_image = false});
    totals.by_kind[static_cast<std::size_t>(scene.kind)] += diff.counts;
    totals.total += diff.counts;
    for (std::size_t i = 0; i < diff.unexplained_by.size(); ++i) totals.unexplained_by[i] += diff.unexplained_by[i];
    double& rounding_share = totals.rounding_share[static_cast<std::size_t>(scene.kind)];
    double& tie_share = totals.tie_share[static_cast<std::size_t>(scene.kind)];
    rounding_share = std::max(rounding_share, diff.largest_rounding_share);
    tie_share = std::max(tie_share, diff.largest_tie_share);
    if (!diff.agreed() && totals.failures.size() < 40) {
      totals.failures.push_back(fmt::format("seed {} ({}, {} x {}, guard {}): {} unexplained", seed, to_string(scene.kind),
                                            scene.frame.width, scene.frame.height, scene.frame.guard,
                                            diff.counts[TexelClass::unexplained]));
      for (const auto& report : diff.worst) {
        std::string bytes;
        for (std::size_t i = 0; i < report.golden_bytes.size(); ++i) {
          bytes +=
              fmt::format(" [{} {} | {}]", to_string(scene.frame.targets[i].content), report.golden_bytes[i], report.candidate_bytes[i]);
        }
        totals.failures.push_back("  " + report.sentence + bytes);
      }
    }
    if (options.progress) options.progress(totals);
  }
  return totals;
}

std::string format_totals(const CrossCheckTotals& totals) {
  std::string text = fmt::format("{:<20}{:>14}{:>14}{:>12}{:>10}{:>10}{:>12}   share of bound: rounding, tie\n", "scenes", "texels",
                                 "identical", "rounding", "tie", "unbounded", "unexplained");
  const auto line = [&](const std::string& name, const ClassCounts& n, double rounding_share, double tie_share) {
    text += fmt::format("{:<20}{:>14}{:>14}{:>12}{:>10}{:>10}{:>12}   {:.3f} {:.3f}\n", name, n.total(), n[TexelClass::identical],
                        n[TexelClass::rounding], n[TexelClass::tie], n[TexelClass::unbounded], n[TexelClass::unexplained], rounding_share,
                        tie_share);
  };
  for (std::size_t k = 0; k < kSceneKindCount; ++k) {
    line(to_string(static_cast<SceneKind>(k)), totals.by_kind[k], totals.rounding_share[k], totals.tie_share[k]);
  }
  line("all", totals.total, *std::max_element(totals.rounding_share.begin(), totals.rounding_share.end()),
       *std::max_element(totals.tie_share.begin(), totals.tie_share.end()));
  text += fmt::format("seeds {} to {}\n", totals.first_seed, totals.next_seed - 1);
  for (const std::string& failure : totals.failures) text += failure + "\n";
  return text;
}

}  // namespace etalon::test
