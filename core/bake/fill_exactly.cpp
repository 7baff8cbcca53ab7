#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

#include "core/bake/source_tree.h"
#include "core/bake/surface_fill.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

namespace etalon::bake {
namespace {

constexpr Nearest kNothing{kNoDistance, kNoGroup};

class ExactFill {
 public:
  explicit ExactFill(const FillProblem& problem) : problem_(problem), nodes_(problem.nodes), hits_(problem.colors), fill_() {
    fill_.source.assign(nodes_.texel_count(), kNoGroup);
    fill_.distance.assign(nodes_.texel_count(), kNoDistance);
  }

  SurfaceFill run() {
    list_gates();
    for_each_face(&ExactFill::search_own_hits);
    walk_gates();
    for_each_face(&ExactFill::finish);
    return std::move(fill_);
  }

 private:
  // A texel on a side whose node has texels elsewhere and no hit: by these, and these only, paths go on into other triangles.
  struct Gate {
    std::uint32_t texel;
    GridPoint center;
  };

  // In blocks: one face may be a single row of texels, another half the map.
  void for_each_face(void (ExactFill::*step)(std::uint32_t, SourceTree&)) {
    parallel_for_blocks(face_count(), 16, [&](std::size_t begin, std::size_t end) {
      SourceTree tree;
      for (std::size_t f = begin; f < end; ++f) (this->*step)(static_cast<std::uint32_t>(f), tree);
    });
  }

  [[nodiscard]] std::size_t face_count() const { return problem_.atlas.tiles.size(); }
  [[nodiscard]] bool is_gate(std::uint32_t texel) const { return nodes_.group_of(texel) != kNoGroup && !hits_.is_hit(texel); }
  [[nodiscard]] Nearest at(std::uint32_t texel) const { return {fill_.distance[texel], fill_.source[texel]}; }
  void set(std::uint32_t texel, const Nearest& nearest) { std::tie(fill_.distance[texel], fill_.source[texel]) = nearest; }

  // Hit texels: themselves. Gates: the nearest hit of their own triangle.
  void search_own_hits(std::uint32_t f, SourceTree& tree) {
    std::vector<SourceTree::Source> sources = own_hits(f);
    tree.build(sources);
    if (tree.empty()) return;
    for (std::uint32_t n = gate_starts_[f]; n < gate_starts_[f + 1]; ++n) set(gates_[n].texel, tree.nearest(gates_[n].center, kNothing));
  }

  [[nodiscard]] std::vector<SourceTree::Source> own_hits(std::uint32_t f) {
    std::vector<SourceTree::Source> hits;
    const TexelPlane plane = problem_.metric.plane(f);
    std::uint32_t texel = nodes_.first(f);
    for_each_texel(problem_.atlas.tiles[f].size, [&](int i, int j) {
      if (hits_.is_hit(texel)) {
        hits.push_back({plane.center(i, j), {0, nodes_.node_of(texel)}});
        set(texel, {0, nodes_.node_of(texel)});
      }
      ++texel;
    });
    return hits;
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
  void finish(std::uint32_t f, SourceTree& tree) {
    std::vector<SourceTree::Source> sources = own_hits(f);
    for (std::uint32_t n = gate_starts_[f]; n < gate_starts_[f + 1]; ++n) {
      const std::uint32_t g = nodes_.group_of(gates_[n].texel);
      if (reached_at_[g] != gates_[n].texel && best_[g] != kNothing) sources.push_back({gates_[n].center, best_[g]});
      set(gates_[n].texel, best_[g]);
    }
    tree.build(sources);
    if (tree.empty()) return;
    const TexelPlane plane = problem_.metric.plane(f);
    std::uint32_t texel = nodes_.first(f);
    for_each_texel(problem_.atlas.tiles[f].size, [&](int i, int j) {
      const std::uint32_t t = texel++;
      if (!hits_.is_hit(t) && !is_gate(t)) set(t, tree.nearest(plane.center(i, j), kNothing));
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
