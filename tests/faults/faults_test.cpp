// What happens around the program: it is killed, the disk is full, it is called again and again.
#include <malloc.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include <doctest/doctest.h>

#include "core/base/error.h"
#include "core/base/rng.h"
#include "core/io/atomic_file.h"
#include "core/io/image_file.h"
#include "core/io/mesh_file.h"
#include "core/procedural/swirl.h"
#include "core/simplify/simplify.h"
#include "tests/io/scratch.h"
#include "tests/support/skip.h"

using namespace etalon;
using test::content_of;
using test::ScratchFolder;

namespace {

namespace fs = std::filesystem;

bool is_full_suite() { return std::getenv("ETALON_FULL") != nullptr && *std::getenv("ETALON_FULL") != '\0'; }

/// A child that replaces both files for ever, by turns with all '0' and all '1', until it is killed.
pid_t start_writer(const fs::path& one, const fs::path& other) {
  const pid_t child = fork();
  if (child != 0) return child;
  for (char c = '0';; c = c == '0' ? '1' : '0') io::write_files({{one, std::string(300'000, c)}, {other, std::string(5'000, c)}});
}

bool is_whole(const std::string& content, std::size_t size) {
  return content.size() == size && content.find_first_not_of(content.front()) == std::string::npos;
}

}  // namespace

TEST_CASE("faults: a writer killed at any time leaves whole files") {
  const ScratchFolder folder;
  const fs::path one = folder / "one", other = folder / "other";
  io::write_files({{one, std::string(300'000, '0')}, {other, std::string(5'000, '0')}});
  Rng rng(3);
  const int kills = is_full_suite() ? 10'000 : 300;
  int changed = 0, temporaries = 0;
  std::string before = content_of(one);
  for (int n = 0; n < kills; ++n) {
    const pid_t child = start_writer(one, other);
    REQUIRE(child > 0);
    usleep(static_cast<useconds_t>(rng.below(std::uint64_t{1} << (8 + rng.below(9)))));  // up to 1/4 ms … 65 ms: disks differ
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    REQUIRE(is_whole(content_of(one), 300'000));
    REQUIRE(is_whole(content_of(other), 5'000));
    changed += content_of(one) != before ? 1 : 0;
    before = content_of(one);
    // Nobody is left to remove temporary files; they are under other names.
    for (const auto& entry : fs::directory_iterator(one.parent_path()))
      if (entry.path() != one && entry.path() != other) temporaries += fs::remove(entry.path()) ? 1 : 0;
  }
  // Kills fell into the writing and behind it, or they prove nothing.
  CHECK(changed > 0);
  CHECK(temporaries > 0);
  MESSAGE(kills << " kills: " << changed << " times the other version, " << temporaries << " temporary files");
}

TEST_CASE("faults: a full disk leaves the old files and no temporary") {
  const ScratchFolder folder;
  const fs::path disk = folder / "disk";
  fs::create_directories(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=256k") != 0) {
    test::report_skip("full disk", "a small tmpfs cannot be mounted here");
    return;
  }
  struct Unmount {
    const fs::path& disk;
    ~Unmount() { umount2(disk.c_str(), MNT_DETACH); }
  } unmount{disk};
  const Mesh small = procedural::make_swirl({.faces = 8, .texture_size = 64}).mesh,
             large = procedural::make_swirl({.faces = 20'000, .texture_size = 64}).mesh;
  for (const char* name : {"m.obj", "m.ply", "m.glb"}) {
    CAPTURE(name);
    io::write_mesh(disk / name, small);
    const std::string before = content_of(disk / name);
    CHECK_THROWS_AS(io::write_mesh(disk / name, large), WriteError);
    CHECK(content_of(disk / name) == before);
    CHECK(std::distance(fs::directory_iterator(disk), fs::directory_iterator()) == 1);
    fs::remove(disk / name);
  }
  for (const char* name : {"i.png", "i.tif", "i.exr"}) {
    CAPTURE(name);
    const bool is_real = std::string(name) == "i.exr";
    Image noise(512, 512, is_real ? kRgba32f : kRgba8);
    Rng rng(1);
    for (std::byte& b : noise.bytes()) b = static_cast<std::byte>(rng.below(64));
    io::write_image(disk / name, Image(2, 2, noise.format()));
    const std::string before = content_of(disk / name);
    CHECK_THROWS_AS(io::write_image(disk / name, noise), WriteError);
    CHECK(content_of(disk / name) == before);
    CHECK(std::distance(fs::directory_iterator(disk), fs::directory_iterator()) == 1);
    fs::remove(disk / name);
  }
}

TEST_CASE("faults: memory does not grow when files are read, refused, simplified and written again and again") {
  const ScratchFolder folder;
  const procedural::Model model = procedural::make_swirl({.faces = 50, .texture_size = 64});
  const auto path = [&](const char* name) { return folder / name; };
  const auto run = [&] {
    for (const char* name : {"m.obj", "m.ply", "m.glb"}) {
      io::write_mesh(path(name), model.mesh);
      const io::LoadedModel loaded = io::read_mesh(path(name));
      (void)simplify::simplify_mesh(loaded.mesh, {.target_faces = 20});
    }
    for (const char* name : {"i.png", "i.tif", "i.exr"}) {
      const bool is_real = std::string(name) == "i.exr";
      io::write_image(path(name), Image(8, 8, is_real ? kRgba32f : kRgba8));
      (void)io::read_image(path(name));
      const std::string whole = content_of(path(name));
      const std::string half = whole.substr(0, whole.size() / 2);
      CHECK_THROWS_AS((void)io::decode_image(std::as_bytes(std::span(half.data(), half.size())), "half"), InputError);
    }
  };
  const int warm_up = 100, runs = is_full_suite() ? 10'000 : 400;
  for (int n = 0; n < warm_up; ++n) run();
  const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
  for (int n = 0; n < runs; ++n) run();
  const std::size_t after = mallinfo2().uordblks + mallinfo2().hblkhd;
  // The smallest thing that could leak is an allocation of 24 bytes (glibc) in each run; pools may be filled up meanwhile.
  CHECK(after < before + 24 * static_cast<std::size_t>(runs));
  MESSAGE(runs << " runs: " << before << " bytes in use before, " << after << " after");
}
