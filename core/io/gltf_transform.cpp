#include "core/io/gltf_transform.h"

#include <fmt/format.h>

#include <array>

namespace etalon::io {
namespace {

template <std::size_t kCount>
std::array<double, kCount> numbers(const JsonRef& ref) {
  std::array<double, kCount> result;
  if (ref.size() != kCount) ref.fail(fmt::format("expected {} numbers, got {}", kCount, ref.size()));
  for (std::size_t i = 0; i < kCount; ++i) result[i] = ref.at(i).real();
  return result;
}

}  // namespace

NodeTransform local_transform(const JsonRef& node) {
  NodeTransform t;
  if (node.has("matrix")) {
    const auto m = numbers<16>(node.at("matrix"));
    for (int c = 0; c < 4; ++c) t.column[c] = {m[4 * c], m[4 * c + 1], m[4 * c + 2]};
    t.identity = false;
    return t;
  }
  if (node.has("rotation")) {
    const auto [x, y, z, w] = numbers<4>(node.at("rotation"));
    t.column[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
    t.column[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
    t.column[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    t.identity = false;
  }
  if (node.has("scale")) {
    const auto s = numbers<3>(node.at("scale"));
    for (int i = 0; i < 3; ++i) t.column[i] *= s[i];
    t.identity = false;
  }
  if (node.has("translation")) {
    const auto p = numbers<3>(node.at("translation"));
    t.column[3] = {p[0], p[1], p[2]};
    t.identity = false;
  }
  return t;
}

}  // namespace etalon::io
