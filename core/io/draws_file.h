// FILE.draws (`etalon/draws/1`, docs/formats.md#draws): a drawing as data, so that another pipeline's geometry gets in, and the drawing that
// a golden image was made from can be kept beside it. A JSON header, then little-endian arrays; images stand beside it, named by path and sha256.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/draw/draw_list.h"

namespace etalon::io {

struct DrawsFile {
  Frame frame;    ///< `targets`: as the file names them, or none; each content at most once
  DrawList list;  ///< in raster space: what the file gives in clip space has been clipped and snapped; valid for `frame`
  std::vector<std::filesystem::path> image_paths;  ///< as they can be opened, in the order of list.images
  std::string sha256;                              ///< of the file itself
};

/// Reads the file and its images. source_faces: the file's triangle each triangle comes from, where any draw is in clip space; else none.
/// InputError "FILE: FIELD: what, expected, got": a wrong, missing or unknown field, arrays that do not end where the file does, an index
/// out of range or into vertices of the other space, a number that is not finite or out of range (docs/contract.md#input), an image that
/// is missing or has another sha256.
[[nodiscard]] DrawsFile read_draws(const std::filesystem::path& path);

/// Gives the image of this path and sha256; the result is InputError's business where it is not to be had.
using DrawsImageLoader = std::function<Image(const std::filesystem::path& path, const std::string& sha256)>;

/// The same from memory. `name` stands for the file in messages; relative image paths are taken from `folder`.
[[nodiscard]] DrawsFile decode_draws(std::span<const std::byte> bytes, const std::string& name, const std::filesystem::path& folder,
                                     const DrawsImageLoader& load_image);

/// The image files that write_draws writes beside `path`: STEM.0.png, STEM.1.exr, … (.png; .tif for two channels of integers; .exr for reals).
[[nodiscard]] std::vector<std::filesystem::path> draws_image_paths(const std::filesystem::path& path, const DrawList& list);

/// Writes the list, valid for `frame`, in raster space: read_draws() gives back the same list, frame and images, without source_faces.
/// Each file is replaced atomically, images first, so that a file never names an image that is not there; the file's own sha256. WriteError.
std::string write_draws(const std::filesystem::path& path, const DrawList& list, const Frame& frame);

}  // namespace etalon::io
