#include "core/bake/source_tree.h"

#include <algorithm>

namespace etalon::bake {
namespace {

constexpr std::uint32_t kLeafSources = 8;

std::array<std::int32_t, 3> coordinates(const GridPoint& p) { return {p.x, p.y, p.z}; }

}  // namespace

void SourceTree::build(std::vector<Source>& sources) {
  sources_.swap(sources);
  nodes_.clear();
  if (!sources_.empty()) add_node(0, static_cast<std::uint32_t>(sources_.size()));
}

std::uint32_t SourceTree::add_node(std::uint32_t begin, std::uint32_t end) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  Node node{.low = coordinates(sources_[begin].center), .high = {}, .least = sources_[begin].behind.first, .begin = begin, .end = end};
  node.high = node.low;
  for (std::uint32_t s = begin; s < end; ++s) {
    const auto at = coordinates(sources_[s].center);
    for (std::size_t k = 0; k < 3; ++k) node.low[k] = std::min(node.low[k], at[k]), node.high[k] = std::max(node.high[k], at[k]);
    node.least = std::min(node.least, sources_[s].behind.first);
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafSources) return id;
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (node.high[k] - node.low[k] > node.high[axis] - node.low[axis]) axis = k;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(sources_.begin() + begin, sources_.begin() + middle, sources_.begin() + end,
                   [axis](const Source& a, const Source& b) { return coordinates(a.center)[axis] < coordinates(b.center)[axis]; });
  add_node(begin, middle);
  const std::uint32_t right = add_node(middle, end);
  nodes_[id].right = right;
  return id;
}

std::uint64_t SourceTree::squared_distance_to(const Node& node, const std::array<std::int32_t, 3>& at) {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t outside = std::max({std::int64_t{node.low[k]} - at[k], std::int64_t{at[k]} - node.high[k], std::int64_t{0}});
    sum += static_cast<std::uint64_t>(outside * outside);
  }
  return sum;
}

Nearest SourceTree::nearest(const GridPoint& at, Nearest known) const {
  if (nodes_.empty()) return known;
  const auto place = coordinates(at);
  // Nothing below a node is better than its least and the whole way to its box: the rounded-up root is at most `room` where the square is at
  // most room².
  const auto can_help = [&](std::uint64_t least, std::uint64_t squared) {
    if (least > known.first) return false;
    const std::uint64_t room = known.first - least;
    return room > std::uint64_t{1} << 31 || squared <= room * room;
  };
  struct Waiting {
    std::uint32_t node;
    std::uint64_t squared;
  };
  std::array<Waiting, 64> stack;  // one a level stays, and 2^32 sources have 30
  std::size_t waiting = 0;
  stack[waiting++] = {0, squared_distance_to(nodes_[0], place)};
  while (waiting > 0) {
    const Waiting next = stack[--waiting];
    const Node& node = nodes_[next.node];
    if (!can_help(node.least, next.squared)) continue;
    if (node.right == 0) {
      for (std::uint32_t s = node.begin; s < node.end; ++s)
        known = std::min(known, Nearest{sources_[s].behind.first + grid_distance(at, sources_[s].center), sources_[s].behind.second});
      continue;
    }
    const std::uint32_t left = next.node + 1;
    const Waiting children[2] = {{left, squared_distance_to(nodes_[left], place)},
                                 {node.right, squared_distance_to(nodes_[node.right], place)}};
    const bool left_first = children[0].squared <= children[1].squared;
    stack[waiting++] = children[left_first ? 1 : 0];
    stack[waiting++] = children[left_first ? 0 : 1];
  }
  return known;
}

}  // namespace etalon::bake
