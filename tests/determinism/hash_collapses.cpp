// etalon_hash_collapses [--threads N[,N…]] [--golden FILE] [MESH…]: simplifies by every metric, half-edge and full-edge, and prints a line a
// result: SHA256 MODEL METRIC KIND. Without meshes: two built-in models, one with vertex colours, one with texture coordinates. Results that
// differ between thread counts, or from FILE (lines as printed), are named. Exit code 0: none; 1: some; 64: usage.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/procedural/head.h"
#include "core/procedural/knot.h"
#include "core/simplify/simplify.h"
#ifdef ETALON_HASH_MESH_FILES
#include "core/io/mesh_file.h"
#include "core/mesh/weld.h"
#endif

using namespace etalon;
using namespace etalon::simplify;

namespace {

struct Arguments {
  std::vector<int> threads{1};
  std::string golden;
  std::vector<std::string> meshes;
};

bool parse(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--threads" && i + 1 < argc) {
      arguments.threads.clear();
      std::istringstream list(argv[++i]);
      for (std::string number; std::getline(list, number, ',');) arguments.threads.push_back(std::atoi(number.c_str()));
    } else if (word == "--golden" && i + 1 < argc) {
      arguments.golden = argv[++i];
    } else if (word.starts_with("--")) {
      return false;
    } else {
      arguments.meshes.push_back(word);
    }
  }
  for (const int count : arguments.threads)
    if (count < 1) return false;
#ifndef ETALON_HASH_MESH_FILES
  if (!arguments.meshes.empty()) return false;
#endif
  return !arguments.threads.empty();
}

std::vector<std::pair<std::string, Mesh>> models_of(const Arguments& arguments) {
  std::vector<std::pair<std::string, Mesh>> models;
#ifdef ETALON_HASH_MESH_FILES
  for (const std::string& path : arguments.meshes)
    models.emplace_back(std::filesystem::path(path).stem().string(), welded_by_position(io::read_mesh(path).mesh));
#endif
  if (!models.empty()) return models;
  models.emplace_back("knot", procedural::make_knot(procedural::knot_of_faces(10'000)));
  models.emplace_back("head", procedural::make_head().mesh);
  return models;
}

bool suits(const Mesh& mesh, MetricName metric, CollapseKind kind) {
  switch (metric) {
    case MetricName::qem: return true;
    case MetricName::qem5: return mesh.has_uv;
    case MetricName::qem6:
    case MetricName::hoppe: return !mesh.colors.empty();
    case MetricName::kim: return !mesh.colors.empty() && kind == CollapseKind::half;
    case MetricName::aps: return mesh.has_uv && kind == CollapseKind::half;
  }
  return false;
}

template <class T>
void update(Sha256& hash, const std::vector<T>& values) {
  hash.update(values.data(), values.size() * sizeof(T));
}

// Everything that goes into files and documents.
std::string hash_of(const SimplifyResult& result) {
  Sha256 hash;
  update(hash, result.mesh.positions);
  update(hash, result.mesh.colors);
  update(hash, result.mesh.wedges);
  update(hash, result.mesh.faces);
  update(hash, result.source_face);
  for (const Landing& landing : result.landings) {
    hash.update(&landing.face.index, sizeof landing.face.index);
    hash.update(&landing.weights, sizeof landing.weights);
  }
  hash.update(result.refusals.data(), sizeof result.refusals);
  for (const double figure : {result.max_cost, result.error, result.distance_max.value_or(-1), result.distance_audited.value_or(-1)})
    hash.update(&figure, sizeof figure);
  return hash.hex();
}

std::map<std::string, std::string> read_golden(const std::string& path) {
  std::map<std::string, std::string> golden;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (const std::size_t blank = line.find("  "); blank != std::string::npos) golden[line.substr(blank + 2)] = line.substr(0, blank);
  return golden;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fprintf(stderr, "usage: etalon_hash_collapses [--threads N[,N...]] [--golden FILE] [MESH...]\n");
    return 64;
  }
  int differing = 0;
  try {
    const std::map<std::string, std::string> golden = read_golden(arguments.golden);
    std::map<std::string, std::string> seen;
    for (const auto& [name, mesh] : models_of(arguments))
      for (const MetricName metric : kMetricNames)
        for (const CollapseKind kind : {CollapseKind::half, CollapseKind::full}) {
          if (!suits(mesh, metric, kind)) continue;
          const std::string way = name + " " + to_string(metric) + " " + to_string(kind);
          for (const int threads : arguments.threads) {
            set_thread_count(threads);
            // A tolerance of a hundredth of the diagonal: landings, and the audit, which is the part that has threads.
            const std::string hash = hash_of(simplify_mesh(mesh, {.metric = metric,
                                                                  .collapse = kind,
                                                                  .target_faces = faces_for_ratio(mesh.face_count(), 0.1),
                                                                  .tolerance = 0.01 * bounding_box(mesh).diagonal()}));
            const auto [first, is_new] = seen.emplace(way, hash);
            if (is_new) std::printf("%s  %s\n", hash.c_str(), way.c_str());
            if (first->second != hash) {
              ++differing;
              std::printf("differs with %d threads: %s  %s\n", threads, hash.c_str(), way.c_str());
            }
          }
          if (arguments.golden.empty()) continue;
          const auto wanted = golden.find(way);
          if (wanted == golden.end() || wanted->second != seen[way]) {
            ++differing;
            std::printf("expected %s  %s\n", wanted == golden.end() ? "nothing" : wanted->second.c_str(), way.c_str());
          }
          std::fflush(stdout);
        }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "etalon_hash_collapses: %s\n", error.what());
    return 1;
  }
  return differing > 0 ? 1 : 0;
}
