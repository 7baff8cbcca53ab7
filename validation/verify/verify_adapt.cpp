#include "validation/verify/verify_adapt.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "core/adapt/adapt_map.h"
#include "core/base/error.h"
#include "core/mesh/weld.h"
#include "validation/texel_diff.h"
#include "validation/verify/drawn_pair.h"
#include "validation/verify/pictures.h"

namespace etalon::validation {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The levels of a model and the passes between them.
struct Way {
  std::size_t fine_faces = 0, coarse_faces = 0, adaptations = 0;
  std::vector<MapPass> down, up;
};

Way make_way(const VerifyModel& model, const VerifyOptions& options, const RasterState& state) {
  simplify::SimplifyOptions simplify;
  simplify.metric = simplify::MetricName::qem5;
  simplify.target_faces = options.adapt_faces > 0 ? options.adapt_faces : std::max<std::size_t>(model.mesh.face_count() / 10, 4);
  progressive::ProgressiveMesh mesh(progressive::make_progressive(welded_by_position(model.mesh), simplify).data);
  Way way;
  mesh.go_to(mesh.split_count());
  way.fine_faces = mesh.face_count();
  const adapt::AdaptSequence sequence(mesh);
  const adapt::ChartBorders borders(mesh);
  adapt::Gutter gutter(borders, options.adapt_size, options.adapt_size);
  mesh.go_to(0);
  way.coarse_faces = mesh.face_count();
  const int size = options.adapt_size;
  const auto passes = [&](std::size_t from, std::size_t to) {
    const auto direction = to < from ? adapt::AdaptDirection::to_before : adapt::AdaptDirection::to_after;
    std::vector<MapPass> result;
    const adapt::GutterPlan plan = gutter.go_to(sequence, to);
    for (const auto& pack : adapt::pack_splits(sequence, from, to, size, size, adapt::pack_reach(true))) {
      result.push_back(adapt::cell_pass(sequence, pack, direction, size, size, state, &plan));
      way.adaptations += pack.size();
    }
    return result;
  };
  way.down = passes(sequence.size(), 0);
  way.up = passes(0, sequence.size());
  return way;
}

/// A texel that only one side covers is compared too; the others of the frame hold nothing.
std::uint64_t uncovered(const Image& a, const Image& b) {
  const auto *x = a.channels<std::uint32_t>(0, 0), *y = b.channels<std::uint32_t>(0, 0);
  std::uint64_t count = 0;
  for (std::size_t n = 0; n < a.texel_count(); ++n) count += x[n] == kNoTriangle && y[n] == kNoTriangle ? 1 : 0;
  return count;
}

/// The worst class of each texel over all passes.
void keep_worst(Image& classes, const Image& pass) {
  auto* const kept = classes.channels<std::uint8_t>(0, 0);
  const auto* const now = pass.channels<std::uint8_t>(0, 0);
  for (std::size_t n = 0; n < classes.texel_count(); ++n) kept[n] = std::max(kept[n], now[n]);
}

class AdaptCase {
 public:
  AdaptCase(const Way& way, Filter filter, Renderer& exact, const VerifyDevice& device, const VerifyOptions& options,
            const RasterState& state)
      : way_(way),
        exact_(exact),
        device_(device),
        options_(options),
        state_{filter, state},
        start_(adapt::identity_map(options.adapt_size, options.adapt_size)),
        exact_map_(start_),
        device_map_(start_),
        classes_(start_.width(), start_.height(), {ChannelType::unorm8, 1}),
        frame_(map_frame(start_.width(), start_.height(), start_.format(), state_)) {
    frame_.targets.push_back({TargetContent::triangle_id, kR32ui, {}});
  }

  void run(CaseResult& item, const std::function<void()>& after_pass) {
    item.width = frame_.width, item.height = frame_.height;
    for (const auto& [passes, faces] : {std::pair{&way_.down, way_.coarse_faces}, {&way_.up, way_.fine_faces}}) {
      for (const MapPass& pass : *passes) {
        do_pass(item, pass);
        after_pass();
      }
      compare_resident(item, *passes);
      add_map(item, faces);
    }
    if (device_.renderer != nullptr) {
      const int reach = mark_reach(frame_, options_.picture_px);
      item.class_picture = reduced(class_picture(picture_of(item_map_), classes_, reach), options_.picture_px);
    }
  }

 private:
  void do_pass(CaseResult& item, const MapPass& pass) {
    item.triangles += pass.triangles.size();
    const bool same_map = exact_map_ == device_map_;
    const std::vector<Image> from_exact = do_from(item, pass, exact_map_, true);
    const std::vector<Image> own = same_map ? from_exact : do_from(item, pass, device_map_, false);
    if (!own.empty()) copy_drawn(own[0], own[1], device_map_);
  }

