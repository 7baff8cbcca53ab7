// One SHA-256 over all the bytes of the fixed scenes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/draw/renderer.h"
#include "validation/selftest/fixed_scenes.h"

namespace etalon::validation {

/// The hash of each family's images, and over these the one hash.
struct SceneHashes {
  struct Family {
    std::string name;
    std::string sha256;
    friend bool operator==(const Family&, const Family&) = default;
  };
  std::string all;  ///< sha256 of the lines "SHA256  NAME\n" of the families
  std::vector<Family> families;
  friend bool operator==(const SceneHashes&, const SceneHashes&) = default;

  /// Name of the first family in which `other` differs; empty where none does.
  [[nodiscard]] std::string first_difference(const SceneHashes& other) const;
};

/// Draws everything. Multi-byte channels are hashed with their lowest byte first, so the hash is the same on big-endian machines.
/// `after_family(done)` is called after each family.
[[nodiscard]] SceneHashes hash_scenes(const std::vector<SceneFamily>& families, Renderer& renderer,
                                      const std::function<void(int)>& after_family = {});

/// The hashes that this version must give (data/golden/hash_scenes.sha256, compiled in).
[[nodiscard]] const SceneHashes& golden_scene_hashes();

/// The text of a golden file: the line of the one hash, then a line a family. InputError where it is no such text, or where the one
/// hash is not that of the others.
[[nodiscard]] SceneHashes parse_scene_hashes(const std::string& text);
/// The same text from the hashes.
[[nodiscard]] std::string to_text(const SceneHashes& hashes);

}  // namespace etalon::validation
