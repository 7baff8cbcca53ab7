// What the four jobs make of built-in models, as hashes: the same for every machine, compiler and thread count, or a golden is wrong.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace etalon::test {

/// One thing that a job makes.
struct HashedWay {
  std::string name;  ///< job, model, options
  std::function<std::string()> hash;
};

/// Every metric, half-edge and full-edge collapses, with a tolerance: mesh, landings, refusals, errors.
std::vector<HashedWay> simplify_ways(const std::string& model, const Mesh& mesh);
std::vector<HashedWay> simplify_ways();
/// Progressive meshes as files; indexing maps in all formats and a texture taken down and up; the analytic map.
std::vector<HashedWay> adapt_ways();
/// Mesh and texture by every fill, with and without a gutter; a range image.
std::vector<HashedWay> bake_ways();
/// The order in which a terrain's points go, its stream and a mesh; texture streams and what prefixes of them decode to; errors of all pairs and the
/// files of paths.
std::vector<HashedWay> joint_ways();

}  // namespace etalon::test
