#include "validation/verify/verify.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "validation/verify/verify_adapt.h"
#include "validation/verify/verify_bake.h"
#include "validation/verify/verify_case.h"
#include "validation/verify/verify_joint.h"
#include "validation/verify/verify_maps.h"

namespace etalon::validation {
namespace {

constexpr const char *kAdapt = "adapt", *kBake = "bake", *kJoint = "joint";

// Their scenes are made as they are drawn.
bool is_prepared(const std::string& job) { return job == kAdapt || job == kBake || job == kJoint; }

/// A scene that is still to be drawn.
struct Plan {
  const VerifyModel* model = nullptr;
  NamedView view;
  std::string sampling;
  std::string description;
  std::vector<Material> materials;
};

std::vector<Material> with_filter(std::vector<Material> materials, Filter filter) {
  for (Material& material : materials) material.sampler.filter = filter;
  return materials;
}

bool has_texture(const std::vector<Material>& materials) {
  return std::any_of(materials.begin(), materials.end(), [](const Material& material) { return material.texture != nullptr; });
}

std::vector<Plan> plan_render(const VerifyModel& model, const VerifyOptions& options) {
  std::vector<Plan> plans;
  for (const NamedView& view : options.views) {
    if (!has_texture(model.materials)) {
      plans.push_back({&model, view, "vertex colours", "Interpolated vertex colours.", model.materials});
      continue;
    }
    plans.push_back({&model, view, "nearest", "The texture by nearest lookup.", with_filter(model.materials, Filter::nearest)});
    plans.push_back({&model, view, "linear", "The texture by linear filtering.", with_filter(model.materials, Filter::linear)});
  }
  return plans;
}

// One map per material, of its texture's size: the identity must name every texel.
std::vector<Material> through_map(const std::vector<Material>& materials, std::shared_ptr<const Image> (*make_map)(int, int),
                                  Filter map_filter) {
  std::vector<Material> mapped = materials;
  for (Material& material : mapped) {
    if (!material.texture) material.texture = checkerboard();
    material.sampler.filter = Filter::nearest;
    material.indexing_map = make_map(material.texture->width(), material.texture->height());
    material.map_sampler = {map_filter, Wrap::clamp, Wrap::clamp};  // across a wrap a linear lookup would run through the whole map
  }
  return mapped;
}

std::vector<Plan> plan_indexed(const VerifyModel& model, const VerifyOptions& options) {
  if (!model.mesh.has_uv || options.views.empty()) return {};
  return {{&model, options.views.front(), "swirled float32 map",
           "Coordinates from an rg float32 map that swirls the texture, filtered linearly; then the texture by nearest lookup.",
           through_map(model.materials, swirled_map, Filter::linear)},
          {&model, options.views.front(), "identity unorm16 map",
           "Coordinates from an rg unorm16 map that holds its own texel centres, by nearest lookup; then the texture likewise.",
           through_map(model.materials, identity_map, Filter::nearest)}};
}

struct JobPlan {
  std::string job;
  std::vector<Plan> plans;
  std::string skipped;
};

JobPlan plan_job(const std::string& job, const std::vector<VerifyModel>& models, const VerifyOptions& options) {
  JobPlan result{job, {}, ""};
  if (std::find(verify_jobs().begin(), verify_jobs().end(), job) == verify_jobs().end())
    throw InputError(fmt::format("verify: expected a job of {}, got '{}'", fmt::join(verify_jobs(), ", "), job));
  if (is_prepared(job)) return result;
  for (const VerifyModel& model : models) {
    const std::vector<Plan> plans = job == "render" ? plan_render(model, options) : plan_indexed(model, options);
    result.plans.insert(result.plans.end(), plans.begin(), plans.end());
  }
  if (result.plans.empty()) result.skipped = kNoTextureCoordinates;
  return result;
}

Frame frame_for(const VerifyOptions& options, const VerifyDevice& device) {
  Frame frame;
  frame.width = options.width;
  frame.height = options.height;
  frame.state = device.renderer != nullptr ? device.renderer->supported_state(options.state) : options.state;
  TargetSpec color{TargetContent::color, kRgba8, {0.094f, 0.102f, 0.125f, 1}};
  frame.targets = {color, {TargetContent::triangle_id, kR32ui, {}}, {TargetContent::depth, kR32f, {}}};
  return frame;
}

CaseResult run_case(const std::string& job, const Plan& plan, const Frame& frame, Renderer& exact, const VerifyDevice& device,
                    const VerifyOptions& options) {
  CaseResult item;
  item.job = job;
  item.model = plan.model->name;
  item.view = plan.view.name;
  item.sampling = plan.sampling;
  item.description = plan.description;
  const Camera camera =
      plan.view.camera ? *plan.view.camera : named_view(plan.view.name, bounding_box(plan.model->mesh), frame.width, frame.height);
  item.width = frame.width;
  item.height = frame.height;
  const auto scene_with_snap = [&](SnapRounding snap) {
    Frame other = frame;
    other.state.snap = snap;
    return make_scene(plan.model->mesh, plan.materials, camera, other);
  };
  try {
    compare_case(item, make_scene(plan.model->mesh, plan.materials, camera, frame), frame, exact, device, options, scene_with_snap);
  } catch (const UnavailableError& error) {
    item.skipped = error.what();  // one texture beyond a device's limits must not cost the other scenes
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", plan.model->name, error.what()));
  }
  return item;
}

// Scenes that are made from the model as they are drawn, so they are no plans.
JobResult run_prepared(const std::string& job, const std::vector<VerifyModel>& models, const Frame& frame, Renderer& exact,
                       const VerifyDevice& device, const VerifyOptions& options) {
  JobResult result{job, "", {}};
  std::string reason;
  const auto keep = [&](auto made) {
    if (!made.skipped.empty()) reason = made.skipped;
    for (CaseResult& item : made.cases) {
      if (options.on_case) options.on_case(item);
      result.cases.push_back(std::move(item));
    }
  };
  const auto report = [&](const std::string& name) {
    return [&, name](std::size_t done, std::size_t total) {
      if (options.on_progress) options.on_progress(fmt::format("{}: {}", job, name), static_cast<int>(done), static_cast<int>(total));
    };
  };
  if (job == kJoint) keep(joint_cases(exact, device, options, report("terrain")));
  for (const VerifyModel& model : models) {
    if (job == kJoint) break;
    const auto progress = report(model.name);
    if (job == kAdapt) {
      keep(adapt_cases(model, exact, device, options, progress));
      continue;
    }
    try {
      keep(bake_cases(model, frame, exact, device, options, progress));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", model.name, error.what()));
    }
  }
  if (result.cases.empty()) result.skipped = reason;
  return result;
}

// What was asked for and is drawn otherwise. Not half rounding: no target of a scene holds halves.
std::vector<std::string> state_notes(const RasterState& wanted, const RasterState& drawn) {
  std::vector<std::string> notes;
  if (wanted.subtexel_bits != drawn.subtexel_bits)
    notes.push_back(fmt::format("the device has {0} sub-texel bits, not {1}: compared at {0}", drawn.subtexel_bits, wanted.subtexel_bits));
  const auto add = [&](const char* what, const std::string& asked, const std::string& has) {
    if (asked != has) notes.push_back(fmt::format("the device has {0} {1}, not {2}: compared with {1}", what, has, asked));
  };
  add("sub-texel rounding", to_string(wanted.snap), to_string(drawn.snap));
  add("fill rule", to_string(wanted.fill_rule), to_string(drawn.fill_rule));
  return notes;
}

void describe_sides(VerifyResult& result, const Renderer& exact, const VerifyDevice& device) {
  result.cpu_name = exact.name();
  if (device.renderer == nullptr) {
    result.gl_unavailable = device.unavailable;
    return;
  }
  result.gl_name = device.renderer->name();
  result.bounds_origin = fmt::format("{}: {}", to_string(device.model.origin), device.model.valid_for);
  result.bounds_measured = device.model.origin == BoundOrigin::measured || device.model.origin == BoundOrigin::specified;
}

}  // namespace

const std::vector<std::string>& verify_jobs() {
  static const std::vector<std::string> kJobs{"render", "indexed", kAdapt, kBake, kJoint};
  return kJobs;
}

VerifyResult run_verify(const std::vector<VerifyModel>& models, Renderer& exact, const VerifyDevice& device, const VerifyOptions& options) {
  VerifyResult result;
  describe_sides(result, exact, device);
  for (const VerifyModel& model : models) {
    result.inputs.insert(result.inputs.end(), model.inputs.begin(), model.inputs.end());
    for (const std::string& note : model.notes) result.notes.push_back(fmt::format("{}: {}", model.name, note));
  }
  std::vector<JobPlan> jobs;
  int total = 0;
  for (const std::string& job : options.jobs) {
    jobs.push_back(plan_job(job, models, options));
    total += static_cast<int>(jobs.back().plans.size());
  }
  const Frame frame = frame_for(options, device);
  result.state = frame.state;
  if (device.renderer != nullptr) {
    for (std::string& note : state_notes(options.state, frame.state)) result.caveats.push_back(std::move(note));
  }
  int done = 0;
  for (const JobPlan& job : jobs) {
    if (is_prepared(job.job)) {
      result.jobs.push_back(run_prepared(job.job, models, frame, exact, device, options));
      continue;
    }
    JobResult job_result{job.job, job.skipped, {}};
    for (const Plan& plan : job.plans) {
      if (options.on_progress)
        options.on_progress(fmt::format("{}: {}, {}, {}", job.job, plan.model->name, plan.view.name, plan.sampling), done, total);
      job_result.cases.push_back(run_case(job.job, plan, frame, exact, device, options));
      ++done;
      const CaseResult& item = job_result.cases.back();
      if (item.skipped.empty() && item.covered == 0)
        result.caveats.push_back(fmt::format("{}, {}: no triangle covers a texel", job.job, item.name()));
      if (options.on_case) options.on_case(job_result.cases.back());
    }
    result.jobs.push_back(std::move(job_result));
  }
  return result;
}

}  // namespace etalon::validation
