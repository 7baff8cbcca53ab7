#include <algorithm>
#include <utility>

#include "core/bake/surface_fill.h"
#include "core/base/parallel.h"

namespace etalon::bake {
namespace {

using Nearest = std::pair<std::uint64_t, std::uint32_t>;  // distance, source

/// Whether what lies at `from`, having `offset`, is nearer to `to` than `best`, without the root of grid_distance(): most neighbours have
/// nothing better to offer.
bool is_nearer(const Nearest& offset, const GridPoint& from, const GridPoint& to, const Nearest& best) {
  if (offset.first > best.first) return false;
  const std::uint64_t room = best.first - offset.first;
  if (room > std::uint64_t{1} << 31) return true;  // no two centres are that far apart
  const std::uint64_t squared = squared_grid_distance(from, to);
  if (squared > room * room) return false;
  const bool equal = room == 0 || squared > (room - 1) * (room - 1);  // the root, rounded up, is `room`
  return !equal || offset.second < best.second;
}

class IterativeFill {
 public:
  explicit IterativeFill(const FillProblem& problem) : problem_(problem), nodes_(problem.nodes), hits_(problem.colors) {
    const std::size_t count = nodes_.texel_count();
    fill_.source.assign(count, kNoGroup);
    fill_.distance.assign(count, kNoDistance);
    fill_.feature.assign(count, kNoGroup);
    for (std::uint32_t t = 0; t < count; ++t)
      if (hits_.is_hit(t)) make_feature(t, {0, nodes_.node_of(t)});
    for (std::uint32_t f = 0; f < face_count(); ++f) face_of_first_.push_back(nodes_.first(f));
    dirty_.assign(face_count(), 1);
  }

  SurfaceFill run(const FillObserver& observe) {
    bool changed = true;
    while (changed) {
      ++fill_.iterations;
      parallel_for_blocks(face_count(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f)
          if (dirty_[f]) dirty_[f] = transform(static_cast<std::uint32_t>(f));
      });
      if (observe) observe(FillStage::transformed, fill_);
      changed = propagate();
      if (observe) observe(FillStage::propagated, fill_);
    }
    return std::move(fill_);
  }

 private:
  [[nodiscard]] std::size_t face_count() const { return problem_.atlas.tiles.size(); }
  [[nodiscard]] Nearest at(std::uint32_t texel) const { return {fill_.distance[texel], fill_.source[texel]}; }
  void set(std::uint32_t texel, const Nearest& nearest) {
    fill_.distance[texel] = nearest.first;
    fill_.source[texel] = nearest.second;
  }
  void make_feature(std::uint32_t texel, const Nearest& nearest) {
    set(texel, nearest);
    fill_.feature[texel] = texel;
  }

  // One transform of one triangle: down and up its rows, each row also to the right and back. Whether anything changed: if not, and its features
  // stay, the next would change nothing either.
  bool transform(std::uint32_t f) {
    const int size = problem_.atlas.tiles[f].size;
    const TexelPlane plane = problem_.metric.plane(f);
    const std::uint32_t first = nodes_.first(f);
    std::vector<GridPoint> centers;
    for_each_texel(size, [&](int i, int j) { centers.push_back(plane.center(i, j)); });
    bool changed = false;
    const auto try_feature = [&](std::uint32_t t, std::uint32_t feature) {
      const GridPoint &from = centers[feature - first], &to = centers[t - first];
      const Nearest offset = at(feature);
      if (!is_nearer(offset, from, to, at(t))) return;
      set(t, {offset.first + grid_distance(from, to), offset.second});
      fill_.feature[t] = feature;
      changed = true;
    };
    for (std::uint32_t t = first; t < first + centers.size(); ++t)  // a feature may have come nearer
      if (fill_.feature[t] != kNoGroup && fill_.feature[t] != t) try_feature(t, fill_.feature[t]);
    const auto try_neighbor = [&](std::uint32_t t, std::uint32_t neighbor) {
      const std::uint32_t feature = fill_.feature[neighbor];
      if (feature == kNoGroup || feature == t) return;
      // What t has is from there already, and a feature that is still its own has not come nearer in this transform.
      if (feature == fill_.feature[t] && fill_.feature[feature] == feature) return;
      try_feature(t, feature);
    };
    for (const bool down : {true, false})
      for (int n = 0; n < size; ++n) {
        const int j = down ? n : size - 1 - n;
        const auto last = static_cast<std::uint32_t>(size - 1 - j);
        const std::uint32_t row = nodes_.texel(f, size, 0, j);
        if (down ? j > 0 : last > 0) {
          const std::uint32_t other = nodes_.texel(f, size, 0, down ? j - 1 : j + 1), other_last = down ? last + 1 : last - 1;
          for (std::uint32_t i = 0; i <= last; ++i) {
            if (i > 0) try_neighbor(row + i, other + i - 1);
            if (i <= other_last) try_neighbor(row + i, other + i);
            if (i + 1 <= other_last) try_neighbor(row + i, other + i + 1);
          }
        }
        for (std::uint32_t i = 1; i <= last; ++i) try_neighbor(row + i, row + i - 1);
        for (std::uint32_t i = last; i > 0; --i) try_neighbor(row + i - 1, row + i);
      }
    return changed;
  }

  // Each node takes the best of its texels, and they become features. Whether a triangle is to be transformed again.
  bool propagate() {
    for (std::uint32_t g = 0; g < nodes_.group_count(); ++g) {
      const auto members = nodes_.members(g);
      if (hits_.is_hit(members[0])) continue;
      Nearest best = at(members[0]);
      for (const std::uint32_t t : members) best = std::min(best, at(t));
      if (best.first == kNoDistance) continue;
      for (const std::uint32_t t : members) {
        if (at(t) == best && fill_.feature[t] == t) continue;
        make_feature(t, best);
        const auto next = std::upper_bound(face_of_first_.begin(), face_of_first_.end(), t);
        dirty_[static_cast<std::size_t>(next - face_of_first_.begin()) - 1] = 1;
      }
    }
    return std::find(dirty_.begin(), dirty_.end(), 1) != dirty_.end();
  }

  const FillProblem& problem_;
  const TexelNodes& nodes_;
  const TexelColors& hits_;
  SurfaceFill fill_;
  std::vector<std::uint32_t> face_of_first_;  // #F: the first texel of each face
  std::vector<std::uint8_t> dirty_;           // #F
};

}  // namespace

SurfaceFill fill_iteratively(const FillProblem& problem, const FillObserver& observe) { return IterativeFill(problem).run(observe); }

}  // namespace etalon::bake
