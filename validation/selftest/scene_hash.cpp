#include "validation/selftest/scene_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <sstream>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "raster/cpu_renderer.h"
#include "validation/selftest/golden_text.h"

namespace etalon::validation {
namespace {

std::string name_of_all() { return fmt::format("all scenes, contract {}", raster::kRasterContractVersion); }

void hash_image(Sha256& hash, const Image& image) {
  const std::string header = fmt::format("{} {} {}\n", to_string(image.format()), image.width(), image.height());
  hash.update(header.data(), header.size());
  if (std::endian::native == std::endian::little) {
    hash.update(image.bytes());
    return;
  }
  const auto channel_bytes = static_cast<std::size_t>(bytes_per_channel(image.format().type));
  std::vector<std::byte> bytes(image.bytes().begin(), image.bytes().end());
  for (std::size_t at = 0; at < bytes.size(); at += channel_bytes) std::reverse(bytes.data() + at, bytes.data() + at + channel_bytes);
  hash.update(bytes);
}

std::string lines_of(const std::vector<SceneHashes::Family>& families) {
  std::string lines;
  for (const SceneHashes::Family& family : families) lines += fmt::format("{}  {}\n", family.sha256, family.name);
  return lines;
}

std::string hash_of_lines(const std::vector<SceneHashes::Family>& families) {
  const std::string lines = lines_of(families);
  Sha256 hash;
  hash.update(lines.data(), lines.size());
  return hash.hex();
}

}  // namespace

std::string SceneHashes::first_difference(const SceneHashes& other) const {
  for (std::size_t n = 0; n < families.size(); ++n)
    if (n >= other.families.size() || families[n] != other.families[n]) return families[n].name;
  return families.size() == other.families.size() ? "" : other.families[families.size()].name;
}

SceneHashes hash_scenes(const std::vector<SceneFamily>& families, Renderer& renderer, const std::function<void(int)>& after_family) {
  SceneHashes hashes;
  for (const SceneFamily& family : families) {
    Sha256 hash;
    for (const FixedScene& scene : family.scenes)
      for (const Image& image : renderer.render(scene.list, scene.frame)) hash_image(hash, image);
    hashes.families.push_back({family.name, hash.hex()});
    if (after_family) after_family(static_cast<int>(hashes.families.size()));
  }
  hashes.all = hash_of_lines(hashes.families);
  return hashes;
}

const SceneHashes& golden_scene_hashes() {
  static const SceneHashes kGolden = parse_scene_hashes(kGoldenText);
  return kGolden;
}

SceneHashes parse_scene_hashes(const std::string& text) {
  std::istringstream lines(text);
  std::vector<SceneHashes::Family> entries;
  for (std::string line; std::getline(lines, line);) {
    const bool is_hash = line.size() > 66 && line.substr(64, 2) == "  " && line.find_first_not_of("0123456789abcdef") == 64;
    if (!is_hash)
      throw InputError(
          fmt::format("golden hashes: line {}: expected 64 hex digits, two blanks, a name, got '{}'", entries.size() + 1, line));
    entries.push_back({line.substr(66), line.substr(0, 64)});
  }
  if (entries.size() < 2 || entries[0].name != name_of_all())
    throw InputError(
        fmt::format("golden hashes: expected a first line for '{}' and a line a family, got {} lines", name_of_all(), entries.size()));
  SceneHashes hashes{entries[0].sha256, {entries.begin() + 1, entries.end()}};
  if (hashes.all != hash_of_lines(hashes.families))
    throw InputError(fmt::format("golden hashes: the first line is not the hash of the others: expected {}, got {}",
                                 hash_of_lines(hashes.families), hashes.all));
  return hashes;
}

std::string to_text(const SceneHashes& hashes) { return fmt::format("{}  {}\n", hashes.all, name_of_all()) + lines_of(hashes.families); }

}  // namespace etalon::validation
