#include "validation/studies/chen_packing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "core/adapt/adapt_map.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::validation {
namespace {

using adapt::AdaptDirection;
using adapt::AdaptSequence;

constexpr int kTurns = 2;

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

MapState state_of(const Renderer& renderer) { return {Filter::linear, renderer.supported_state({})}; }

std::vector<MapPass> passes_of(const AdaptSequence& sequence, const std::vector<std::vector<std::uint32_t>>& packs, int size,
                               const RasterState& raster) {
  std::vector<MapPass> passes;
  for (const auto& pack : packs) passes.push_back(adapt::cell_pass(sequence, pack, AdaptDirection::to_before, size, size, raster));
  return passes;
}

/// Every `stride`-th split of the packs, in the order of work, alone.
std::vector<std::vector<std::uint32_t>> singles_of(const std::vector<std::vector<std::uint32_t>>& packs, std::size_t stride) {
  std::vector<std::uint32_t> splits;
  for (const auto& pack : packs) splits.insert(splits.end(), pack.begin(), pack.end());
  std::sort(splits.rbegin(), splits.rend());
  std::vector<std::vector<std::uint32_t>> singles;
  for (std::size_t n = 0; n < splits.size(); n += stride) singles.push_back({splits[n]});
  return singles;
}

/// Wall clock of the passes up to the last texel, the least of so many turns; the map they leave.
double time_passes(Renderer& renderer, const std::vector<MapPass>& passes, const Image& start, Image& left, int turns,
                   std::uint64_t* texels = nullptr) {
  double least = 0;
  for (int turn = 0; turn < turns; ++turn) {
    const std::unique_ptr<ResidentMap> map = renderer.make_map(start, state_of(renderer));
    const double ms = milliseconds([&] {
      map->apply(passes);
      left = map->read_back();
    });
    least = turn == 0 ? ms : std::min(least, ms);
    if (texels != nullptr) *texels = map->texels_written();
  }
  return least;
}

double seconds_of_levels(progressive::ProgressiveMesh& mesh, const std::function<void()>& also) {
  mesh.go_to(mesh.split_count());
  return milliseconds([&] {
    mesh.go_to(0);
    also();
  });
}

}  // namespace

const std::array<ChenPaperRow, 2>& chen_paper_rows() {
  static const std::array<ChenPaperRow, 2> kRows{{
      {"parasaur head", 7'835, 499, 3'611, 0.7581, 263, 0.0555, 13.66, 253.42, 52.99},
      {"bunny head", 17'483, 500, 8'545, 0.7616, 423, 0.0435, 17.51, 508.87, 137.16},
  }};
  return kRows;
}

ChenPacking measure_packing(progressive::ProgressiveMesh& mesh, const AdaptSequence& sequence, Renderer& exact, Renderer* device,
                            int map_size, std::size_t device_singles) {
  ChenPacking result;
  const std::size_t finest = sequence.size();
  result.faces = mesh.face_count_at(finest), result.base_faces = mesh.face_count_at(0);
  const auto packs = adapt::pack_splits(sequence, finest, 0, map_size, map_size);
  for (const auto& pack : packs) result.adaptations += pack.size();
  result.packs = packs.size();
  result.printed_packs = adapt::count_printed_packs(sequence, finest, 0, map_size, map_size);
  if (result.adaptations == 0) {
    result.same_bytes = true;
    return result;
  }

  const Image start = adapt::identity_map(map_size, map_size);
  const auto time = [&](Renderer& renderer, std::size_t most_singles, bool compare) {
    ChenTimes times{.renderer = renderer.name()};
    const RasterState raster = state_of(renderer).raster;
    Image packed, single;
    times.packed_ms =
        time_passes(renderer, passes_of(sequence, packs, map_size, raster), start, packed, kTurns, compare ? &result.texels : nullptr) /
        static_cast<double>(result.adaptations);
    const auto singles = singles_of(packs, (result.adaptations + most_singles - 1) / most_singles);
    times.singles_timed = singles.size();
    times.single_ms =
        time_passes(renderer, passes_of(sequence, singles, map_size, raster), start, single, 1) / static_cast<double>(singles.size());
    if (compare) result.same_bytes = packed == single;
    return times;
  };
  result.exact = time(exact, result.adaptations, true);
  if (device != nullptr && device->supports({.content = TargetContent::color, .format = start.format()}))
    result.device = time(*device, std::max<std::size_t>(device_singles, 1), false);

  Image map = start;
  const auto adapt_all = [&] { (void)adapt::adapt_map(exact, sequence, finest, 0, map); };
  result.levels_ms = seconds_of_levels(mesh, [] {});
  result.adapted_ms = seconds_of_levels(mesh, adapt_all);
  map = start;
  mesh.go_to(finest);
  result.together_ms = milliseconds([&] {
    parallel_for(2, [&](std::size_t job) {
      if (job == 0)
        mesh.go_to(0);
      else
        adapt_all();
    });
  });
  return result;
}

