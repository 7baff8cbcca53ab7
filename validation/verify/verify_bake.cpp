#include "validation/verify/verify_bake.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/bake/bake.h"
#include "core/base/error.h"
#include "validation/verify/verify_case.h"
#include "validation/verify/vertex_lookups.h"

namespace etalon::validation {
namespace {

/// Of the 24: from (0, 1, 2) and (0, −1, −2), opposite to each other.
constexpr const char* kBakeViews[] = {"0/24", "3/24"};
constexpr std::size_t kMostFaces = 300, kFewestFaces = 4;

bool has_texture(const VerifyModel& model) {
  return model.mesh.has_uv &&
         std::any_of(model.materials.begin(), model.materials.end(), [](const Material& material) { return material.texture != nullptr; });
}

struct Baked {
  Mesh mesh;
  std::vector<Material> materials;
  const char* colors = "";  ///< where they are from
};

Baked baked_model(const VerifyModel& model, Renderer& exact, const VerifyOptions& options,
                  const std::function<void(std::size_t, std::size_t)>& progress) {
  Mesh scan = model.mesh;
  Baked baked{.mesh = {}, .materials = {}, .colors = "vertex colours"};
  if (scan.colors.empty()) {
    scan.colors = texture_at_vertices(scan, model.materials, exact);
    baked.colors = "texture at its vertices";
  }
  bake::BakeOptions how{.width = options.bake_size, .height = options.bake_size, .progress = progress};
  how.target_faces =
      options.bake_faces > 0 ? options.bake_faces : std::clamp<std::size_t>(scan.face_count() / 10, kFewestFaces, kMostFaces);
  bake::BakeResult result = bake::bake_scan(scan, how);
  baked.mesh = std::move(result.mesh);
  baked.materials.resize(1);
  baked.materials[0].texture = std::make_shared<const Image>(std::move(result.texture));
  baked.materials[0].sampler = {Filter::nearest, Wrap::clamp, Wrap::clamp};
  return baked;
}

}  // namespace

BakeCases bake_cases(const VerifyModel& model, const Frame& frame, Renderer& exact, const VerifyDevice& device,
                     const VerifyOptions& options, const std::function<void(std::size_t, std::size_t)>& progress) {
  if (model.mesh.colors.empty() && !has_texture(model)) return {kNoColors, {}};
  Baked baked;
  try {
    baked = baked_model(model, exact, options, progress);
  } catch (const InputError& error) {
    return {error.what(), {}};
  }
  BakeCases result;
  const BoundingBox box = bounding_box(model.mesh);
  for (const char* view : kBakeViews) {
    CaseResult item;
    item.job = "bake", item.model = model.name, item.view = view;
    item.sampling = fmt::format("{} of {} faces", baked.mesh.face_count(), model.mesh.face_count());
    item.description = fmt::format("{} of {} faces, with the model's {} in a map of {} × {} texels, by nearest lookup.",
                                   baked.mesh.face_count(), model.mesh.face_count(), baked.colors, options.bake_size, options.bake_size);
    const Camera camera = named_view(view, box, frame.width, frame.height);
    const auto scene_with_snap = [&](SnapRounding snap) {
      Frame other = frame;
      other.state.snap = snap;
      return make_scene(baked.mesh, baked.materials, camera, other);
    };
    try {
      compare_case(item, make_scene(baked.mesh, baked.materials, camera, frame), frame, exact, device, options, scene_with_snap);
    } catch (const UnavailableError& error) {
      item.width = frame.width, item.height = frame.height;
      item.skipped = error.what();
    }
    result.cases.push_back(std::move(item));
  }
  return result;
}

}  // namespace etalon::validation
