#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

#include "core/bake/surface_fill.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::bake {
namespace {

// Nearer first, then the lower source.
using Nearest = std::pair<std::uint64_t, std::uint32_t>;
constexpr Nearest kNothing{kNoDistance, kNoGroup};

// One triangle of the map while it is worked on.
struct Face {
  Face(const FillProblem& problem, std::uint32_t f) : size(problem.atlas.tiles[f].size), first(problem.nodes.first(f)) {
    const TexelPlane plane = problem.metric.plane(f);
    least_step = plane.least_step();
    for_each_texel(size, [&](int i, int j) { centers.push_back(plane.center(i, j)); });
  }
  [[nodiscard]] std::uint32_t local(int i, int j) const { return static_cast<std::uint32_t>(j * size - j * (j - 1) / 2 + i); }

  int size;
  std::uint32_t first;
  double least_step = 0;
  std::vector<GridPoint> centers;
};

class ExactFill {
 public:
  explicit ExactFill(const FillProblem& problem) : problem_(problem), nodes_(problem.nodes), hits_(problem.colors), fill_() {
    fill_.source.assign(nodes_.texel_count(), kNoGroup);
    fill_.distance.assign(nodes_.texel_count(), kNoDistance);
  }

  SurfaceFill run() {
    // Blocks of faces: one face may be a single texel row, another half the map.
    parallel_for_blocks(face_count(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) search_own_hits(static_cast<std::uint32_t>(f));
    });
    list_gates();
    walk_gates();
    parallel_for_blocks(face_count(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) finish(static_cast<std::uint32_t>(f));
    });
    return std::move(fill_);
  }

 private:
  // A texel on a side whose node has texels elsewhere and no hit: by these, and these only, paths go on into other triangles.
  struct Gate {
    std::uint32_t texel;
    GridPoint center;
  };

  [[nodiscard]] std::size_t face_count() const { return problem_.atlas.tiles.size(); }
  [[nodiscard]] bool is_gate(std::uint32_t texel) const { return nodes_.group_of(texel) != kNoGroup && !hits_.is_hit(texel); }
  [[nodiscard]] Nearest at(std::uint32_t texel) const { return {fill_.distance[texel], fill_.source[texel]}; }
  void set(std::uint32_t texel, const Nearest& nearest) { std::tie(fill_.distance[texel], fill_.source[texel]) = nearest; }

  // Every texel: itself where hit, else the nearest hit of its own triangle.
  void search_own_hits(std::uint32_t f) {
    const Face face(problem_, f);
    for_each_texel(face.size, [&](int i, int j) {
      const std::uint32_t texel = face.first + face.local(i, j);
      set(texel, hits_.is_hit(texel) ? Nearest{0, nodes_.node_of(texel)} : nearest_own_hit(face, i, j));
    });
  }

  [[nodiscard]] Nearest nearest_own_hit(const Face& face, int i, int j) const {
    const GridPoint center = face.centers[face.local(i, j)];
    Nearest best = kNothing;
    const auto visit = [&](int p, int q) {
      if (p < 0 || q < 0 || p + q >= face.size) return;
      const std::uint32_t local = face.local(p, q);
      if (!hits_.is_hit(face.first + local)) return;
      best = std::min(best, Nearest{grid_distance(center, face.centers[local]), nodes_.node_of(face.first + local)});
    };
    // Ring k: the texels at k in the larger of |p − i| and |q − j|. It and all beyond are no nearer than k·least_step − 2.
    for (int k = 1; k < face.size; ++k) {
      if (best != kNothing && k * face.least_step - 2 > static_cast<double>(best.first)) break;
      for (int p = std::max(i - k, 0); p <= std::min(i + k, face.size - 1); ++p) {
        visit(p, j - k);
        visit(p, j + k);
      }
      for (int q = std::max(j - k + 1, 0); q <= std::min(j + k - 1, face.size - 1); ++q) {
        visit(i - k, q);
        visit(i + k, q);
      }
    }
    return best;
  }

  void list_gates() {
    gate_starts_.push_back(0);
    for (std::uint32_t f = 0; f < face_count(); ++f) {
      const int size = problem_.atlas.tiles[f].size;
      const TexelPlane plane = problem_.metric.plane(f);
      const auto add = [&](int i, int j) {
        const std::uint32_t texel = nodes_.texel(f, size, i, j);
        if (is_gate(texel)) gates_.push_back({texel, plane.center(i, j)});
      };
      for (int i = 0; i < size; ++i) add(i, 0);
      for (int j = 1; j < size; ++j) {
        add(0, j);
        if (j < size - 1) add(size - 1 - j, j);
      }
      gate_starts_.push_back(static_cast<std::uint32_t>(gates_.size()));
    }
    // A group's gates, one for each of its texels.
    by_group_starts_.assign(nodes_.group_count() + 1, 0);
    for (const Gate& gate : gates_) ++by_group_starts_[nodes_.group_of(gate.texel) + 1];
    for (std::size_t g = 0; g < nodes_.group_count(); ++g) by_group_starts_[g + 1] += by_group_starts_[g];
    by_group_.resize(gates_.size());
    face_of_gate_.resize(gates_.size());
    std::vector<std::uint32_t> next(by_group_starts_.begin(), by_group_starts_.end() - 1);
    for (std::uint32_t f = 0; f < face_count(); ++f)
      for (std::uint32_t n = gate_starts_[f]; n < gate_starts_[f + 1]; ++n) {
        by_group_[next[nodes_.group_of(gates_[n].texel)]++] = n;
        face_of_gate_[n] = f;
      }
  }

  // Dijkstra's algorithm over the groups without hits; they start with what their own triangles hold.
  void walk_gates() {
    best_.assign(nodes_.group_count(), kNothing);
    reached_at_.assign(nodes_.group_count(), kNoGroup);
    using Entry = std::pair<Nearest, std::uint32_t>;  // of a group
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](const Gate& gate, const Nearest& offered) {
      const std::uint32_t g = nodes_.group_of(gate.texel);
      if (offered >= best_[g]) return;
      best_[g] = offered;
      reached_at_[g] = gate.texel;
      queue.emplace(offered, g);
    };
    for (const Gate& gate : gates_) offer(gate, at(gate.texel));
    while (!queue.empty()) {
      const auto [nearest, g] = queue.top();
      queue.pop();
      if (nearest != best_[g]) continue;
      for (std::uint32_t k = by_group_starts_[g]; k < by_group_starts_[g + 1]; ++k) {
        const Gate& from = gates_[by_group_[k]];
        const std::uint32_t f = face_of_gate_[by_group_[k]];
        for (std::uint32_t n = gate_starts_[f]; n < gate_starts_[f + 1]; ++n)
          offer(gates_[n], {nearest.first + grid_distance(from.center, gates_[n].center), nearest.second});
      }
    }
  }

  // The other texels choose between their own triangle's hits and what came in.
  void finish(std::uint32_t f) {
    std::vector<std::pair<Nearest, GridPoint>> entries;
    for (std::uint32_t n = gate_starts_[f]; n < gate_starts_[f + 1]; ++n) {
      const std::uint32_t g = nodes_.group_of(gates_[n].texel);
      if (reached_at_[g] != gates_[n].texel && best_[g] != kNothing) entries.emplace_back(best_[g], gates_[n].center);
      set(gates_[n].texel, best_[g]);
    }
    if (entries.empty()) return;
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const TexelPlane plane = problem_.metric.plane(f);
    const int size = problem_.atlas.tiles[f].size;
    std::uint32_t texel = nodes_.first(f);
    for_each_texel(size, [&](int i, int j) {
      const std::uint32_t t = texel++;
      if (hits_.is_hit(t) || is_gate(t)) return;
      const GridPoint center = plane.center(i, j);
      Nearest best = at(t);
      for (const auto& [nearest, from] : entries) {
        if (nearest.first > best.first) break;
        best = std::min(best, Nearest{nearest.first + grid_distance(from, center), nearest.second});
      }
      set(t, best);
    });
  }

  const FillProblem& problem_;
  const TexelNodes& nodes_;
  const TexelColors& hits_;
  SurfaceFill fill_;
  std::vector<Gate> gates_;                  // by face
  std::vector<std::uint32_t> gate_starts_;   // #F + 1
  std::vector<std::uint32_t> face_of_gate_;  // #gates
  std::vector<std::uint32_t> by_group_, by_group_starts_;
  std::vector<Nearest> best_;              // by group
  std::vector<std::uint32_t> reached_at_;  // by group: the texel at which its best arrived, straight through that texel's triangle
};

}  // namespace

SurfaceFill fill_exactly(const FillProblem& problem) { return ExactFill(problem).run(); }

std::vector<Rgb8> filled_colors(const TexelColors& colors, const SurfaceFill& fill) {
  std::vector<Rgb8> result(fill.source.size());
  for (std::size_t t = 0; t < result.size(); ++t) {
    ETALON_CHECK(fill.source[t] != kNoGroup, "a part of the surface without any colour");
    result[t] = colors.color[fill.source[t]];
  }
  return result;
}

}  // namespace etalon::bake