bool keeps_off_edges(const AdaptSequence& sequence, double margin) {
  const auto inside = [&](const Vec2f& p) { return std::min<double>(p.x, p.y) >= margin && std::max<double>(p.x, p.y) <= 1 - margin; };
  for (std::size_t n = 0; n < sequence.size(); ++n)
    for (const adapt::ChartCells& chart : sequence.split(n))
      for (const adapt::CellNode& node : chart.cells.nodes)
        if (!inside(node.before) || !inside(node.after)) return false;
  return true;
}

ChenSharing measure_sharing(const std::vector<std::string>& names, const std::vector<const AdaptSequence*>& sequences, Renderer& exact,
                            Renderer* device, int map_size) {
  ChenSharing result;
  result.names = names;
  const auto count = static_cast<int>(sequences.size());
  const int height = count * map_size;
  std::vector<std::vector<std::vector<std::uint32_t>>> packs;
  for (const AdaptSequence* sequence : sequences) {
    packs.push_back(adapt::pack_splits(*sequence, sequence->size(), 0, map_size, map_size));
    result.packs.push_back(packs.back().size());
    result.passes = std::max(result.passes, packs.back().size());
  }
  const auto shared_passes = [&](const RasterState& raster) {
    std::vector<MapPass> passes(result.passes);
    for (std::size_t k = 0; k < sequences.size(); ++k)
      for (std::size_t n = 0; n < packs[k].size(); ++n) {
        const MapPass one = adapt::cell_pass(*sequences[k], packs[k][n], AdaptDirection::to_before, map_size, map_size, raster);
        MapPass& all = passes[n];
        const auto vertex = static_cast<std::uint32_t>(all.vertices.size()), triangle = static_cast<std::uint32_t>(all.triangles.size());
        for (RasterVertex v : one.vertices) {
          v.y += (static_cast<int>(k) * map_size) << raster.subtexel_bits;
          v.uv.y = (v.uv.y + static_cast<float>(k)) / static_cast<float>(count);
          all.vertices.push_back(v);
        }
        for (const auto& t : one.triangles) all.triangles.push_back({vertex + t[0], vertex + t[1], vertex + t[2]});
        for (const std::uint32_t end : one.group_ends) all.group_ends.push_back(triangle + end);
      }
    return passes;
  };
  const Image start = adapt::identity_map(map_size, map_size);
  Image atlas(map_size, height, kRg32f);
  for (int k = 0; k < count; ++k)
    std::copy(start.bytes().begin(), start.bytes().end(), atlas.bytes().begin() + static_cast<std::ptrdiff_t>(start.bytes().size()) * k);

  std::vector<Image> alone(sequences.size());
  const auto apart = [&](Renderer& renderer) {
    double ms = 0;
    for (std::size_t k = 0; k < sequences.size(); ++k)
      ms += time_passes(renderer, passes_of(*sequences[k], packs[k], map_size, state_of(renderer).raster), start, alone[k], kTurns);
    return ms;
  };
  Image together;
  const auto shared = [&](Renderer& renderer) {
    return time_passes(renderer, shared_passes(state_of(renderer).raster), atlas, together, kTurns);
  };
  if (device != nullptr && device->supports({.content = TargetContent::color, .format = start.format()}))
    result.device_apart_ms = apart(*device), result.device_shared_ms = shared(*device);
  result.apart_ms = apart(exact), result.shared_ms = shared(exact);
  result.texels = together.texel_count();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < map_size; ++x) {
      const auto *a = together.channels<float>(x, y), *b = alone[static_cast<std::size_t>(y / map_size)].channels<float>(x, y % map_size);
      const double off = std::max(std::abs(double{a[0]} - b[0]), std::abs(double{a[1]} - b[1])) * map_size;
      result.differing += off > 0, result.largest = std::max(result.largest, off);
    }
  return result;
}

}  // namespace etalon::validation
