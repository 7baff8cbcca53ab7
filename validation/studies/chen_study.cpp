#include "validation/studies/chen_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "validation/studies/chen_levels.h"
#include "validation/studies/normal_texture.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {
namespace {

constexpr double kCloseUp = 4;
constexpr int kOversampling = 2;  // of pictures
constexpr std::size_t kSharedObjects = 2;
constexpr int kPlaneTexture = 512;

class Steps {
 public:
  Steps(const ChenStudyOptions& options, int total) : options_(options), total_(total) {}
  void begin(const std::string& label) {
    if (options_.progress) options_.progress(label, std::min(done_, total_ - 1), total_);
    ++done_;
  }

 private:
  const ChenStudyOptions& options_;
  int done_ = 0, total_;
};

int steps_of(const ChenSubject& subject) { return 4 + 2 * static_cast<int>(subject.levels.size()); }

TexturedMesh drawn_as(const ChenLevel& level, ChenMethod method, std::size_t texture, const std::shared_ptr<const Image>& original) {
  switch (method) {
    case ChenMethod::qem5: return {&level.mesh, original, nullptr};
    case ChenMethod::aps: return {&level.by_deviation, original, nullptr};
    case ChenMethod::adapted: return {&level.mesh, level.adapted[texture], nullptr};
    case ChenMethod::indexed: return {&level.mesh, original, level.map};
    case ChenMethod::analytic: return {&level.mesh, original, level.analytic};
    case ChenMethod::rebaked: return {&level.mesh, level.rebaked[texture], nullptr};
  }
  return {};
}

struct Originals {
  std::vector<std::shared_ptr<const Image>> textures;
};

/// The dB of every outcome: view by view, so that only one view's pictures are held.
void compare_views(const ChenSubject& subject, const std::vector<ChenLevel>& levels, const Originals& originals, ChenSubjectResult& result,
                   Renderer& exact, const ChenStudyOptions& options, Steps& steps) {
  steps.begin(fmt::format("{}: {} views", subject.name, options.view_count));
  const BoundingBox box = bounding_box(subject.mesh);
  std::vector<PictureSums> sums(result.outcomes.size());
  for (int i = 0; i < options.view_count; ++i) {
    const Camera camera = view_of_24(box, i);
    for (std::size_t t = 0; t < originals.textures.size(); ++t) {
      const DrawnView full =
          draw_textured(exact, {&subject.mesh, originals.textures[t], nullptr}, camera, options.views_px, options.views_px);
      for (std::size_t n = 0; n < sums.size(); ++n) {
        const ChenOutcome& o = result.outcomes[n];
        if (o.texture != t) continue;
        const TexturedMesh what = drawn_as(levels[o.level], o.method, t, originals.textures[t]);
        sums[n].add(full, draw_textured(exact, what, camera, options.views_px, options.views_px));
      }
    }
  }
  for (std::size_t n = 0; n < sums.size(); ++n) {
    ChenOutcome& o = result.outcomes[n];
    o.masked_db = sums[n].masked_db(), o.whole_db = sums[n].whole_db();
    if (sums[n].detail_a > 0) o.detail = static_cast<double>(sums[n].detail_b) / static_cast<double>(sums[n].detail_a);
  }
}

/// Figure 10, on the coarsest level and one texture.
void compare_formats(const ChenSubject& subject, const ChenLevels& levels, const Originals& originals, ChenSubjectResult& result,
                     Renderer& exact, const ChenStudyOptions& options, Steps& steps) {
  const std::shared_ptr<const Image>& texture = originals.textures[result.formats_texture];
  steps.begin(subject.name + ": formats of the map");
  const ChenLevel& coarsest = levels.levels.back();
  const BoundingBox box = bounding_box(subject.mesh);
  std::vector<PictureSums> sums;
  for (ChenFormat& format : adapt_in_formats(exact, levels.sequence, levels.borders, coarsest.level, *coarsest.analytic))
    result.formats.push_back({std::move(format), {}, {}}), sums.emplace_back();
  for (int i = 0; i < options.view_count; ++i) {
    const Camera camera = view_of_24(box, i);
    const auto drawn = [&](const TexturedMesh& what) { return draw_textured(exact, what, camera, options.views_px, options.views_px); };
    const DrawnView full = drawn({&subject.mesh, texture, nullptr});
    for (std::size_t n = 0; n < sums.size(); ++n) sums[n].add(full, drawn({&coarsest.mesh, texture, result.formats[n].format.map}));
  }
  for (std::size_t n = 0; n < sums.size(); ++n) result.formats[n].masked_db = sums[n].masked_db();
  const std::vector<int> sizes = {options.map_size / 4, options.map_size, 2 * options.map_size};
  result.inverses = adapt_there_and_back(exact, levels.sequence, levels.borders, coarsest.level, sizes,
                                         [&](int size) { steps.begin(fmt::format("{}: {}² maps down and up again", subject.name, size)); });
}

/// Pictures at twice the size, the shown square of the full mesh cut out, averaged down.
class Pictures {
 public:
  Pictures(const ChenSubject& subject, Renderer& exact, const ChenStudyOptions& options, const Camera& camera)
      : subject_(subject), exact_(exact), size_(kOversampling * options.picture_px), camera_(camera) {}

