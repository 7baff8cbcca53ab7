// A glTF 2.0 document with its buffers: checked access, so that whoever walks it can only meet values that are there. Not for use outside core/io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/io/inputs.h"
#include "core/io/json_ref.h"

namespace etalon::io {

/// `count` elements of `component_count` numbers each, all of them inside the buffer.
struct GltfAccessor {
  std::span<const std::byte> bytes;
  std::size_t stride_bytes = 0;
  std::size_t count = 0;
  std::uint64_t component_type = 0;
  int component_count = 0;
  bool normalized = false;
  std::string path;

  /// Component `c` of element `i` as float32; normalised integers divided by their maximum.
  [[nodiscard]] float real(std::size_t i, int c) const;
  /// Element `i` of an unsigned scalar accessor.
  [[nodiscard]] std::uint32_t index(std::size_t i) const;
};

class GltfDocument {
 public:
  /// Parses a .glb container or plain .gltf JSON.
  GltfDocument(const std::filesystem::path& path, const FileBytes& content);
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  [[nodiscard]] JsonRef root() const { return {json_, "glTF", file_}; }
  [[nodiscard]] GltfAccessor accessor(std::uint64_t index);
  [[nodiscard]] std::span<const std::byte> buffer_view(std::uint64_t index);
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// The files that buffers were read from so far.
  [[nodiscard]] const std::vector<std::filesystem::path>& buffer_files() const { return buffer_files_; }

 private:
  std::string_view split_container(std::span<const std::byte> content);
  std::span<const std::byte> buffer(std::uint64_t index);

  std::string file_;
  std::filesystem::path folder_;
  nlohmann::json json_;
  std::optional<std::span<const std::byte>> binary_chunk_;
  struct Buffer {
    bool loaded = false;
    FileBytes own;
    std::span<const std::byte> bytes;
  };
  std::vector<Buffer> buffers_;
  std::vector<std::filesystem::path> buffer_files_;
};

/// The bytes of a "data:…;base64,…" URI; nothing where `uri` is no such. InputError through `at` for malformed base64.
[[nodiscard]] std::optional<FileBytes> decode_data_uri(const JsonRef& at, const std::string& uri);

/// `uri` with its %XX decoded.
[[nodiscard]] std::string percent_decoded(const std::string& uri);

}  // namespace etalon::io
