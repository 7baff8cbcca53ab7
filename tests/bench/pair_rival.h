// Pairs of a terrain's meshes and textures on OpenGL, as an application would draw them at its fastest: all meshes and textures resident.
#pragma once

#include "gpu/context.h"
#include "tests/bench/joint_bench.h"

namespace etalon::bench {

/// The context must outlive the rival and be current.
[[nodiscard]] std::unique_ptr<PairRival> make_gl_pair_rival(gpu::Context& context, const validation::TerrainProblem& terrain);

}  // namespace etalon::bench