  [[nodiscard]] DrawnView drawn(const TexturedMesh& what) const { return draw_textured(exact_, what, camera_, size_, size_); }
  [[nodiscard]] Image shown(DrawnView view, bool normals) const {
    if (normals) view.color = lit_by_normals(view.color, subject_.light);
    return averaged_down(on_paper(view), kOversampling);
  }

 private:
  const ChenSubject& subject_;
  Renderer& exact_;
  int size_;
  Camera camera_;
};

/// The colours of `view` where `original` shows the surface too, elsewhere those of `original`: a moved outline is no fault of a texture.
Image colors_within(const DrawnView& original, const DrawnView& view) {
  Image colors = original.color;
  for (int y = 0; y < colors.height(); ++y)
    for (int x = 0; x < colors.width(); ++x)
      if (*original.id.channels<std::uint32_t>(x, y) != kNoTriangle && *view.id.channels<std::uint32_t>(x, y) != kNoTriangle)
        std::copy_n(view.color.texel(x, y), 4, colors.texel(x, y));
  return colors;
}

/// The camera turned and narrowed so that the full mesh fills the frame.
Camera close_up_of(const ChenSubject& subject, const Originals& originals, Renderer& exact, const Camera& camera, int size) {
  const ShownSquare shown = shown_square(draw_textured(exact, {&subject.mesh, originals.textures.front(), nullptr}, camera, size, size));
  const double side = size;
  return close_up({camera, size, size}, shown.x / side, shown.y / side, side / shown.side).camera;
}

void take_pictures(const ChenSubject& subject, const std::vector<ChenLevel>& levels, const Originals& originals, ChenSubjectResult& result,
                   Renderer& exact, const ChenStudyOptions& options, Steps& steps) {
  steps.begin(subject.name + ": pictures");
  const BoundingBox box = bounding_box(subject.mesh);
  const int size = kOversampling * options.picture_px;
  const Camera camera = close_up_of(subject, originals, exact, named_view(subject.view, box, size, size), size);
  const Pictures pictures(subject, exact, options, camera);
  for (std::size_t t = 0; t < subject.textures.size(); ++t) {
    const bool normals = subject.textures[t].normals;
    const TexturedMesh full{&subject.mesh, originals.textures[t], nullptr};
    const DrawnView original = pictures.drawn(full);
    result.originals.push_back(pictures.shown(original, normals));
    // Where the unadapted picture of the coarsest level is worst, close.
    const Image worst = colors_within(original, pictures.drawn(drawn_as(levels.back(), ChenMethod::qem5, t, originals.textures[t])));
    const Vec2d at = worst_window(original.color, worst, kCloseUp);
    const Pictures close(subject, exact, options, close_up({camera, size, size}, at.x, at.y, kCloseUp).camera);
    result.originals_close.push_back(close.shown(close.drawn(full), normals));
    for (ChenOutcome& o : result.outcomes) {
      if (o.texture != t) continue;
      const TexturedMesh what = drawn_as(levels[o.level], o.method, t, originals.textures[t]);
      o.picture = pictures.shown(pictures.drawn(what), normals);
      if (o.level + 1 == levels.size()) o.closeup = close.shown(close.drawn(what), normals);
    }
    for (ChenFormatOutcome& f : result.formats)
      if (t == result.formats_texture)
        f.closeup = close.shown(close.drawn({&levels.back().mesh, originals.textures[t], f.format.map}), normals);
  }
}

ChenSubjectResult study_subject(const ChenSubject& subject, Renderer& exact, const ChenStudyOptions& options, Steps& steps,
                                std::vector<adapt::AdaptSequence>& sequences, std::optional<std::size_t> formats_texture) {
  ChenSubjectResult result;
  result.name = subject.name, result.title = subject.title;
  for (const VerifyInput& input : subject.inputs)
    if (result.attribution.empty()) result.attribution = input.attribution;
  result.faces = subject.mesh.face_count();
  result.paper_figure = subject.paper_figure, result.paper_row = subject.paper_row;
  Originals originals;
  std::vector<const Image*> textures;
  for (const ChenTexture& texture : subject.textures) {
    originals.textures.push_back(std::make_shared<const Image>(texture.image));
    textures.push_back(originals.textures.back().get());
    result.textures.push_back(texture.name);
  }
  ChenLevels levels = make_chen_levels(exact, subject.mesh, textures, subject.levels, options.map_size,
                                       [&](const std::string& label) { steps.begin(subject.name + ": " + label); });
  result.records = adapt::cell_statistics(levels.sequence);
  for (std::size_t t = 0; t < subject.textures.size(); ++t)
    for (std::size_t l = 0; l < levels.levels.size(); ++l)
      for (const ChenMethod method : kChenMethods) {
        ChenOutcome outcome;
        outcome.texture = t, outcome.level = l, outcome.method = method;
        outcome.faces = (method == ChenMethod::aps ? levels.levels[l].by_deviation : levels.levels[l].mesh).face_count();
        result.outcomes.push_back(std::move(outcome));
      }
  for (const ChenLevel& level : levels.levels) result.levels.push_back(level.mesh.face_count());
  if (formats_texture) result.formats_texture = *formats_texture;
  if (formats_texture) compare_formats(subject, levels, originals, result, exact, options, steps);
  if (subject.shows_parameterization)
    result.parameterization = parameterization_picture(exact, subject.mesh, originals.textures.front(), options.picture_px * 2);
  compare_views(subject, levels.levels, originals, result, exact, options, steps);
  take_pictures(subject, levels.levels, originals, result, exact, options, steps);
  steps.begin(subject.name + ": packs and times");
  result.packing = measure_packing(levels.mesh, levels.sequence, exact, options.device, options.map_size, options.device_singles);
  const std::optional<ChenCollapse> shown = showing_collapse(levels.mesh, levels.sequence);
  if (shown) result.collapse = shown;
  sequences.push_back(std::move(levels.sequence));
  return result;
}

/// The first subjects whose cells keep off the map's edge, where an atlas is not what a clamped map is; where there is one alone, two of it.
std::optional<ChenSharing> share(const std::vector<ChenSubject>& subjects, const std::vector<adapt::AdaptSequence>& sequences,
                                 Renderer& exact, const ChenStudyOptions& options) {
  std::vector<std::string> names;
  std::vector<const adapt::AdaptSequence*> shared;
  for (std::size_t n = 0; n < subjects.size() && shared.size() < kSharedObjects; ++n)
    if (keeps_off_edges(sequences[n], 0.5 / options.map_size)) names.push_back(subjects[n].name), shared.push_back(&sequences[n]);
  if (shared.empty()) return std::nullopt;
  if (shared.size() == 1) names.push_back(names.front()), shared.push_back(shared.front());
  return measure_sharing(names, shared, exact, options.device, options.map_size);
}

/// Subject and texture on which formats are compared: a checker shows them best, else the first will do.
std::pair<std::size_t, std::size_t> sharpest_texture(const std::vector<ChenSubject>& subjects) {
  for (std::size_t n = 0; n < subjects.size(); ++n)
    for (std::size_t t = 0; t < subjects[n].textures.size(); ++t)
      if (subjects[n].textures[t].name == "checker") return {n, t};
  return {0, 0};
}

void check(const ChenSubject& subject) {
  if (!subject.mesh.has_uv) throw InputError(subject.name + ": expected texture coordinates, got none");
  if (subject.textures.empty()) throw InputError(subject.name + ": expected a texture, got none");
  for (const Wedge& wedge : subject.mesh.wedges)
    if (std::min(wedge.uv.x, wedge.uv.y) <= -0.5f || std::max(wedge.uv.x, wedge.uv.y) >= 1.5f)
      throw InputError(
          fmt::format("{}: texture coordinates: expected less than half a texture outside of [0, 1], got ({}, {}): one texel of a "
                      "tiled texture shows many points of the surface",
                      subject.name, wedge.uv.x, wedge.uv.y));
  if (subject.levels.empty()) throw InputError(subject.name + ": expected a level at least, got none");
  std::size_t above = subject.mesh.face_count();
  for (const std::size_t level : subject.levels) {
    if (level >= above)
      throw InputError(fmt::format("{}: levels: expected descending numbers below {} faces, got {}", subject.name, above, level));
    above = level;
  }
}

}  // namespace

