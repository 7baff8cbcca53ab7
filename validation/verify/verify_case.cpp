#include "validation/verify/verify_case.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include <fmt/format.h>

#include "core/base/error.h"
#include "validation/diagnosis.h"
#include "validation/texel_diff.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {
namespace {

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Both sides of a scene, and what they look like.
struct Pair {
  std::vector<Image> cpu, gl;                  // one per target; gl empty without a device
  std::vector<Image> cpu_picture, gl_picture;  // full size
};

void draw_both(CaseResult& item, Pair& pair, const DrawList& list, const Frame& frame, Renderer& exact, const VerifyDevice& device) {
  const Stopwatch cpu;
  pair.cpu = exact.render(list, frame);
  item.cpu_seconds = cpu.seconds();
  if (device.renderer == nullptr) return;
  const Stopwatch gl;
  pair.gl = device.renderer->render(list, frame);
  item.gl_seconds = gl.seconds();
}

ClassTally tally_of(const ClassCounts& counts) {
  ClassTally tally;
  tally.texels = counts.total();
  tally.identical = counts[TexelClass::identical];
  tally.rounding = counts[TexelClass::rounding];
  tally.tie = counts[TexelClass::tie];
  tally.unbounded = counts[TexelClass::unbounded];
  tally.unexplained = counts[TexelClass::unexplained];
  return tally;
}

// By the kind of decision that is broken: "coverage: 12 texels; value: 3 texels".
std::string broken_decisions(const DiffResult& diff) {
  std::string text;
  for (std::size_t cause = 0; cause < kCauseCount; ++cause) {
    if (diff.unexplained_by[cause] == 0) continue;
    const std::string name = cause == 0 ? "cause not told apart" : to_string(static_cast<Cause>(cause));
    text += fmt::format("{}{}: {} texels", text.empty() ? "" : "; ", name, diff.unexplained_by[cause]);
  }
  return text;
}

std::string diagnosis_of(const DiffResult& diff, const Pair& pair, const DrawList& list, const Frame& frame, const DeviceModel& model,
                         const std::function<DrawList(SnapRounding)>& scene_with_snap) {
  if (diff.agreed()) return "";
  DiagnosisOptions asked;
  asked.scene_with_snap = scene_with_snap;
  const std::vector<Hypothesis> hypotheses = diagnose(list, frame, model, pair.cpu, pair.gl, diff, asked);
  std::string text = broken_decisions(diff);
  if (hypotheses.empty()) return text + ". No usual mistake explains them.";
  const std::size_t shown = std::min<std::size_t>(hypotheses.size(), 3);
  text += ". Looks like ";
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("{}{} (explains {:.1f} % of them)", i > 0 ? ", or " : "", hypotheses[i].name, 100 * hypotheses[i].explained_share);
  return text + ".";
}

std::string short_name(TargetContent content) { return content == TargetContent::triangle_id ? "id" : to_string(content); }

// "texel (3, 4): triangle 7, …" → "Triangle 7, …": the place is shown apart.
std::string without_place(const std::string& sentence) {
  const std::size_t colon = sentence.rfind("texel (", 0) == 0 ? sentence.find("): ") : std::string::npos;
  std::string text = colon == std::string::npos ? sentence : sentence.substr(colon + 3);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

bool same_bytes(const Pair& pair, std::size_t target, int x, int y) {
  const std::size_t size = static_cast<std::size_t>(bytes_per_texel(pair.cpu[target].format()));
  return std::memcmp(pair.cpu[target].texel(x, y), pair.gl[target].texel(x, y), size) == 0;
}

std::size_t first_differing_target(const Pair& pair, int x, int y) {
  for (std::size_t t = 0; t < pair.cpu.size(); ++t) {
    if (!same_bytes(pair, t, x, y)) return t;
  }
  return 0;
}

// The targets in which the two sides differ at a texel, with the values of one side.
std::string side_text(const Pair& pair, const std::vector<Image>& side, const std::vector<TargetSpec>& targets, int x, int y) {
  std::string text;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (same_bytes(pair, t, x, y)) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", short_name(targets[t].content), texel_text(side[t], x, y));
  }
  return text;
}

WorstTexel worst_texel(const TexelReport& report, const Pair& pair, const std::vector<TargetSpec>& targets) {
  WorstTexel worst;
  worst.x = report.x;
  worst.y = report.y;
  worst.texel_class = to_string(report.verdict.texel_class);
  worst.cpu_value = side_text(pair, pair.cpu, targets, report.x, report.y);
  worst.gl_value = side_text(pair, pair.gl, targets, report.x, report.y);
  worst.explanation = without_place(report.sentence);
  const std::size_t shown = first_differing_target(pair, report.x, report.y);
  worst.cpu_crop = crop(pair.cpu_picture[shown], report.x, report.y, kCropSize);
  worst.gl_crop = crop(pair.gl_picture[shown], report.x, report.y, kCropSize);
  return worst;
}

// The worst first; but what is explained shares the room: of unbounded texels and of ties at most half each, of roundings one.
std::vector<const TexelReport*> shown_reports(const std::vector<TexelReport>& worst, int count) {
  std::vector<const TexelReport*> shown;
  std::array<int, kClassCount> taken{};
  for (const TexelReport& report : worst) {
    const TexelClass texel_class = report.verdict.texel_class;
    const int limit = texel_class == TexelClass::unexplained ? count : texel_class == TexelClass::rounding ? 1 : (count + 1) / 2;
    if (static_cast<int>(shown.size()) < count && taken[static_cast<std::size_t>(texel_class)]++ < limit) shown.push_back(&report);
  }
  return shown;
}

void classify(CaseResult& item, const Pair& pair, const DrawList& list, const Frame& frame, const VerifyDevice& device,
              const VerifyOptions& options, int reach, const std::function<DrawList(SnapRounding)>& scene_with_snap) {
  constexpr int kCandidates = 256;  // enough to find texels of each class among them
  const DiffResult diff = diff_images(list, frame, device.model, pair.cpu, pair.gl, {.worst_count = kCandidates, .keep_class_image = true});
  item.tally = tally_of(diff.counts);
  item.diagnosis = diagnosis_of(diff, pair, list, frame, device.model, scene_with_snap);
  for (const TexelReport* report : shown_reports(diff.worst, options.worst_count))
    item.worst.push_back(worst_texel(*report, pair, frame.targets));
  item.class_picture = reduced(class_picture(pair.cpu_picture.front(), diff.class_image, reach), options.picture_px);
}

std::uint64_t covered_texels(const Image& ids) {
  std::uint64_t count = 0;
  for (int y = 0; y < ids.height(); ++y) {
    for (int x = 0; x < ids.width(); ++x) count += *ids.channels<std::uint32_t>(x, y) != kNoTriangle ? 1 : 0;
  }
  return count;
}

void picture_targets(Pair& pair, const Frame& frame) {
  for (std::size_t t = 0; t < frame.targets.size(); ++t) {
    const bool is_depth = frame.targets[t].content == TargetContent::depth;
    const ValueRange range = is_depth ? drawn_range(pair.cpu[t]) : ValueRange{};
    pair.cpu_picture.push_back(picture_of(pair.cpu[t], range.low, range.high));
    if (!pair.gl.empty()) pair.gl_picture.push_back(picture_of(pair.gl[t], range.low, range.high));
  }
}

TargetResult measure_target(const Pair& pair, std::size_t t, const TargetSpec& spec, int picture_px, int reach) {
  TargetResult target;
  target.content = to_string(spec.content);
  target.format = to_string(spec.format);
  target.cpu_sha256 = pair.cpu[t].sha256();
  target.cpu_picture = reduced(pair.cpu_picture[t], picture_px);
  if (pair.gl.empty()) return target;
  target.gl_sha256 = pair.gl[t].sha256();
  target.difference = measure_difference(pair.cpu[t], pair.gl[t]);
  if (target.difference->identical) return target;
  target.gl_picture = reduced(pair.gl_picture[t], picture_px);
  target.error_picture = reduced(error_picture(pair.cpu[t], pair.gl[t], reach), picture_px);
  return target;
}

std::string channel_text(const Image& image, int x, int y, int c) {
  switch (image.format().type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return std::to_string(image.channels<std::uint8_t>(x, y)[c]);
    case ChannelType::unorm16: return std::to_string(image.channels<std::uint16_t>(x, y)[c]);
    case ChannelType::half: return fmt::format("{}", half_value(image.channels<std::uint16_t>(x, y)[c]));
    case ChannelType::float32: return fmt::format("{}", image.channels<float>(x, y)[c]);
    case ChannelType::uint32: {
      const std::uint32_t id = image.channels<std::uint32_t>(x, y)[c];
      return id == kNoTriangle ? "-" : std::to_string(id);
    }
  }
  return "";
}

}  // namespace

