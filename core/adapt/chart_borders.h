// Where charts are in texture space at every level of a progressive mesh: the faces of the finest one, and what each split changes. Inside a
// chart a collapse changes nothing. Along its border a half-edge collapse makes v–u–w to v–w, and the triangle between is lost or gained; a
// full-edge one makes a–u–v–w to a–p–w, which is three triangles with p.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progressive/progressive_mesh.h"

namespace etalon::adapt {

class ChartBorders {
 public:
  struct Face {
    std::array<Vec2f, 3> uv;
    std::uint32_t chart = 0;  ///< of find_charts() at the finest level
  };
  /// A triangle between a border before and after a collapse.
  struct Bend {
    std::array<Vec2f, 3> uv;
    std::uint32_t chart = 0;
    bool lost = false;  ///< by the collapse: it was in the chart before and is not after; else gained
  };

  /// Goes once from the finest level to the base. The mesh needs texture coordinates (InputError) and is left at its base.
  explicit ChartBorders(progressive::ProgressiveMesh& mesh);

  [[nodiscard]] std::size_t split_count() const { return first_bend_.size() - 1; }
  [[nodiscard]] const std::vector<Face>& finest_faces() const { return faces_; }
  /// Of split n: none, or some for each side of the curve that its vertex is on.
  [[nodiscard]] std::span<const Bend> bends(std::size_t n) const {
    return std::span<const Bend>(bends_).subspan(first_bend_[n], first_bend_[n + 1] - first_bend_[n]);
  }

 private:
  std::vector<Face> faces_;
  std::vector<Bend> bends_;
  std::vector<std::size_t> first_bend_;
};

}  // namespace etalon::adapt