const char* to_string(ChenMethod method) {
  switch (method) {
    case ChenMethod::qem5: return "qem5";
    case ChenMethod::aps: return "aps";
    case ChenMethod::adapted: return "adapted";
    case ChenMethod::indexed: return "through the map";
    case ChenMethod::analytic: return "analytic";
    case ChenMethod::rebaked: return "re-baked";
  }
  return "";
}

const ChenOutcome& ChenSubjectResult::of(std::size_t texture, std::size_t level, ChenMethod method) const {
  for (const ChenOutcome& outcome : outcomes)
    if (outcome.texture == texture && outcome.level == level && outcome.method == method) return outcome;
  throw InputError(fmt::format("{}: no outcome of {}", name, to_string(method)));
}

ChenStudyResult run_chen_study(const std::vector<ChenSubject>& subjects, Renderer& exact, const ChenStudyOptions& options) {
  ChenStudyResult result;
  result.exact_name = exact.name();
  if (options.device != nullptr) result.device_name = options.device->name();
  result.map_size = options.map_size, result.views_px = options.views_px, result.view_count = options.view_count;
  int total = 6;  // formats, maps of three sizes there and back, objects together, the examples
  for (const ChenSubject& subject : subjects) {
    check(subject);
    total += steps_of(subject);
    for (const VerifyInput& input : subject.inputs)
      if (std::none_of(result.inputs.begin(), result.inputs.end(), [&](const VerifyInput& other) { return other.name == input.name; }))
        result.inputs.push_back(input);
  }
  Steps steps(options, total);
  const std::pair<std::size_t, std::size_t> formats = sharpest_texture(subjects);
  std::vector<adapt::AdaptSequence> sequences;
  for (const ChenSubject& subject : subjects) {
    const bool shows_formats = &subject == &subjects[formats.first];
    result.subjects.push_back(
        study_subject(subject, exact, options, steps, sequences, shows_formats ? std::optional(formats.second) : std::nullopt));
    if (options.on_subject) options.on_subject(result.subjects.back());
  }
  steps.begin("several objects in one pass");
  result.sharing = share(subjects, sequences, exact, options);
  steps.begin("the examples of figures 1 to 3");
  result.line = line_example();
  result.plane = plane_example(exact, kPlaneTexture);
  return result;
}

}  // namespace etalon::validation