std::string texel_text(const Image& image, int x, int y) {
  std::string text;
  for (int c = 0; c < image.format().channels; ++c) text += (c > 0 ? " " : "") + channel_text(image, x, y, c);
  return text;
}

void compare_case(CaseResult& item, const DrawList& list, const Frame& frame, Renderer& exact, const VerifyDevice& device,
                  const VerifyOptions& options, const std::function<DrawList(SnapRounding)>& scene_with_snap) {
  ETALON_CHECK(!frame.targets.empty(), "a scene without targets");
  item.width = frame.width;
  item.height = frame.height;
  item.triangles = list.triangles.size();
  Pair pair;
  draw_both(item, pair, list, frame, exact, device);

  for (std::size_t t = 0; t < frame.targets.size(); ++t) {
    if (frame.targets[t].content == TargetContent::triangle_id) item.covered = covered_texels(pair.cpu[t]);
  }
  const Stopwatch compare;
  // A mark must survive the reduction of its picture, which keeps one texel of `step`, and be seen where the page shows it some 340 px wide.
  const int longest = std::max(frame.width, frame.height);
  const int step = (longest + options.picture_px - 1) / options.picture_px;
  const int reach = std::max({step, longest / 340, 1});
  picture_targets(pair, frame);
  if (device.renderer != nullptr) classify(item, pair, list, frame, device, options, reach, scene_with_snap);
  for (std::size_t t = 0; t < frame.targets.size(); ++t)
    item.targets.push_back(measure_target(pair, t, frame.targets[t], options.picture_px, reach));
  item.compare_seconds = compare.seconds();
}

}  // namespace etalon::validation
