#include "validation/studies/horbelt_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/base/error.h"
#include "core/draw/scene.h"
#include "validation/joint/terrain_problem.h"
#include "validation/metrics/decibel.h"
#include "validation/studies/horbelt_maps.h"

namespace etalon::validation {
namespace {

constexpr std::size_t kMappedFaces = 8000;  // "~8K triangles" (Figure 2)

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

joint::Path path_of(const joint::Problem& problem, HorbeltMethod method) {
  using joint::Direction, joint::StepRule;
  switch (method) {
    case HorbeltMethod::slope: return joint::marginal_analysis(problem);
    case HorbeltMethod::printed: return joint::marginal_analysis(problem, {.rule = StepRule::printed});
    case HorbeltMethod::budget: return joint::marginal_analysis(problem, {.rule = StepRule::budget});
    case HorbeltMethod::grow_slope: return joint::marginal_analysis(problem, {.direction = Direction::grow});
    case HorbeltMethod::grow_printed: return joint::marginal_analysis(problem, {.rule = StepRule::printed, .direction = Direction::grow});
    case HorbeltMethod::texture_first: return joint::one_sided_path(problem, joint::OneSided::texture_pruned_first);
    case HorbeltMethod::mesh_first: return joint::one_sided_path(problem, joint::OneSided::mesh_pruned_first);
    case HorbeltMethod::independent: return joint::independent_path(problem);
  }
  return {};
}

// The stair in the middle of the costs, and beside it pairs within 3 % of its bits: that of the finest texture and that of the finest mesh.
std::vector<HorbeltTrade> trades_of(const joint::Problem& problem, const HorbeltViewResult& view, TerrainProblem& terrain) {
  const std::vector<std::uint64_t> budgets =
      joint::log_spaced_budgets(view.stairs.front().bits, std::max(view.stairs.back().bits, view.stairs.front().bits + 1), 3);
  const joint::Staircase staircase(problem, view.all);
  const joint::Staircase::Stair best = *staircase.at(budgets[1]);
  joint::Pair finest_texture = best.pair, finest_mesh = best.pair;
  for (std::size_t i = 0; i < view.all.mesh_count; ++i)
    for (std::size_t j = 0; j < view.all.texture_count; ++j) {
      const std::uint64_t bits = problem.bits(i, j);
      if (bits > best.bits || 100 * bits < 97 * best.bits) continue;
      if (j > finest_texture.texture) finest_texture = {i, j};
      if (i > finest_mesh.mesh) finest_mesh = {i, j};
    }
  std::vector<HorbeltTrade> trades;
  const std::size_t last_mesh = view.all.mesh_count - 1, last_texture = view.all.texture_count - 1;
  for (const joint::Pair pair : {finest_texture, best.pair, finest_mesh}) {
    const auto error = static_cast<double>(std::max<std::uint64_t>(1, view.all.error(pair)));
    trades.push_back({pair, problem.bits(pair.mesh, pair.texture), view.psnr_db(pair),
                      static_cast<double>(view.all.error({pair.mesh, last_texture})) / error,
                      static_cast<double>(view.all.error({last_mesh, pair.texture})) / error,
                      without_alpha(terrain.errors().picture(pair.mesh, pair.texture))});
  }
  return trades;
}

// Every frame of the path on both renderers: each mesh's coordinates, then each pair's lookup through the exact ones.
void check_on_device(HorbeltViewResult& view, TerrainProblem& terrain, Renderer& exact, const HorbeltStudyOptions& options,
                     const std::function<void(std::size_t, std::size_t)>& progress) {
  const DiffOptions how{.worst_count = 0, .keep_class_image = false};
  const auto compare = [&](const DrawList& list, Frame frame) {
    frame.state = options.device->supported_state(frame.state);
    const std::vector<Image> cpu = exact.render(list, frame), gl = options.device->render(list, frame);
    view.checked += diff_images(list, frame, *options.device_model, cpu, gl, how).counts;
    ++view.checked_frames;
  };
  const joint::Path& path = view.of(HorbeltMethod::slope).path;
  std::optional<std::size_t> drawn_mesh;
  std::shared_ptr<const Image> coordinates;
  for (std::size_t n = 0; n < path.points.size(); ++n) {
    progress(n, path.points.size());
    const joint::Pair pair = path.points[n].pair;
    if (drawn_mesh != pair.mesh) {
      const PictureFrame& picture = terrain.frame();
      Frame frame{.width = picture.width, .height = picture.height, .guard = 2048, .state = {}, .targets = {}};
      frame.targets = {{TargetContent::coordinate, kRg32f, {}}, {TargetContent::triangle_id, kR32ui, {}}};
      frame.state = options.device->supported_state(frame.state);
      const Mesh mesh = terrain.mesh(pair.mesh);
      compare(make_scene(mesh, {Material{}}, picture.camera, frame), frame);
      coordinates = draw_coordinates(exact, mesh, picture).coordinates;
      drawn_mesh = pair.mesh;
    }
    const LookupPass pass =
        lookup_pass(*options.device, std::make_shared<const Image>(opaque_rgba(terrain.textures()[pair.texture])), coordinates);
    compare(pass.list, pass.frame);
  }
}

void fill_levels(HorbeltViewResult& result, const joint::JointLevels& levels) {
  result.mesh_bits = levels.mesh_bits, result.texture_bits = levels.texture_bits;
  result.vertices = levels.levels.vertex_counts;
  result.significant = levels.significant, result.significant_total = levels.significant_total;
}

void draw_maps(HorbeltViewResult& result, const HorbeltSubject& subject, const TerrainProblem& terrain) {
  while (result.mapped_mesh + 1 < result.vertices.size() && 2 * result.vertices[result.mapped_mesh] < kMappedFaces) ++result.mapped_mesh;
  result.mapped_texture = terrain.textures().size() - 1;
  const Mesh mesh = terrain.mesh(result.mapped_mesh);
  result.mapped_faces = mesh.face_count();
  result.mesh_map = mesh_from_above(mesh, subject.field, result.view.view);
  result.texture_map = texture_from_above(terrain.textures()[result.mapped_texture], subject.field, result.view.view);
}

void draw_distances(HorbeltViewResult& result, const HorbeltSubject& subject, const HorbeltStudyOptions& options) {
  joint::LevelOptions how = options.levels;
  how.meshes = 2, how.textures = std::min(how.textures, joint::kMostDistances), how.pyramid = joint::TexturePyramid::distance;
  const joint::JointLevels levels = joint::make_joint_levels(subject.field, subject.image, result.view.view, how);
  // Levels that come out equal are one: those that there are, by the step at which they were completed.
  const std::size_t last = levels.texture_ends_bytes.size() - 1;
  std::vector<std::size_t> shown = {last, last / 2, 0};
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  const std::vector<Image> textures = joint::texture_levels(levels);
  for (const std::size_t j : shown)
    result.distances.push_back({joint::distance_of(levels, j), levels.significant[j], levels.texture_bits[j],
                                texture_from_above(textures[j], subject.field, result.view.view)});
}

class Study {
 public:
  Study(Renderer& exact, const HorbeltStudyOptions& options, std::size_t views, std::size_t subjects)
      : exact_(exact), options_(options), total_(static_cast<int>(3 * views + subjects * options.flight_frames)) {}

