// Writes streams of today's encoders and what they decode to: etalon_make_streams FOLDER, for a new version under data/streams. Frozen ones stay.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "core/adapt/cell_chunks.h"
#include "core/base/rng.h"
#include "core/base/sha256.h"
#include "core/io/atomic_file.h"
#include "core/io/draws_file.h"
#include "core/io/inputs.h"
#include "core/joint/joint_stream.h"
#include "core/joint/marginal_analysis.h"
#include "core/mesh/weld.h"
#include "core/procedural/swirl.h"
#include "core/progressive/epm_format.h"
#include "core/terrain/removal_order.h"
#include "tests/streams/decoded_stream.h"

namespace {

namespace fs = std::filesystem;
using namespace etalon;

std::string swirl_epm(simplify::CollapseKind collapse, bool has_colors) {
  Mesh mesh = welded_by_position(procedural::make_swirl({.faces = 162, .texture_size = 16}).mesh);
  for (std::size_t v = 0; has_colors && v < mesh.positions.size(); ++v)
    mesh.colors.push_back({static_cast<float>(v % 4) / 4, static_cast<float>(v % 8) / 8, 0.5f, 1});
  for (std::size_t f = 0; has_colors && f < mesh.face_count(); ++f) mesh.face_materials.push_back(f % 18 < 9 ? 0 : 1);
  progressive::ProgressiveData data = progressive::make_progressive(mesh, {.collapse = collapse, .target_faces = 0}).data;
  if (has_colors) data.material_names = {"left", "right"};
  progressive::ProgressiveMesh levels(data);
  return progressive::encode_epm(data, adapt::encode_cells(adapt::AdaptSequence(levels)));
}

/// A hill with a ridge, 10 m from point to point.
terrain::HeightField hill(int bits) {
  const int side = (1 << bits) + 1;
  terrain::HeightField field{.bits = bits, .spacing = 10, .unit = 0x1p-6, .uv_start = 0.5 / side, .uv_step = 1.0 / side, .heights = {}};
  Rng rng(9);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int slope = (i - 16) * (i - 16) + (j - 12) * (j - 12), ridge = std::max(0, 300 - 100 * std::abs(i + j - 30));
      field.heights.push_back(1280 - 2 * slope + ridge + static_cast<int>(rng.below(40)));
    }
  return field;
}

Image stripes(int width, int height, PixelFormat format) {
  Image image(width, height, format);
  Rng rng(4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < format.channels; ++c)
        image.channels<std::uint8_t>(x, y)[c] =
            static_cast<std::uint8_t>((x * 5 + y * (3 + c)) / 3 % 200 + static_cast<int>(rng.below(30)));
  return image;
}

terrain::TerrainView low_view() { return {.eye = {0, 120, 260}, .target = {0, 20, 0}, .near = 1, .far = 2000, .width = 64, .height = 48}; }

std::string hill_stream(bool has_view) {
  const terrain::HeightField field = terrain::with_unit(hill(5), 0.25);
  const terrain::Levels levels = terrain::make_levels(5, terrain::removal_order(field), std::vector<std::uint32_t>{5, 20, 80, 320, 1089});
  return terrain::encode_terrain(field, levels, has_view ? std::optional(low_view()) : std::nullopt).bytes;
}

std::string text_of(const std::vector<std::byte>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::string joint_file() {
  const joint::JointLevels levels =
      joint::make_joint_levels(hill(5), stripes(48, 40, kRgb8), low_view(), {.meshes = 6, .textures = 5, .from = 0.01, .to = 0.4});
  joint::Problem problem = joint::problem_of(levels, [](std::size_t i, std::size_t j) -> std::uint64_t { return i * 10 > j * 11 ? 1 : 2; });
  return text_of(joint::encode_joint(levels, joint::marginal_analysis(problem)));
}

void write_scene(const fs::path& path) {
  DrawList list;
  list.images = {std::make_shared<const Image>(stripes(4, 4, kRgba8))};
  list.vertices = {{.x = 256, .y = 256, .z = 0.25f, .w = 1, .uv = {0, 0}},
                   {.x = 7000, .y = 512, .z = 0.5f, .w = 2, .uv = {1, 0}},
                   {.x = 3000, .y = 7500, .z = 0.75f, .w = 4, .uv = {0.5f, 1}},
                   {.x = -900, .y = 4000, .color = {1, 0.5f, 0.25f, 1}}};
  list.triangles = {{0, 1, 2}, {2, 3, 0}};
  list.draws = {{.triangle_count = 1, .shading = Shading::texture, .texture = 0}, {.first_triangle = 1, .triangle_count = 1}};
  io::write_draws(path, list, {.width = 32, .height = 32});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("etalon_make_streams: expected FOLDER\n", stderr);
    return 64;
  }
  const fs::path folder = argv[1];
  fs::create_directories(folder);
  io::write_file(folder / "swirl.epm", swirl_epm(simplify::CollapseKind::half, false));
  io::write_file(folder / "swirl_full_edge.epm", swirl_epm(simplify::CollapseKind::full, true));
  io::write_file(folder / "hill.ettm", hill_stream(false));
  io::write_file(folder / "hill_view.ettm", hill_stream(true));
  using wavelet::Kernel;
  io::write_file(folder / "stripes_5_3.etws",
                 text_of(wavelet::encode_texture(stripes(37, 29, kRgb8), {.kernel = Kernel::reversible_5_3}).bytes));
  io::write_file(folder / "stripes_9_7.etws",
                 text_of(wavelet::encode_texture(stripes(37, 29, {ChannelType::unorm8, 1}), {.kernel = Kernel::irreversible_9_7}).bytes));
  io::write_file(folder / "hill.ejt", joint_file());
  write_scene(folder / "scene.draws");
  std::string goldens;
  for (const char* name : {"hill.ejt", "hill.ettm", "hill_view.ettm", "scene.draws", "stripes_5_3.etws", "stripes_9_7.etws", "swirl.epm",
                           "swirl_full_edge.epm"}) {
    const io::FileBytes file = io::read_file(folder / name);
    const std::span<const std::byte> bytes = file.bytes();
    // Two thirds of the bytes: what a reader makes of a stream that has not arrived as a whole. A drawing has no prefix.
    const bool has_prefix = std::string_view(name) != "scene.draws";
    const std::span<const std::byte> prefix = bytes.first(has_prefix ? bytes.size() * 2 / 3 : bytes.size());
    goldens += fmt::format("{} {} {} {} {} {}\n", name, bytes.size(), sha256_hex(bytes), test::decoded_sha256(folder / name, bytes),
                           prefix.size(), test::decoded_sha256(folder / name, prefix));
  }
  io::write_file(folder / "GOLDENS", goldens);
  return 0;
}
