// etalon_hash_scenes [--threads N] [--each]: draws the fixed scenes and prints one sha256 over all their images.
// --each prints one line a scene before it, to find the first that differs.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "raster/cpu_renderer.h"
#include "tests/determinism/scenes.h"

int main(int argc, char** argv) {
  bool each = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--each") == 0) {
      each = true;
    } else if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) {
      etalon::set_thread_count(std::atoi(argv[++i]));
    } else {
      std::fprintf(stderr, "usage: etalon_hash_scenes [--threads N] [--each]\n");
      return 64;
    }
  }
  etalon::Sha256 all;
  for (const etalon::test::NamedScene& scene : etalon::test::determinism_scenes()) {
    etalon::Sha256 hash;
    for (const etalon::Image& image : etalon::raster::CpuRenderer().render(scene.list, scene.frame)) {
      const std::string digest = image.sha256();
      hash.update(digest.data(), digest.size());
    }
    const std::string digest = hash.hex();
    if (each) std::printf("%s  %s\n", digest.c_str(), scene.name.c_str());
    all.update(digest.data(), digest.size());
  }
  std::printf("%s\n", all.hex().c_str());
}
