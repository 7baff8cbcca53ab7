// The library's jobs and OpenGL contexts again and again in one process: memory does not grow from run to run.
#include <malloc.h>

#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

#include <doctest/doctest.h>

#include "core/adapt/adapt_sequence.h"
#include "core/bake/bake.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/procedural/knot.h"
#include "core/procedural/swirl.h"
#include "core/progressive/epm_format.h"
#include "core/progressive/progressive_mesh.h"
#include "core/wavelet/texture_stream.h"
#include "raster/cpu_renderer.h"
#include "tests/support/skip.h"
#ifdef ETALON_HAVE_GPU
#include "gpu/gl_renderer.h"
#endif

using namespace etalon;

namespace {

bool is_full_suite() { return std::getenv("ETALON_FULL") != nullptr && *std::getenv("ETALON_FULL") != '\0'; }

std::size_t bytes_in_use() { return mallinfo2().uordblks + mallinfo2().hblkhd; }

std::size_t open_files() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

DrawList triangle() {
  DrawList list;
  list.vertices = {{.x = 512, .y = 512, .color = {1, 0, 0, 1}},
                   {.x = 7000, .y = 1024, .color = {0, 1, 0, 1}},
                   {.x = 4000, .y = 7000, .color = {0, 0, 1, 1}}};
  list.triangles = {{0, 1, 2}};
  list.draws = {{.triangle_count = 1}};
  return list;
}

/// Simplified to a progressive mesh, stored, read, brought to its coarsest level; its cells; a scan baked; a texture coded; a frame.
std::size_t run_jobs(const procedural::Model& swirl, const Mesh& scan) {
  const progressive::ProgressiveResult made = progressive::make_progressive(swirl.mesh, {.target_faces = 20});
  const std::string file = progressive::encode_epm(made.data);
  progressive::EpmContent content = progressive::decode_epm(std::as_bytes(std::span(file.data(), file.size())));
  const adapt::AdaptSequence cells(content.mesh);
  raster::CpuRenderer renderer;
  std::size_t sum = cells.size() + renderer.render(triangle(), {.width = 32, .height = 32, .targets = {{}}})[0].bytes().size();
  sum += bake::bake_scan(scan, {.target_faces = 40, .width = 64, .height = 64}).texture.bytes().size();
  const wavelet::EncodedTexture coded = wavelet::encode_texture(swirl.texture);
  return sum + wavelet::decode_texture(coded.bytes).image.bytes().size();
}

}  // namespace

TEST_CASE("faults: memory does not grow when the jobs of the library run again and again") {
  const procedural::Model swirl = procedural::make_swirl({.faces = 60, .texture_size = 64});
  const Mesh scan = procedural::make_knot({.rings = 20, .around = 6});
  set_thread_count(1);  // pools of threads fill up as work happens to fall to them
  const int warm_up = 30, runs = is_full_suite() ? 10'000 : 150;
  std::size_t first = 0, differing = 0;
  for (int n = 0; n < warm_up; ++n) first = run_jobs(swirl, scan);
  const std::size_t before = bytes_in_use(), files = open_files();
  for (int n = 0; n < runs; ++n) differing += run_jobs(swirl, scan) != first ? 1 : 0;
  const std::size_t after = bytes_in_use();
  set_thread_count(0);
  CHECK(differing == 0);
  // The smallest thing that could leak is an allocation of 24 bytes (glibc) in each run; pools may be filled up meanwhile.
  CHECK(after < before + 24 * static_cast<std::size_t>(runs));
  CHECK(open_files() == files);
  MESSAGE(runs << " runs: " << before << " bytes in use before, " << after << " after");
}

#ifdef ETALON_HAVE_GPU
namespace {

/// Bytes that `count` runs of `run` leave in use, after a tenth of them to fill pools.
template <class Run>
std::size_t growth(int count, const Run& run) {
  for (int n = 0; n < count / 10; ++n) run();
  const std::size_t before = bytes_in_use();
  for (int n = 0; n < count; ++n) run();
  const std::size_t after = bytes_in_use();
  return after > before ? after - before : 0;
}

}  // namespace

// OSMesa (Mesa 22.3.6) itself keeps some 200 to 300 bytes of each context that it is asked to destroy, also in a C program without ours. What GlRenderer makes in one (a program, a
// framebuffer, buffers, each more than that with its driver's state) would at least double it if it stayed.
TEST_CASE("faults: OpenGL contexts made, drawn with and given back keep no more than contexts alone") {
  const DrawList list = triangle();
  const auto run = [&] {
    gpu::GlRenderer renderer;
    return renderer.render(list, {.width = 32, .height = 32, .targets = {{}}})[0].sha256();
  };
  std::string first;
  try {
    first = run();
  } catch (const UnavailableError& error) {
    test::report_skip("OpenGL contexts again and again", error.what());
    return;
  }
  const int runs = is_full_suite() ? 10'000 : 200;
  const std::size_t alone = growth(runs, [] { gpu::make_context()->make_current(); });
  const std::size_t files = open_files();
  std::size_t differing = 0;
  const std::size_t ours = growth(runs, [&] { differing += run() != first ? 1 : 0; });
  CHECK(differing == 0);
  CHECK(ours < 2 * alone + 24 * static_cast<std::size_t>(runs));
  CHECK(open_files() == files);
  MESSAGE(runs << " contexts: " << ours << " bytes kept, by contexts alone " << alone);
}
#endif
