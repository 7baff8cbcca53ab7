// The main job: the same scenes drawn by the exact rasterizer and by a device, every texel that differs explained.
// Does: choose scenes, draw them twice, classify, measure, keep pictures of bounded size. Does not: read or write files, print.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/draw/camera.h"
#include "core/draw/renderer.h"
#include "core/draw/scene.h"
#include "validation/bounds.h"
#include "validation/verify/verify_result.h"

namespace etalon::validation {

/// A model ready to be drawn.
struct VerifyModel {
  std::string name;  ///< of the scenes: "head", "spot_triangulated"
  Mesh mesh;
  std::vector<Material> materials;  ///< of the job `render`; indexed by Mesh::face_materials, not empty
  std::vector<VerifyInput> inputs;  ///< what it was read from
  std::vector<std::string> notes;
};

struct NamedView {
  std::string name;  ///< shown; looked up by named_view() where `camera` is not given
  std::optional<Camera> camera;
};

struct VerifyOptions {
  std::vector<std::string> jobs{"render", "indexed", "adapt", "bake", "joint"};
  std::vector<NamedView> views{{"fit", {}}, {"front", {}}};  ///< the job `indexed` uses the first
  int width = 1024;
  int height = 1024;
  int adapt_size = 256;         ///< of the job `adapt`: side of its map in texels
  std::size_t adapt_faces = 0;  ///< and its coarsest level; 0: a tenth of the model's
  int bake_size = 256;          ///< of the job `bake`: side of its map in texels, a power of two
  std::size_t bake_faces = 0;   ///< and its triangles; 0: a tenth of the model's, 4 to 300
  RasterState state;            ///< wanted; drawn is what the device supports of it
  int picture_px = 1024;        ///< longest side of the pictures that are kept
  int worst_count = 6;          ///< texels a scene that are shown with their surroundings
  /// Called before each step with its label, how many are done, and of how many; may be empty.
  std::function<void(const std::string& label, int done, int total)> on_progress;
  /// Called after each scene; may be empty.
  std::function<void(const CaseResult&)> on_case;
};

/// What the scenes are compared with.
struct VerifyDevice {
  Renderer* renderer = nullptr;  ///< none: scenes are drawn by `exact` only and nothing is compared
  DeviceModel model;
  std::string unavailable;  ///< why there is none
};

/// The jobs verify knows, in the order they are done.
[[nodiscard]] const std::vector<std::string>& verify_jobs();

/// Draws and compares. A job that an input cannot do is reported in JobResult::skipped, never an error; a job of several models is skipped
/// only where none can do it. `joint` draws a terrain of its own, once. The result depends on models, options and device alone: same bytes for any number of threads.
/// InputError: a view is degenerate, a model breaks the contract's ranges, a job is unknown.
[[nodiscard]] VerifyResult run_verify(const std::vector<VerifyModel>& models, Renderer& exact, const VerifyDevice& device,
                                      const VerifyOptions& options);

}  // namespace etalon::validation
