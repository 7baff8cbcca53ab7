#include "validation/studies/kim_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/base/error.h"
#include "validation/metrics/metro.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {

namespace {

constexpr double kCloseUp = 4;
constexpr std::size_t kTimedOnceFaces = 1'000'000;
constexpr double kUnitsInDiagonal = 8000;  // docs/decisions/0004-kim-unit.md
constexpr int kSweepHalfDecades = 8;       // to each side of the default: eight decades in all

simplify::SimplifyOptions options_of(KimMethod method) {
  simplify::SimplifyOptions options;
  switch (method) {
    case KimMethod::qem6: options.metric = simplify::MetricName::qem6; break;
    case KimMethod::qem6_full:
      options.metric = simplify::MetricName::qem6;
      options.collapse = simplify::CollapseKind::full;
      break;
    case KimMethod::kim: options.metric = simplify::MetricName::kim; break;
    case KimMethod::qem: options.metric = simplify::MetricName::qem; break;
  }
  return options;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The original, its pictures drawn once.
struct Originals {
  VertexColorView front;
  DrawnView drawn;
  ShownSquare shown;
  std::optional<Image> device_image;
  std::vector<VertexColorView> views;
  std::vector<Image> view_images;
  [[nodiscard]] Image shown_part(const Image& picture) const { return crop(picture, shown.x, shown.y, shown.side); }
};

class Steps {
 public:
  Steps(const KimStudyOptions& options, int total) : options_(options), total_(total) {}
  void begin(const std::string& label) {
    if (options_.progress) options_.progress(label, done_, total_);
    ++done_;
  }

 private:
  const KimStudyOptions& options_;
  int done_ = 0, total_;
};

Originals draw_originals(const KimSubject& subject, KimSubjectResult& result, Renderer& exact, const KimStudyOptions& options) {
  Originals originals;
  const BoundingBox box = bounding_box(subject.mesh);
  originals.front = {named_view("fit", box, options.picture_px, options.picture_px), options.picture_px, options.picture_px};
  originals.drawn = draw_view(exact, subject.mesh, originals.front);
  originals.shown = shown_square(originals.drawn);
  result.picture = originals.shown_part(picture_of(originals.drawn.color));
  if (options.device != nullptr) {
    DeviceView device = draw_on_device(exact, *options.device, options.device_model, subject.mesh, originals.front);
    result.device_classes = device.diff.counts;
    originals.device_image = std::move(device.color);
  }
  for (int i = 0; i < options.view_count; ++i) {
    originals.views.push_back({view_of_24(box, i), options.views_px, options.views_px});
    originals.view_images.push_back(draw_vertex_colors(exact, subject.mesh, originals.views.back()));
  }
  return originals;
}

void measure(const KimSubject& subject, const Mesh& simplified, const Originals& originals, KimOutcome& outcome, Renderer& exact,
             const KimStudyOptions& options) {
  const SurfaceDistance distance = measure_surfaces(subject.mesh, simplified, {.samples = options.metro_samples, .progress = {}});
  const double percent = distance.diagonal > 0 ? 100 / distance.diagonal : 0;
  outcome.mean = distance.mean() * percent;
  outcome.rms = distance.rms() * percent;
  outcome.max = distance.max() * percent;
  outcome.color_rms = distance.colour_rms().value_or(0);
  const DrawnView drawn = draw_view(exact, simplified, originals.front);
  const PictureError error = picture_error(originals.drawn, drawn);
  outcome.image_rms = error.rms;
  outcome.inside_rms = error.inside_rms;
  outcome.outline_share = error.outline_share;
  outcome.picture = originals.shown_part(picture_of(drawn.color));
  outcome.error = originals.shown_part(error_picture(originals.drawn.color, drawn.color, 0));
  if (options.device != nullptr) {
    const DeviceView device = draw_on_device(exact, *options.device, options.device_model, simplified, originals.front);
    outcome.device_classes = device.diff.counts;
    outcome.device_image_rms = rgb_rms(*originals.device_image, device.color);
  }
  double sum = 0;
  for (std::size_t i = 0; i < originals.views.size(); ++i)
    sum += rgb_rms(originals.view_images[i], draw_vertex_colors(exact, simplified, originals.views[i]));
  outcome.image_rms_views = sum / static_cast<double>(std::max<std::size_t>(1, originals.views.size()));
}

/// Close-ups where `kim` differs most from the original, the same place for all.
void take_close_ups(const KimSubject& subject, const std::vector<Mesh>& meshes, const Originals& originals, KimSubjectResult& result,
                    Renderer& exact) {
  std::size_t kim = 0;
  for (std::size_t i = 0; i < result.outcomes.size(); ++i)
    if (result.outcomes[i].method == KimMethod::kim) kim = i;
  const Image worst = draw_vertex_colors(exact, meshes[kim], originals.front);
  const Vec2d at = worst_window(originals.drawn.color, worst, kCloseUp);
  VertexColorView near = close_up(originals.front, at.x, at.y, kCloseUp);
  near.width = near.height = std::max(1, originals.front.width / 2);
  const Image original = draw_vertex_colors(exact, subject.mesh, near);
  result.closeup = picture_of(original);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Image drawn = draw_vertex_colors(exact, meshes[i], near);
    result.outcomes[i].closeup = picture_of(drawn);
    result.outcomes[i].closeup_error = error_picture(original, drawn, 0);
  }
}

std::vector<KimSweepPoint> sweep_units(const KimSubject& subject, const KimSubjectResult& result, const Originals& originals,
                                       Renderer& exact, const KimStudyOptions& options, Steps& steps) {
  std::vector<KimSweepPoint> points;
  const double half_decade = std::sqrt(10.0);
  double share = 1 / kUnitsInDiagonal;
  for (int i = 0; i < kSweepHalfDecades; ++i) share /= half_decade;
  for (int i = 0; i <= 2 * kSweepHalfDecades; ++i) {
    steps.begin(fmt::format("{}: unit {} of {}", subject.name, i + 1, 2 * kSweepHalfDecades + 1));
    simplify::SimplifyOptions how = options_of(KimMethod::kim);
    how.kim.unit = share * result.diagonal;
    how.target_faces = faces_for_vertices(subject.mesh, how, result.target_vertices);
    const Mesh mesh = simplify::simplify_mesh(subject.mesh, how).mesh;
    const SurfaceDistance distance = measure_surfaces(subject.mesh, mesh, {.samples = options.sweep_samples, .progress = {}});
    const double percent = distance.diagonal > 0 ? 100 / distance.diagonal : 0;
    points.push_back({share, distance.mean() * percent, distance.rms() * percent,
                      rgb_rms(originals.drawn.color, draw_vertex_colors(exact, mesh, originals.front))});
    share *= half_decade;
  }
  return points;
}

bool swept(const KimSubject& subject, const KimStudyOptions& options) { return subject.mesh.face_count() <= options.sweep_faces; }

KimSubjectResult study_subject(const KimSubject& subject, Renderer& exact, const KimStudyOptions& options, Steps& steps) {
  KimSubjectResult result;
  result.name = subject.name;
  for (const VerifyInput& input : subject.inputs)
    if (result.attribution.empty()) result.attribution = input.attribution;
  result.reduction = subject.reduction;
  result.paper_row = subject.paper_row;
  result.vertices = subject.mesh.vertex_count();
  result.faces = subject.mesh.face_count();
  // The paper's own counts are rounded to the nearest: 50,503 to 5,050, 50,052 to 5,005, 1,175,653 to 35,269 (down), so down it is.
  result.target_vertices = static_cast<std::size_t>(std::floor(static_cast<double>(result.vertices) * (1 - subject.reduction) + 1e-6));
  result.diagonal = bounding_box(subject.mesh).diagonal();
  steps.begin(subject.name + ": pictures of the original");
  const Originals originals = draw_originals(subject, result, exact, options);
  std::vector<Mesh> meshes;
  for (const KimMethod method : kKimMethods) {
    steps.begin(fmt::format("{}: {}", subject.name, to_string(method)));
    KimOutcome outcome;
    outcome.method = method;
    simplify::SimplifyOptions how = options_of(method);
    how.target_faces = faces_for_vertices(subject.mesh, how, result.target_vertices);
    const int repeats = subject.mesh.face_count() > kTimedOnceFaces ? 1 : std::max(1, options.time_repeats);
    simplify::SimplifyResult simplified;
    for (int i = 0; i < repeats; ++i) {
      const double start = cpu_seconds();
      simplified = simplify::simplify_mesh(subject.mesh, how);
      const double seconds = cpu_seconds() - start;
      outcome.seconds = i == 0 ? seconds : std::min(outcome.seconds, seconds);
    }
    outcome.vertices = simplified.mesh.vertex_count();
    outcome.faces = simplified.mesh.face_count();
    outcome.reached = simplified.stop == simplify::StopReason::faces;
    outcome.state_bytes_per_vertex = simplified.state_bytes_per_vertex;
    steps.begin(fmt::format("{}: {}: distances and pictures", subject.name, to_string(method)));
    measure(subject, simplified.mesh, originals, outcome, exact, options);
    result.outcomes.push_back(std::move(outcome));
    meshes.push_back(std::move(simplified.mesh));
  }
  take_close_ups(subject, meshes, originals, result, exact);
  if (swept(subject, options)) result.sweep = sweep_units(subject, result, originals, exact, options, steps);
  return result;
}

}  // namespace

