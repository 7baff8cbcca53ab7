#include "validation/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"

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

class Trial {
 public:
  Trial(std::span<const Image> golden, std::span<const Image> candidate, std::vector<Texel> texels)
      : candidate_(candidate), texels_(std::move(texels)), nothing_(golden.size()) {}

  // Share of the texels that the candidate's bytes explain if this list, state and device were what was drawn.
  double share(const DrawList& list, const Frame& frame, const DeviceModel& device) const {
    const DiffInput input{list, frame, device, nothing_, candidate_};
    constexpr std::size_t kGrain = 512;
    std::vector<std::uint64_t> explained((texels_.size() + kGrain - 1) / kGrain, 0);
    TexelExplainer::SharedGrid grid;
    parallel_for_blocks(texels_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      TexelExplainer explainer(input, grid);
      for (std::size_t i = begin; i < end; ++i) {
        explained[begin / kGrain] += explainer.explain(texels_[i].x, texels_[i].y).texel_class <= TexelClass::tie;
      }
    });
    std::uint64_t sum = 0;
    for (const std::uint64_t n : explained) sum += n;
    return static_cast<double>(sum) / static_cast<double>(texels_.size());
  }

 private:
  std::span<const Image> candidate_;
  std::vector<Texel> texels_;
  std::vector<Image> nothing_;  // no golden: the explainer finds the visible triangle itself
};

// A copy with every vertex's uv changed, by the size of the image that its draw looks up at uv. Vertices are unshared first.
template <class Change>
DrawList with_uv(const DrawList& list, Change&& change) {
  DrawList out = list;
  out.vertices.clear();
  for (std::uint32_t t = 0; t < list.triangles.size(); ++t) {
    const Draw& draw = list.draw_of(t);
    const std::uint32_t image = draw.shading == Shading::indexed ? draw.indexing_map : draw.texture;
    for (std::size_t k = 0; k < 3; ++k) {
      RasterVertex v = list.vertices[list.triangles[t][k]];
      if (draw.shading != Shading::vertex_color) change(v.uv, *list.images[image]);
      out.triangles[t][k] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(v);
    }
  }
  return out;
}

template <class Change>
DrawList with_samplers(const DrawList& list, Change&& change) {
  DrawList out = list;
  for (Draw& draw : out.draws) {
    change(draw.sampler);
    change(draw.map_sampler);
  }
  return out;
}

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
  // Fill rule and sub-texel rounding touch only samples near an edge: a handful is what they leave. The others change nearly every texel,
  // so that a handful speaks against them.
  const auto touches_few = [](const std::string& name) { return name.rfind("fill rule", 0) == 0 || name.rfind("sub-texel", 0) == 0; };
  const auto ask = [&](const std::string& name, const DrawList& other_list, const Frame& other_frame, const DeviceModel& other_device) {
    const double share = trial.share(other_list, other_frame, other_device);
    if (share >= kNamedShare) found.push_back({name, share});
  };

  for (const FillRule rule : {FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax}) {
    if (rule == frame.state.fill_rule) continue;
    Frame other = frame;
    other.state.fill_rule = rule;
    ask("fill rule " + to_string(rule), list, other, device);
  }
  if (options.scene_with_snap) {
    for (const SnapRounding snap :
         {SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero, SnapRounding::floor}) {
      if (snap == frame.state.snap) continue;
      Frame other = frame;
      other.state.snap = snap;
      ask("sub-texel rounding " + to_string(snap), options.scene_with_snap(snap), other, device);
    }
  }
  const bool textured = std::any_of(list.draws.begin(), list.draws.end(), [](const Draw& d) { return d.shading != Shading::vertex_color; });
  if (textured) {
    for (const int axis : {0, 1}) {
      for (const float half : {0.5f, -0.5f}) {
        ask(fmt::format("texture coordinate shifted by {}1/2 texel in {}", half > 0 ? '+' : '-', axis == 0 ? 'u' : 'v'),
            with_uv(list, [&](Vec2f& uv,
                              const Image& image) { uv[axis] += half / static_cast<float>(axis == 0 ? image.width() : image.height()); }),
            frame, device);
      }
    }
    for (const float half : {0.5f, -0.5f}) {
      ask(fmt::format("texture coordinate shifted by {}1/2 texel in u and v", half > 0 ? '+' : '-'),
          with_uv(list,
                  [&](Vec2f& uv, const Image& image) {
                    uv += Vec2f(half / static_cast<float>(image.width()), half / static_cast<float>(image.height()));
                  }),
          frame, device);
    }
    ask("v flipped", with_uv(list, [](Vec2f& uv, const Image&) { uv.y = 1 - uv.y; }), frame, device);
    for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirrored_repeat}) {
      ask("wrap " + to_string(wrap), with_samplers(list, [&](Sampler& s) { s.wrap_u = s.wrap_v = wrap; }), frame, device);
    }
    for (const Filter filter : {Filter::nearest, Filter::linear}) {
      ask("filter " + to_string(filter), with_samplers(list, [&](Sampler& s) { s.filter = filter; }), frame, device);
    }
  }
  DeviceModel truncating = device;
  truncating.unorm_toward_zero = true;
  ask("unorm stored toward zero", list, frame, truncating);
  Frame other_half = frame;
  const bool was_nearest = frame.state.half_rounding == HalfRounding::nearest_even;
  other_half.state.half_rounding = was_nearest ? HalfRounding::toward_zero : HalfRounding::nearest_even;
  ask(was_nearest ? "half stored toward zero" : "half stored to nearest even", list, other_half, device);

  std::stable_sort(found.begin(), found.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.explained_share > b.explained_share; });
  const double few = std::max(16.0, options.isolated_share * static_cast<double>(diff.class_image.texel_count()));
  const bool edges_explain = !found.empty() && touches_few(found.front().name) && found.front().explained_share >= 0.5;
  if (static_cast<double>(count) <= few && !edges_explain) found.insert(found.begin(), {"isolated wrong bytes", 1.0});
  return found;
}

}  // namespace etalon::validation
