#include "validation/diagnosis.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "validation/mistakes.h"

namespace etalon::validation {

namespace {

// A mistake of the pipeline leaves few of its own texels unexplained; below a half it is chance, and naming it would mislead.
constexpr double kNamedShare = 0.5;

struct Texel {
  int x, y;
};

std::vector<Texel> sampled(const Image& classes, std::uint64_t count, std::size_t limit) {
  const std::uint64_t step = std::max<std::uint64_t>(1, (count + limit - 1) / std::max<std::size_t>(1, limit));
  std::vector<Texel> texels;
  std::uint64_t n = 0;
  for (int y = 0; y < classes.height(); ++y) {
    for (int x = 0; x < classes.width(); ++x) {
      if (*classes.channels<std::uint8_t>(x, y) != static_cast<std::uint8_t>(TexelClass::unexplained)) continue;
      if (n++ % step == 0) texels.push_back({x, y});
    }
  }
  return texels;
}

// Texels that show at once whether a mistake is worth all of them: a share of one half is seen below kPilotShare once in ten million.
constexpr std::size_t kPilotTexels = 512;
constexpr double kPilotShare = 0.38;
// A last resort is asked only where what was asked before explains less than this.
constexpr double kNearlyAll = 0.98;

class Trial {
 public:
  Trial(std::span<const Image> golden, std::span<const Image> candidate, std::vector<Texel> texels)
      : candidate_(candidate), texels_(std::move(texels)), nothing_(golden.size()) {
    const std::size_t step = std::max<std::size_t>(1, texels_.size() / kPilotTexels);
    for (std::size_t i = 0; i < texels_.size(); i += step) pilot_.push_back(texels_[i]);
  }

  // Share of the texels that the candidate's bytes explain if one of these drawings was what was made; of the pilot's where that is too small.
  double share(const Mistake& mistake) const {
    std::vector<Image> read;
    if (mistake.reading != CandidateReading::plain)
      for (const Image& image : candidate_) read.push_back(read_as(image, mistake.reading));
    const std::span<const Image> candidate = read.empty() ? candidate_ : std::span<const Image>(read);
    if (pilot_.size() < texels_.size()) {
      const double seen = share_of(pilot_, mistake, candidate);
      if (seen < kPilotShare) return seen;
    }
    return share_of(texels_, mistake, candidate);
  }

 private:
  double share_of(const std::vector<Texel>& texels, const Mistake& mistake, std::span<const Image> candidate) const {
    std::vector<std::uint8_t> explained(texels.size(), 0);
    for (const auto& make : mistake.alternatives) {
      const SupposedDrawing drawing = make();
      const DiffInput input{drawing.list, drawing.frame, drawing.device, nothing_, candidate};
      TexelExplainer::SharedGrid grid;
      parallel_for_blocks(texels.size(), 256, [&](std::size_t begin, std::size_t end) {
        TexelExplainer explainer(input, grid);
        for (std::size_t i = begin; i < end; ++i)
          if (explained[i] == 0) explained[i] = explainer.explain(texels[i].x, texels[i].y).texel_class <= TexelClass::tie ? 1 : 0;
      });
    }
    const auto count = std::count(explained.begin(), explained.end(), std::uint8_t{1});
    return static_cast<double>(count) / static_cast<double>(texels.size());
  }

  std::span<const Image> candidate_;
  std::vector<Texel> texels_, pilot_;
  std::vector<Image> nothing_;  // no golden: the explainer finds the visible triangle itself
};

}  // namespace

std::vector<Hypothesis> diagnose(const DrawList& list, const Frame& frame, const DeviceModel& device, std::span<const Image> golden,
                                 std::span<const Image> candidate, const DiffResult& diff, const DiagnosisOptions& options) {
  const std::uint64_t count = diff.counts[TexelClass::unexplained];
  if (diff.class_image.width() != frame.width || diff.class_image.height() != frame.height) {
    throw InputError("diagnosis: the diff was made without its class image, or of another frame");
  }
  std::vector<Hypothesis> found;
  if (count == 0) return found;
  const Trial trial(golden, candidate, sampled(diff.class_image, count, options.sample_limit));
  std::vector<Mistake> mistakes = usual_mistakes(list, frame, device);
  if (options.scene_with_snap) {
    for (const SnapRounding snap :
         {SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero, SnapRounding::floor}) {
      if (snap == frame.state.snap) continue;
      const auto make = [&, snap] {
        SupposedDrawing drawing{options.scene_with_snap(snap), frame, device};
        drawing.frame.state.snap = snap;
        return drawing;
      };
      mistakes.push_back({"sub-texel rounding " + to_string(snap), {make}, CandidateReading::plain, true});
    }
  }
  // Fill rule and sub-texel rounding touch only samples near an edge: a handful is what they leave. The others change nearly every texel,
  // so that a handful speaks against them.
  bool edges_explain = false;
  double best = 0;
  for (const Mistake& mistake : mistakes) {
    if (mistake.last_resort && best >= kNearlyAll) continue;
    double share = 0;
    try {
      share = trial.share(mistake);
    } catch (const InputError&) {
      continue;  // such a drawing is beyond the contract's ranges: it cannot have been made
    }
    if (share < kNamedShare) continue;
    found.push_back({mistake.name, share});
    if (share > best) edges_explain = mistake.touches_few;
    best = std::max(best, share);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.explained_share > b.explained_share; });
  const double few = std::max(16.0, options.isolated_share * static_cast<double>(diff.class_image.texel_count()));
  if (static_cast<double>(count) <= few && !edges_explain) found.insert(found.begin(), {"isolated wrong bytes", 1.0});
  return found;
}

}  // namespace etalon::validation
