// The native shaders, written for what a frame asks: what an application would write, varyings and texture().
// Does not: branch on shading at run time, or compute anything no target receives.
#pragma once

#include <string>
#include <vector>

#include "core/draw/draw_list.h"

namespace etalon::gpu {

// Vertex attributes by location, and the texture unit of each sampler.
inline constexpr unsigned kPositionLocation = 0;
inline constexpr unsigned kUvLocation = 1;
inline constexpr unsigned kColorLocation = 2;
inline constexpr unsigned kIdentityLocation = 3;  ///< triangle id and corner, unsigned integers
inline constexpr int kImageUnit = 0;
inline constexpr int kIndexingMapUnit = 1;

/// Passes uv, colour, id and barycentric corner on; triangles share no vertices. The three vertices have the same id: the provoking one cannot
/// matter. Not from gl_VertexID: softpipe begins it anew with each batch of vertices.
[[nodiscard]] std::string vertex_shader_source();

/// One output per target that is not depth, in order, at consecutive locations.
[[nodiscard]] std::string fragment_shader_source(Shading shading, const std::vector<TargetSpec>& targets);

}  // namespace etalon::gpu