  HorbeltViewResult view(const HorbeltSubject& subject, const NamedTerrainView& named, bool is_checked) {
    const std::string label = subject.name + ", " + named.name;
    HorbeltViewResult result;
    result.view = named;
    begin(label + ": levels");
    const Stopwatch level_time;
    TerrainProblem terrain = problem_of(subject, named);
    result.level_seconds = level_time.seconds();
    fill_levels(result, terrain.levels());
    const Mesh full = full_mesh(subject.field);
    result.faces = full.faces.size();
    result.visible_faces = visible_triangles(exact_, full, terrain.frame());
    result.samples = terrain.errors().samples();
    const joint::Problem problem = terrain.problem();
    begin(label + ": all pairs");
    const Stopwatch search_time;
    joint::Path slope = path_of(problem, HorbeltMethod::slope);
    result.search_seconds = search_time.seconds();
    const Stopwatch exhaustive_time;
    result.all = joint::evaluate_all(problem);
    result.exhaustive_seconds = exhaustive_time.seconds();
    compare_methods(result, problem);
    result.trades = trades_of(problem, result, terrain);
    result.full = without_alpha(terrain.errors().reference());
    result.finest = without_alpha(terrain.errors().picture(result.vertices.size() - 1, result.texture_bits.size() - 1));
    draw_maps(result, subject, terrain);
    draw_distances(result, subject, options_);
    begin(label + ": on the device");
    if (is_checked && options_.device != nullptr && options_.device_model)
      check_on_device(result, terrain, exact_, options_, [&](std::size_t, std::size_t) { report(label + ": on the device"); });
    return result;
  }

