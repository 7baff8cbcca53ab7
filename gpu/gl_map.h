// A resident map on the device: two textures take turns, and a pass is one framebuffer binding and one indexed draw.
//
// A pass may not read the texture it draws into. So pass k draws from A into B; B lacks what pass k − 1 drew into A, whose triangles are drawn
// again before those of pass k, each texel fetched from its own place in A. Both lie one behind the other in the index buffer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/draw/resident_map.h"
#include "gpu/context.h"
#include "gpu/gl_objects.h"
#include "gpu/gl_pipeline.h"

namespace etalon::gpu {

/// Float32 texels below 2^-40 in magnitude enter a linearly filtered map as 0, as everywhere on the device (docs/contract.md#input): unlike the
/// exact renderer's, those that no pass writes are read back as 0. Results below 2^-40 stay as they are in later passes, where the exact
/// renderer reads 0: its lookups differ by less than 2^-40. Coordinates of an indexing map are none of these.
class GlMap : public ResidentMap {
 public:
  /// `map` in a format that is stored as it is (stored_target_format(), not srgb8). The context must outlive it.
  GlMap(Context& context, const DeviceLimits& limits, const Image& map, const MapState& state);
  ~GlMap() override;
  GlMap(const GlMap&) = delete;
  GlMap& operator=(const GlMap&) = delete;

  void apply(std::span<const MapPass> passes) override;
  [[nodiscard]] Image read_back() override;

 private:
  /// A vertex as the buffer holds it.
  struct GlVertex {
    float position[4];
    float uv[2];
    std::uint32_t pass;
  };
  /// Vertices and indices of consecutive passes.
  struct Geometry {
    std::vector<GlVertex> vertices;
    std::vector<std::uint32_t> indices;
    void append(const MapPass& pass, std::uint32_t number, const Frame& frame);
    void append(const Geometry& other);
  };
  struct Side {
    GlHandle texture, framebuffer;
  };
  [[nodiscard]] Side make_side(const Image& map, const DeviceLimits& limits) const;
  void draw(std::span<const MapPass> passes);
  void set_state();
  void upload(const Geometry& geometry) const;

  Context& context_;
  const gl::Api& gl_;
  Frame frame_;
  Filter filter_;
  DrawList list_;  ///< of a pass, with the map as it came in: for validation
  GlHandle vertex_array_, vertices_, indices_, program_;
  gl::Int pass_location_ = -1;
  std::array<Side, 2> sides_;
  std::size_t current_ = 0;  ///< the side that holds the map
  std::uint32_t passes_ = 0;
  Geometry last_;  ///< of the last pass: the other side lacks it
};

}  // namespace etalon::gpu