const std::array<KimPaperRow, 3>& kim_paper_rows() {
  static const std::array<KimPaperRow, 3> kRows{{
      {"Monkey", 50'503, 101'002, 3.13, 5.46, 3.95, 3.44, 5.30, 4.69, 3.60, 4.44},
      {"Wood Duck", 50'052, 99'997, 3.13, 5.34, 7.60, 5.92, 11.32, 10.14, 9.07, 10.41},
      {"GIST Ari", 1'175'653, 2'351'302, 83.78, 143.20, 1.45, 0.82, 2.35, 1.41, 7.73, 9.62},
  }};
  return kRows;
}

const char* to_string(KimMethod method) {
  switch (method) {
    case KimMethod::qem6: return "qem6";
    case KimMethod::qem6_full: return "qem6 full-edge";
    case KimMethod::kim: return "kim";
    case KimMethod::qem: return "qem";
  }
  return "";
}

const KimOutcome& KimSubjectResult::of(KimMethod method) const {
  for (const KimOutcome& outcome : outcomes)
    if (outcome.method == method) return outcome;
  throw InputError(fmt::format("{}: no outcome of {}", name, to_string(method)));
}

std::uint64_t KimStudyResult::unexplained() const {
  std::uint64_t sum = 0;
  for (const KimSubjectResult& subject : subjects) {
    if (subject.device_classes) sum += (*subject.device_classes)[TexelClass::unexplained];
    for (const KimOutcome& outcome : subject.outcomes)
      if (outcome.device_classes) sum += (*outcome.device_classes)[TexelClass::unexplained];
  }
  return sum;
}

