#include "validation/verify/verify_joint.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/draw/scene.h"
#include "core/joint/marginal_analysis.h"
#include "core/procedural/alps.h"
#include "validation/joint/terrain_problem.h"
#include "validation/joint/terrain_views.h"
#include "validation/verify/verify_case.h"

namespace etalon::validation {
namespace {

constexpr int kHeights = 33, kTexels = 128, kMostFrame_px = 512;
constexpr std::size_t kPairs = 3;  ///< of the path: the smallest, one in the middle, the largest

class Comparison {
 public:
  Comparison(Renderer& exact, const VerifyDevice& device, const VerifyOptions& options, TerrainProblem& terrain, std::string view)
      : exact_(exact), device_(device), options_(options), terrain_(terrain), view_(std::move(view)) {}

  void add(const joint::PathPoint& point) {
    const auto [mesh_level, texture_level] = point.pair;
    const Mesh mesh = terrain_.mesh(mesh_level);
    Frame frame{.width = terrain_.frame().width, .height = terrain_.frame().height, .guard = 2048, .state = options_.state, .targets = {}};
    if (device_.renderer != nullptr) frame.state = device_.renderer->supported_state(frame.state);
    frame.targets = {{TargetContent::coordinate, kRg32f, {}}, {TargetContent::triangle_id, kR32ui, {}}};
    const auto scene_with_snap = [&](SnapRounding snap) {
      Frame other = frame;
      other.state.snap = snap;
      return make_scene(mesh, {Material{}}, terrain_.frame().camera, other);
    };
    const DrawList list = make_scene(mesh, {Material{}}, terrain_.frame().camera, frame);
    CaseResult coordinates = begun(
        fmt::format("mesh {}", mesh_level),
        fmt::format("Level {} of the mesh, {} triangles, drawn into its texture coordinates, rg float32.", mesh_level, mesh.face_count()));
    compare(coordinates, list, frame, scene_with_snap);

    const LookupPass pass = lookup_pass(device_.renderer != nullptr ? *device_.renderer : exact_,
                                        std::make_shared<const Image>(opaque_rgba(terrain_.textures()[texture_level])),
                                        std::make_shared<const Image>(std::move(exact_.render(list, frame).front())));
    CaseResult lookup =
        begun(fmt::format("mesh {}, texture {}", mesh_level, texture_level),
              fmt::format("Level {} of the texture by linear lookup at the exact coordinates; {} bytes of mesh and texture.", texture_level,
                          point.bits / 8));
    compare(lookup, pass.list, pass.frame, {});
  }

  [[nodiscard]] std::vector<CaseResult> cases() && { return std::move(cases_); }

 private:
  [[nodiscard]] CaseResult begun(const std::string& sampling, const std::string& description) const {
    CaseResult item;
    item.job = "joint", item.model = "terrain", item.view = view_;
    item.sampling = sampling, item.description = description;
    item.width = terrain_.frame().width, item.height = terrain_.frame().height;
    return item;
  }

  void compare(CaseResult& item, const DrawList& list, const Frame& frame, const std::function<DrawList(SnapRounding)>& again) {
    try {
      compare_case(item, list, frame, exact_, device_, options_, again);
      if (frame.targets.size() == 1) item.covered = static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height);
    } catch (const UnavailableError& error) {
      item.skipped = error.what();
    }
    cases_.push_back(std::move(item));
  }

  Renderer& exact_;
  const VerifyDevice& device_;
  const VerifyOptions& options_;
  TerrainProblem& terrain_;
  std::string view_;
  std::vector<CaseResult> cases_;
};

}  // namespace

JointCases joint_cases(Renderer& exact, const VerifyDevice& device, const VerifyOptions& options,
                       const std::function<void(std::size_t, std::size_t)>& progress) {
  procedural::Alps alps = procedural::make_alps({.size = kHeights, .texture_size = kTexels, .progress = {}});
  terrain::DemOptions dem;
  dem.dem_spacing = alps.spacing;
  const terrain::HeightField field = terrain::make_height_field(alps.dem, dem).field;
  const NamedTerrainView view = terrain_overview(field, std::min(options.width, kMostFrame_px), std::min(options.height, kMostFrame_px));
  try {
    TerrainProblem terrain(exact, field, alps.texture, view.view, {.meshes = 8, .textures = 6, .from = 0.01, .to = 0.5});
    const joint::Path path = joint::marginal_analysis(terrain.problem());
    Comparison comparison(exact, device, options, terrain, view.name);
    for (std::size_t n = 0; n < kPairs; ++n) {
      progress(n, kPairs);
      comparison.add(path.points[n * (path.points.size() - 1) / (kPairs - 1)]);
    }
    return {"", std::move(comparison).cases()};
  } catch (const InputError& error) {
    return {error.what(), {}};
  }
}

}  // namespace etalon::validation
