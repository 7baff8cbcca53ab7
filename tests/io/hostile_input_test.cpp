// Files cut short at every byte and files with bytes changed: each is refused by an InputError in one line, or read. Nothing else may happen.
#include <doctest/doctest.h>

#include <array>
#include <cstdlib>

#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "tests/io/mesh_builder.h"
#include "tests/io/scratch.h"

namespace etalon::io {
namespace {

using test::Colors;
using test::content_of;
using test::input_error;
using test::ScratchFolder;

/// "no error", or the message after a check of its form; anything but InputError fails the test by itself.
template <class Read>
std::string outcome(const std::string& name, const Read& read) {
  const std::string message = input_error(read);
  if (message == "no error") return message;
  CHECK_MESSAGE(message.starts_with(name), message);
  CHECK_MESSAGE(message.find('\n') == message.npos, message);
  CHECK_MESSAGE(message.size() < name.size() + 400, message);
  return message;
}

/// A mesh file of each format and flavour, small.
std::vector<std::filesystem::path> small_meshes(const ScratchFolder& folder) {
  std::vector<std::filesystem::path> paths;
  for (const char* name : {"a.obj", "a.ply", "a.glb"}) {
    write_mesh(folder / name, test::seam_mesh(true, Colors::bytes, true, 1));
    paths.push_back(folder / name);
  }
  const io::LoadedModel model = test::textured_model();
  for (const char* name : {"t.obj", "t.ply", "t.glb"}) {
    write_mesh(folder / name, model.mesh, model.materials);
    paths.push_back(folder / name);
  }
  paths.push_back(folder.put(
      "ascii.ply",
      "ply\nformat ascii 1.0\ncomment TextureFile x.png\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float s\nproperty float t\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty int texnumber\nelement tristrips 1\nproperty list int int vertex_indices\n"
      "end_header\n0 0 0 1 2 3 0 0\n1 0 0 1 2 3 1 0\n0 1 0 1 2 3 0 1\n3 0 1 2 0\n4 0 1 2 -1\n"));
  return paths;
}

std::vector<std::filesystem::path> small_images(const ScratchFolder& folder) {
  std::vector<std::filesystem::path> paths;
  const auto add = [&](const char* name, PixelFormat format) {
    write_image(folder / name, test::random_image(5, 4, format, 1));
    paths.push_back(folder / name);
  };
  add("a.png", kRgba8);
  add("b.png", {ChannelType::unorm16, 1});
  add("a.tif", kRgb8);
  add("b.tif", kRgba32f);
  add("a.exr", {ChannelType::half, 4});
  add("b.exr", kR32ui);
  return paths;
}

const std::string kOneByOneJpeg = [] {
  // Baseline, grey, 8×8 of value 128: one block of DC difference 0 and end of block; each Huffman table has one or two codes.
  std::string jpeg = "\xff\xd8\xff\xdb";
  jpeg += std::string("\x00\x43\x00", 3) + std::string(64, '\x01');                                           // quanta of 1
  jpeg += std::string("\xff\xc0\x00\x0b\x08\x00\x08\x00\x08\x01\x01\x11\x00", 13);                            // 8×8, one component
  jpeg += std::string("\xff\xc4\x00\x14\x00\x01", 6) + std::string(15, '\0') + std::string(1, '\0');          // DC: code 0 = size 0
  jpeg += std::string("\xff\xc4\x00\x14\x10\x01", 6) + std::string(15, '\0') + std::string(1, '\0');          // AC: code 0 = end of block
  jpeg += std::string("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00", 10) + "\x3f" + std::string("\xff\xd9", 2);  // bits 0 0, filled with ones
  return jpeg;
}();

TEST_CASE("hostile: meshes cut short at every byte") {
  const ScratchFolder folder;
  for (const auto& path : small_meshes(folder)) {
    const std::string whole = content_of(path);
    const bool is_text = path.extension() == ".obj" || path.filename() == "ascii.ply";
    REQUIRE(outcome(path.string(), [&] { (void)read_mesh(path); }) == "no error");
    std::size_t accepted_count = 0;
    for (std::size_t n = 0; n < whole.size(); ++n) {
      folder.put(path.filename().string(), whole.substr(0, n));
      accepted_count += outcome(path.string(), [&] { (void)read_mesh(path); }) == "no error";
    }
    // A shorter text can be a good file: without the last line end, or a face less. A shorter binary file never is.
    CAPTURE(path);
    if (!is_text) CHECK(accepted_count == 0);
    if (path.filename() == "ascii.ply") CHECK(accepted_count == 1);
    folder.put(path.filename().string(), whole);
  }
}

TEST_CASE("hostile: images cut short at every byte") {
  const ScratchFolder folder;
  std::vector<std::filesystem::path> paths = small_images(folder);
  paths.push_back(folder.put("a.jpg", kOneByOneJpeg));
  for (const auto& path : paths) {
    CAPTURE(path);
    const std::string whole = content_of(path);
    REQUIRE(outcome(path.string(), [&] { (void)read_image(path); }) == "no error");
    for (std::size_t n = 0; n < whole.size(); ++n) {
      folder.put(path.filename().string(), whole.substr(0, n));
      CHECK_MESSAGE(outcome(path.string(), [&] { (void)read_image(path); }) != "no error", "prefix of " << n << " of " << whole.size());
    }
  }
}

/// `whole` with one to three bytes changed, a stretch removed or doubled.
std::string mutant(const std::string& whole, Rng& rng) {
  static constexpr std::array<unsigned char, 8> kTelling = {0x00, 0x01, 0x7F, 0x80, 0xFF, '-', '9', '\n'};
  std::string text = whole;
  const std::uint64_t kind = rng.below(8);
  const std::size_t at = rng.below(text.size());
  if (kind == 0) return text.erase(at, 1 + rng.below(8));
  if (kind == 1) return text.insert(at, text.substr(at, 1 + rng.below(8)));
  for (std::uint64_t i = 0; i <= rng.below(3); ++i) {
    char& c = text[rng.below(text.size())];
    c = static_cast<char>(rng.coin() ? kTelling[rng.below(kTelling.size())] : static_cast<unsigned char>(c) ^ (1u << rng.below(8)));
  }
  return text;
}

/// How many times as many mutants as usual: 100 with ETALON_FULL in the environment.
int thoroughness() { return std::getenv("ETALON_FULL") != nullptr ? 100 : 1; }

TEST_CASE("hostile: mutants of meshes") {
  const ScratchFolder folder;
  Rng rng(7);
  std::size_t refused_count = 0;
  for (const auto& path : small_meshes(folder)) {
    const std::string whole = content_of(path);
    for (int i = 0; i < 3000 * thoroughness(); ++i) {
      folder.put(path.filename().string(), mutant(whole, rng));
      refused_count += outcome(path.string(), [&] { (void)read_mesh(path); }) != "no error";
    }
    folder.put(path.filename().string(), whole);
  }
  CHECK(refused_count > 1000);
}

TEST_CASE("hostile: mutants of images") {
  const ScratchFolder folder;
  Rng rng(8);
  std::size_t refused_count = 0;
  std::vector<std::filesystem::path> paths = small_images(folder);
  paths.push_back(folder.put("a.jpg", kOneByOneJpeg));
  for (const auto& path : paths) {
    const std::string whole = content_of(path);
    for (int i = 0; i < 1000 * thoroughness(); ++i) {
      folder.put(path.filename().string(), mutant(whole, rng));
      refused_count += outcome(path.string(), [&] { (void)read_image(path); }) != "no error";
    }
  }
  CHECK(refused_count > 1000);
}

}  // namespace
}  // namespace etalon::io