std::size_t faces_for_vertices(const Mesh& mesh, const simplify::SimplifyOptions& options, std::size_t vertices) {
  const std::size_t all = mesh.vertex_count();
  if (vertices >= all) return mesh.face_count();
  // Every collapse inside a surface takes two faces; where none is at a boundary, that is all there is to know.
  const std::size_t collapses = all - vertices, inside = mesh.face_count() - std::min(mesh.face_count(), 2 * collapses);
  std::size_t boundary_ends = 0;
  std::vector<std::uint32_t> out(all, 0);
  // A closed, consistently oriented surface: as many half-edges lead into a vertex from each neighbour as out of it; the sum of the neighbours'
  // numbers over faces, first minus second corner, is 0 at each vertex. One that is not shows a boundary; it may miss one, not invent one.
  for (const auto& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.wedges[face[k].index].vertex.index, b = mesh.wedges[face[(k + 1) % 3].index].vertex.index;
      out[a] += b;
      out[b] -= a;
    }
  for (const std::uint32_t sum : out) boundary_ends += sum != 0;
  if (boundary_ends == 0) return inside;
  simplify::SimplifyOptions counting = options;
  std::size_t done = 0, faces = 0;
  counting.target_faces = inside > mesh.face_count() / 50 ? inside - mesh.face_count() / 50 : 0;
  counting.progress = {};
  counting.after_collapse = [&](const simplify::CollapseMesh& now) {
    if (++done == collapses) faces = now.face_count();
  };
  (void)simplify::simplify_mesh(mesh, counting);
  return done >= collapses ? faces : counting.target_faces;
}

KimStudyResult run_kim_study(const std::vector<KimSubject>& subjects, Renderer& exact, const KimStudyOptions& options) {
  KimStudyResult result;
  result.exact_name = exact.name();
  if (options.device != nullptr) result.device_name = options.device->name();
  result.picture_px = options.picture_px;
  result.views_px = options.views_px;
  result.view_count = options.view_count;
  result.metro_samples = options.metro_samples;
  result.sweep_samples = options.sweep_samples;
  int total = 0;
  for (const KimSubject& subject : subjects) {
    if (subject.mesh.colors.empty()) throw InputError(fmt::format("{}: expected vertex colours, got none", subject.name));
    if (!(subject.reduction > 0) || !(subject.reduction < 1))
      throw InputError(fmt::format("{}: reduction: expected a share between 0 and 1, got {}", subject.name, subject.reduction));
    total += 1 + 2 * static_cast<int>(kKimMethods.size()) + (swept(subject, options) ? 2 * kSweepHalfDecades + 1 : 0);
    result.inputs.insert(result.inputs.end(), subject.inputs.begin(), subject.inputs.end());
  }
  Steps steps(options, total);
  for (const KimSubject& subject : subjects) {
    result.subjects.push_back(study_subject(subject, exact, options, steps));
    if (options.on_subject) options.on_subject(result.subjects.back());
  }
  return result;
}

}  // namespace etalon::validation