  /// Both sides draw the pass from `map`, which becomes the exact one's where `advance`. What the device has drawn.
  std::vector<Image> do_from(CaseResult& item, const MapPass& pass, Image& map, bool advance) {
    const DrawList list = map_pass_list(pass, std::make_shared<const Image>(map), state_.filter);
    DrawnPair pair;
    const auto cpu_start = Clock::now();
    pair.cpu = exact_.render(list, frame_);
    item.cpu_seconds += seconds_since(cpu_start);
    if (advance) {
      item.covered += copy_drawn(pair.cpu[0], pair.cpu[1], map);
    }
    if (device_.renderer == nullptr) return {};
    const auto gl_start = Clock::now();
    pair.gl = device_.renderer->render(list, frame_);
    item.gl_seconds += seconds_since(gl_start);
    const auto compare_start = Clock::now();
    classify(item, list, pair);
    item.compare_seconds += seconds_since(compare_start);
    return std::move(pair.gl);
  }

  void classify(CaseResult& item, const DrawList& list, DrawnPair& pair) {
    constexpr int kCandidates = 64;
    const DiffResult diff =
        diff_images(list, frame_, device_.model, pair.cpu, pair.gl, {.worst_count = kCandidates, .keep_class_image = true});
    ClassTally tally = tally_of(diff.counts);
    const std::uint64_t empty = uncovered(pair.cpu[1], pair.gl[1]);
    tally.texels -= empty, tally.identical -= empty;
    item.tally += tally;
    keep_worst(classes_, diff.class_image);
    const bool news =
        tally.unexplained > 0 || (static_cast<int>(item.worst.size()) < options_.worst_count && tally.tie + tally.unbounded > 0);
    if (!news || static_cast<int>(item.worst.size()) >= 2 * options_.worst_count) return;
    picture_targets(pair, frame_);
    for (WorstTexel& worst : worst_texels(diff, pair, frame_.targets, options_.worst_count))
      if (worst.texel_class != to_string(TexelClass::rounding)) item.worst.push_back(std::move(worst));
    std::stable_sort(item.worst.begin(), item.worst.end(), [](const WorstTexel& a, const WorstTexel& b) {
      const std::string unexplained = to_string(TexelClass::unexplained);
      return a.texel_class == unexplained && b.texel_class != unexplained;
    });
    if (static_cast<int>(item.worst.size()) > options_.worst_count) item.worst.resize(static_cast<std::size_t>(options_.worst_count));
  }

  /// The device's map that stays, through the same passes, against what its drawings gave.
  void compare_resident(CaseResult& item, const std::vector<MapPass>& passes) {
    if (device_.renderer == nullptr) return;
    const auto gl_start = Clock::now();
    const auto resident = device_.renderer->make_map(start_, state_);
    resident->apply(passes);
    const Image kept = resident->read_back();
    item.gl_seconds += seconds_since(gl_start);
    start_ = kept;
    const std::uint64_t different = differing_texels(kept, device_map_);
    item.tally.texels += different, item.tally.unexplained += different;
    if (different > 0)
      item.diagnosis += fmt::format("{} texels of the map that stays on the device are not what its drawings gave.", different);
  }

  /// The maps of both ways, as they are now.
  void add_map(CaseResult& item, std::size_t faces) {
    DrawnPair pair;
    pair.cpu = {exact_map_};
    if (device_.renderer != nullptr) pair.gl = {device_map_};
    Frame frame = frame_;
    frame.targets.resize(1);
    picture_targets(pair, frame);
    item.targets.push_back(measure_target(pair, 0, frame.targets[0], options_.picture_px, mark_reach(frame, options_.picture_px)));
    item.targets.back().content = fmt::format("map at {} faces", faces);
    if (item_map_.empty()) item_map_ = exact_map_;
  }

  const Way& way_;
  Renderer& exact_;
  const VerifyDevice& device_;
  const VerifyOptions& options_;
  MapState state_;
  Image start_;  ///< of the resident map's passes
  Image exact_map_, device_map_, item_map_;
  Image classes_;
  Frame frame_;
};

}  // namespace

AdaptCases adapt_cases(const VerifyModel& model, Renderer& exact, const VerifyDevice& device, const VerifyOptions& options,
                       const std::function<void(std::size_t, std::size_t)>& progress) {
  if (!model.mesh.has_uv) return {kNoTextureCoordinates, {}};
  const RasterState state = device.renderer != nullptr ? device.renderer->supported_state(options.state) : options.state;
  Way way;
  try {
    way = make_way(model, options, state);
  } catch (const InputError& error) {
    return {error.what(), {}};
  }
  if (way.down.empty()) return {fmt::format("no collapse between {} and {} faces moves a texture", way.fine_faces, way.coarse_faces), {}};
  AdaptCases result;
  std::size_t done = 0;
  const std::size_t total = 2 * (way.down.size() + way.up.size());
  for (const Filter filter : {Filter::linear, Filter::nearest}) {
    CaseResult item;
    item.job = "adapt", item.model = model.name;
    item.view = fmt::format("{} to {} faces and back", way.fine_faces, way.coarse_faces);
    item.sampling = "float32 map, " + to_string(filter);
    item.description = fmt::format(
        "An indexing map through {} texture adaptations in {} passes, down and up; each pass drawn from the exact renderer's map, and from "
        "the device's own.",
        way.adaptations, way.down.size() + way.up.size());
    try {
      AdaptCase(way, filter, exact, device, options, state).run(item, [&] {
        if (progress) progress(++done, total);
      });
    } catch (const UnavailableError& error) {
      item.skipped = error.what();
    }
    result.cases.push_back(std::move(item));
  }
  return result;
}

}  // namespace etalon::validation
