// Texture streams beside OpenJPEG: the same pictures, kernels and numbers of bytes; PSNR over all bytes, and times of one thread.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "core/wavelet/subbands.h"
#include "tests/bench/figure.h"

namespace etalon::bench {

inline constexpr std::array<double, 5> kTextureRates = {0.1, 0.25, 0.5, 1, 2};  ///< bits per texel
/// OpenJPEG's PSNR less ours, at most: what the project promises.
inline constexpr double kMostPsnrBehind_db = 1;

struct TextureScene {
  std::string name, title;
  std::function<std::optional<Image>()> make;  ///< nothing where a real input is absent
};
[[nodiscard]] std::vector<TextureScene> texture_scenes();

/// One codec's coding of a picture at one rate.
struct CodedPicture {
  std::vector<std::byte> stream;                  ///< a code-stream without a file's boxes
  Image picture;                                  ///< decoded again
  double encode_seconds = 0, decode_seconds = 0;  ///< CPU, the library's calls alone
};
/// To at most max_bytes, a little more where the codec's own rate control errs.
using Codec = std::function<CodedPicture(const Image&, wavelet::Kernel, std::size_t max_bytes)>;

[[nodiscard]] CodedPicture code_with_ours(const Image& image, wavelet::Kernel kernel, std::size_t max_bytes);
/// One tile, six resolutions, 64 × 64 code-blocks, one layer, the multi-component transform; in a file that is built only where the library is.
[[nodiscard]] CodedPicture code_with_openjpeg(const Image& image, wavelet::Kernel kernel, std::size_t max_bytes);
/// Empty where this was built without it.
[[nodiscard]] Codec openjpeg();

struct CodecSide {
  std::size_t bytes = 0;
  double psnr = 0;
  std::vector<double> encode_seconds, decode_seconds;  ///< by round
};
struct TextureRow {
  wavelet::Kernel kernel;
  double rate;
  CodecSide ours, theirs;
};
struct TextureSceneResult {
  std::string name, title;
  int width = 0, height = 0;
  std::string skipped;  ///< why there is no rival
  std::vector<TextureRow> rows;
  std::vector<Figure> figures;
};

/// The rival first; ours gets the bytes which it took, or those of the rate where they are fewer. `rival` may be empty.
[[nodiscard]] TextureSceneResult measure_textures(const TextureScene& scene, const Image& image, const Codec& rival, int rounds);

[[nodiscard]] nlohmann::ordered_json texture_document(const std::vector<TextureSceneResult>& results);
[[nodiscard]] std::string texture_tables(const nlohmann::ordered_json& scenes);

/// Texel (i, j) of the result at source coordinates ((i + ½)·w/width, (j + ½)·h/height), bilinear, clamped, rounded half up; bytes of 1 to 4
/// channels, of which the first three are kept.
[[nodiscard]] Image resampled(const Image& image, int width, int height);
/// The window's columns and all rows.
[[nodiscard]] Image columns(const Image& image, int first, int count);

}  // namespace etalon::bench
