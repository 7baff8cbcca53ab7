#include "validation/verify/verify_case.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/base/error.h"
#include "validation/diagnosis.h"
#include "validation/texel_diff.h"
#include "validation/verify/drawn_pair.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {
namespace {

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void draw_both(CaseResult& item, DrawnPair& pair, const DrawList& list, const Frame& frame, Renderer& exact, const VerifyDevice& device) {
  const Stopwatch cpu;
  pair.cpu = exact.render(list, frame);
  item.cpu_seconds = cpu.seconds();
  if (device.renderer == nullptr) return;
  const Stopwatch gl;
  pair.gl = device.renderer->render(list, frame);
  item.gl_seconds = gl.seconds();
}

// By the kind of decision that is broken: "coverage: 12 texels; value: 3 texels".
std::string broken_decisions(const DiffResult& diff) {
  std::string text;
  for (std::size_t cause = 0; cause < kCauseCount; ++cause) {
    if (diff.unexplained_by[cause] == 0) continue;
    const std::string name = cause == 0 ? "cause not told apart" : to_string(static_cast<Cause>(cause));
    text += fmt::format("{}{}: {} texel{}", text.empty() ? "" : "; ", name, diff.unexplained_by[cause],
                        diff.unexplained_by[cause] == 1 ? "" : "s");
  }
  return text;
}

std::vector<NamedCause> causes_of(const DiffResult& diff, const DrawnPair& pair, const DrawList& list, const Frame& frame,
                                  const DeviceModel& model, const std::function<DrawList(SnapRounding)>& scene_with_snap) {
  std::vector<NamedCause> causes;
  if (diff.agreed()) return causes;
  DiagnosisOptions asked;
  asked.scene_with_snap = scene_with_snap;
  for (const Hypothesis& h : diagnose(list, frame, model, pair.cpu, pair.gl, diff, asked)) causes.push_back({h.name, h.explained_share});
  return causes;
}

std::string diagnosis_of(const DiffResult& diff, const std::vector<NamedCause>& causes) {
  if (diff.agreed()) return "";
  std::string text = broken_decisions(diff);
  if (causes.empty()) return text + ". No usual mistake explains them.";
  const std::size_t shown = std::min<std::size_t>(causes.size(), 3);
  text += ". Looks like ";
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("{}{} (explains {:.1f} % of them)", i > 0 ? ", or " : "", causes[i].name, 100 * causes[i].share);
  return text + ".";
}

std::uint64_t covered_texels(const Image& ids) {
  std::uint64_t count = 0;
  for (int y = 0; y < ids.height(); ++y) {
    for (int x = 0; x < ids.width(); ++x) count += *ids.channels<std::uint32_t>(x, y) != kNoTriangle ? 1 : 0;
  }
  return count;
}

}  // namespace

DiffResult classify_case(CaseResult& item, const DrawnPair& pair, const DrawList& list, const Frame& frame, const DeviceModel& model,
                         const VerifyOptions& options, int reach, const std::function<DrawList(SnapRounding)>& scene_with_snap) {
  constexpr int kCandidates = 256;  // enough to find texels of each class among them
  DiffResult diff = diff_images(list, frame, model, pair.cpu, pair.gl, {.worst_count = kCandidates, .keep_class_image = true});
  item.tally = tally_of(diff.counts);
  item.causes = causes_of(diff, pair, list, frame, model, scene_with_snap);
  item.diagnosis = diagnosis_of(diff, item.causes);
  item.worst = worst_texels(diff, pair, frame.targets, options.worst_count);
  item.class_picture = reduced(class_picture(pair.cpu_picture.front(), diff.class_image, reach), options.picture_px);
  return diff;
}

void compare_case(CaseResult& item, const DrawList& list, const Frame& frame, Renderer& exact, const VerifyDevice& device,
                  const VerifyOptions& options, const std::function<DrawList(SnapRounding)>& scene_with_snap) {
  ETALON_CHECK(!frame.targets.empty(), "a scene without targets");
  item.width = frame.width;
  item.height = frame.height;
  item.triangles = list.triangles.size();
  DrawnPair pair;
  draw_both(item, pair, list, frame, exact, device);

  for (std::size_t t = 0; t < frame.targets.size(); ++t) {
    if (frame.targets[t].content == TargetContent::triangle_id) item.covered = covered_texels(pair.cpu[t]);
  }
  const Stopwatch compare;
  const int reach = mark_reach(frame, options.picture_px);
  picture_targets(pair, frame);
  if (device.renderer != nullptr) (void)classify_case(item, pair, list, frame, device.model, options, reach, scene_with_snap);
  for (std::size_t t = 0; t < frame.targets.size(); ++t)
    item.targets.push_back(measure_target(pair, t, frame.targets[t], options.picture_px, reach));
  item.compare_seconds = compare.seconds();
}

}  // namespace etalon::validation