  void flight(const HorbeltSubject& subject, HorbeltSubjectResult& result) {
    if (options_.flight_frames == 0) return;
    result.flight_budget_bits = result.views.front().trades[1].bits;
    FlightOptions how{.frames = options_.flight_frames,
                      .width = std::max(1, options_.width / 2),
                      .height = std::max(1, options_.height / 2),
                      .budget_bits = result.flight_budget_bits,
                      .levels = options_.levels};
    how.before_frame = [&](std::size_t) { begin(subject.name + ": flight"); };
    result.flight = fly_over(exact_, subject.field, subject.image, how);
  }

 private:
  [[nodiscard]] TerrainProblem problem_of(const HorbeltSubject& subject, const NamedTerrainView& named) const {
    try {
      return {exact_, subject.field, subject.image, named.view, options_.levels};
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}, {}: {}", subject.name, named.name, error.what()));
    }
  }

  void begin(const std::string& label) { report(label), ++done_; }
  void report(const std::string& label) const {
    if (options_.progress) options_.progress(label, std::min(done_, total_ - 1), total_);
  }

  static void compare_methods(HorbeltViewResult& result, const joint::Problem& problem) {
    const joint::Staircase staircase(problem, result.all);
    result.stairs = staircase.stairs();
    joint::Problem known = problem;  // all errors are known by now: paths are found in the table
    known.error = [&](std::size_t i, std::size_t j) { return result.all.error({i, j}); };
    for (const HorbeltMethod method : kHorbeltMethods) {
      joint::Path path = joint::with_errors(path_of(known, method), result.all);
      const PathGaps gaps = path_gaps(path, result.all, staircase);
      result.outcomes.push_back({method, std::move(path), gaps});
    }
  }

  Renderer& exact_;
  const HorbeltStudyOptions& options_;
  int done_ = 0, total_;
};

}  // namespace

const char* to_string(HorbeltMethod method) {
  switch (method) {
    case HorbeltMethod::slope: return "slope";
    case HorbeltMethod::printed: return "printed";
    case HorbeltMethod::budget: return "budget";
    case HorbeltMethod::grow_slope: return "slope, growing";
    case HorbeltMethod::grow_printed: return "printed, growing";
    case HorbeltMethod::texture_first: return "texture pruned first";
    case HorbeltMethod::mesh_first: return "mesh pruned first";
    case HorbeltMethod::independent: return "independent";
  }
  return "";
}

const HorbeltOutcome& HorbeltViewResult::of(HorbeltMethod method) const {
  const auto found = std::ranges::find(outcomes, method, &HorbeltOutcome::method);
  ETALON_CHECK(found != outcomes.end(), to_string(method));
  return *found;
}

std::optional<double> HorbeltViewResult::psnr_db(joint::Pair pair) const {
  return validation::psnr_db(static_cast<double>(all.error(pair)), samples, 255);
}

std::uint64_t HorbeltStudyResult::unexplained() const {
  std::uint64_t texels = 0;
  for (const HorbeltSubjectResult& subject : subjects)
    for (const HorbeltViewResult& view : subject.views) texels += view.checked[TexelClass::unexplained];
  return texels;
}

HorbeltStudyResult run_horbelt_study(const std::vector<HorbeltSubject>& subjects, Renderer& exact, const HorbeltStudyOptions& options) {
  HorbeltStudyResult result;
  result.exact_name = exact.name();
  if (options.device != nullptr) result.device_name = options.device->name();
  std::size_t view_count = 0;
  for (const HorbeltSubject& subject : subjects) view_count += subject.views.empty() ? options.view_count : subject.views.size();
  Study study(exact, options, view_count, subjects.size());
  for (std::size_t s = 0; s < subjects.size(); ++s) {
    const HorbeltSubject& subject = subjects[s];
    result.inputs.insert(result.inputs.end(), subject.inputs.begin(), subject.inputs.end());
    result.subjects.push_back(
        {subject.name, subject.title, subject.joint_command, subject.notes, subject.warnings, !subject.views.empty(), {}, 0, {}});
    std::vector<NamedTerrainView> views = subject.views;
    if (views.empty()) {
      views = terrain_views(exact, subject.field, options.width, options.height);
      views.resize(std::min(views.size(), options.view_count));
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      const bool is_checked = s == options.checked_subject && v < options.checked_views;
      result.subjects.back().views.push_back(study.view(subject, views[v], is_checked));
      if (options.on_view) options.on_view(subject.name, result.subjects.back().views.back());
    }
    study.flight(subject, result.subjects.back());
  }
  return result;
}

}  // namespace etalon::validation
