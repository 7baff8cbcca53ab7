#include "tests/bench/texture_bench.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/image_file.h"
#include "core/procedural/alps.h"
#include "core/procedural/head.h"
#include "core/wavelet/texture_stream.h"
#include "tests/bench/simplify_way.h"
#include "tests/bench/timing.h"
#include "tests/support/skip.h"
#include "validation/report/json_report.h"

namespace etalon::bench {
namespace {

using Json = nlohmann::ordered_json;
using wavelet::Kernel;

constexpr const char* kName[] = {"5/3", "9/7"};
const char* name_of(Kernel kernel) { return kName[static_cast<std::size_t>(kernel)]; }

double psnr_db(const Image& a, const Image& b) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.bytes().size(); ++i) {
    const int d = std::to_integer<int>(a.bytes()[i]) - std::to_integer<int>(b.bytes()[i]);
    sum += static_cast<std::uint64_t>(d * d);
  }
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.bytes().size()) / static_cast<double>(std::max<std::uint64_t>(sum, 1)));
}

void add_round(CodecSide& side, const CodedPicture& coded, const Image& image) {
  side.bytes = coded.stream.size();
  side.psnr = psnr_db(coded.picture, image);
  side.encode_seconds.push_back(coded.encode_seconds);
  side.decode_seconds.push_back(coded.decode_seconds);
}

void add_figures(TextureSceneResult& result) {
  for (const Kernel kernel : {Kernel::reversible_5_3, Kernel::irreversible_9_7}) {
    Figure behind{.title = fmt::format("PSNR, {}: OpenJPEG − ours, worst of five rates, dB", name_of(kernel)),
                  .goal = kMostPsnrBehind_db,
                  .sense = Sense::at_most,
                  .skipped = result.skipped};
    if (result.skipped.empty()) {
      double worst = -1e9;
      for (const TextureRow& row : result.rows)
        if (row.kernel == kernel) worst = std::max(worst, row.theirs.psnr - row.ours.psnr);
      behind.values = {worst};
    }
    result.figures.push_back(behind);
  }
}

Json side_json(const CodecSide& side) {
  return {{"bytes", side.bytes},
          {"psnr_db", side.psnr},
          {"encode_seconds", median(side.encode_seconds)},
          {"decode_seconds", median(side.decode_seconds)}};
}

std::optional<Image> davosdorf() {
  const auto file = test::data_file("davosdorf/davosdorf_color.tif");
  if (!file) return std::nullopt;
  return resampled(columns(io::read_image(*file), 32, 495), 512, 512);
}

}  // namespace

std::vector<TextureScene> texture_scenes() {
  return {{.name = "texture-davosdorf", .title = "orthophoto of Davos Dorf, 512²", .make = davosdorf},
          {.name = "texture-alps",
           .title = "orthophoto of `make terrain`, 1024²",
           .make = [] { return std::optional(procedural::make_alps().texture); }},
          {.name = "texture-head", .title = "texture of `make head`, 1024²", .make = [] {
             return std::optional(procedural::make_head().texture);
           }}};
}

CodedPicture code_with_ours(const Image& image, Kernel kernel, std::size_t max_bytes) {
  CodedPicture coded;
  double start = process_cpu_seconds();
  coded.stream = wavelet::encode_texture(image, {.kernel = kernel, .max_bytes = max_bytes}).bytes;
  coded.encode_seconds = process_cpu_seconds() - start;
  start = process_cpu_seconds();
  coded.picture = wavelet::decode_texture(coded.stream).image;
  coded.decode_seconds = process_cpu_seconds() - start;
  return coded;
}

Codec openjpeg() {
#ifdef ETALON_HAS_OPENJPEG
  return code_with_openjpeg;
#else
  return {};
#endif
}

TextureSceneResult measure_textures(const TextureScene& scene, const Image& image, const Codec& rival, int rounds) {
  TextureSceneResult result{.name = scene.name, .title = scene.title, .width = image.width(), .height = image.height()};
  if (!rival) result.skipped = "built without libopenjp2-7-dev";
  const int threads = thread_count();
  set_thread_count(1);
  for (const Kernel kernel : {Kernel::reversible_5_3, Kernel::irreversible_9_7}) {
    for (const double rate : kTextureRates) {
      TextureRow row{.kernel = kernel, .rate = rate, .ours = {}, .theirs = {}};
      for (int round = 0; round < rounds; ++round) {
        auto budget = static_cast<std::size_t>(rate * static_cast<double>(image.texel_count()) / 8);
        if (rival) {
          const CodedPicture theirs = rival(image, kernel, budget);
          add_round(row.theirs, theirs, image);
          budget = std::min(budget, theirs.stream.size());
        }
        add_round(row.ours, code_with_ours(image, kernel, budget), image);
      }
      result.rows.push_back(std::move(row));
    }
  }
  set_thread_count(threads);
  add_figures(result);
  return result;
}

Json texture_document(const std::vector<TextureSceneResult>& results) {
  Json scenes = Json::array();
  for (const TextureSceneResult& result : results) {
    Json scene{{"name", result.name}, {"title", result.title}, {"width", result.width}, {"height", result.height}};
    if (!result.skipped.empty()) scene["skipped"] = result.skipped;
    scene["rows"] = Json::array();
    for (const TextureRow& row : result.rows) {
      Json json{{"kernel", name_of(row.kernel)}, {"bits_per_texel", row.rate}, {"ours", side_json(row.ours)}};
      if (result.skipped.empty()) {
        json["openjpeg"] = side_json(row.theirs);
        json["encode_ratio"] = median(ratios(row.theirs.encode_seconds, row.ours.encode_seconds));
        json["decode_ratio"] = median(ratios(row.theirs.decode_seconds, row.ours.decode_seconds));
      }
      scene["rows"].push_back(json);
    }
    scene["figures"] = Json::array();
    for (const Figure& figure : result.figures) scene["figures"].push_back(figure_json(figure));
    scenes.push_back(scene);
  }
  return scenes;
}

std::string texture_tables(const Json& scenes) {
  std::string text;
  for (const Json& scene : scenes) {
    text += fmt::format(
        "**Texture streams: {}** (`{}`), {} × {}, one thread\n\n"
        "| kernel | bits per texel | bytes, ours | PSNR, dB | bytes, OpenJPEG | PSNR, dB | ours − OpenJPEG | encoding: OpenJPEG ÷ ours | "
        "decoding |\n"
        "|---|---|---|---|---|---|---|---|---|\n",
        scene.at("title").get<std::string>(), scene.at("name").get<std::string>(), scene.at("width").get<int>(),
        scene.at("height").get<int>());
    for (const Json& row : scene.at("rows")) {
      const Json& ours = row.at("ours");
      text += fmt::format("| {} | {} | {} | {:.2f} |", row.at("kernel").get<std::string>(), row.at("bits_per_texel").get<double>(),
                          validation::grouped(ours.at("bytes").get<std::uint64_t>()), ours.at("psnr_db").get<double>());
      if (!row.contains("openjpeg")) {
        text += fmt::format(" skipped: {} | | | | |\n", scene.at("skipped").get<std::string>());
        continue;
      }
      const Json& theirs = row.at("openjpeg");
      text += fmt::format(" {} | {:.2f} | {:+.2f} | {:.2f} | {:.2f} |\n", validation::grouped(theirs.at("bytes").get<std::uint64_t>()),
                          theirs.at("psnr_db").get<double>(), ours.at("psnr_db").get<double>() - theirs.at("psnr_db").get<double>(),
                          row.at("encode_ratio").get<double>(), row.at("decode_ratio").get<double>());
    }
    text += "\n" + figure_table(scene.at("figures")) + "\n";
  }
  return text;
}

Image columns(const Image& image, int first, int count) {
  Image window(count, image.height(), image.format());
  const auto texel_bytes = static_cast<std::size_t>(bytes_per_texel(image.format()));
  for (int y = 0; y < image.height(); ++y)
    std::copy_n(image.texel(first, y), static_cast<std::size_t>(count) * texel_bytes, window.texel(0, y));
  return window;
}

Image resampled(const Image& image, int width, int height) {
  const int channels = std::min(image.format().channels, 3);
  Image result(width, height, {ChannelType::unorm8, channels});
  struct Tap {
    int first, second;
    double share;
  };
  const auto taps = [](int i, int size, int from) {
    const double at = std::clamp((i + 0.5) * from / size - 0.5, 0.0, from - 1.0);
    const int first = static_cast<int>(at);
    return Tap{first, std::min(first + 1, from - 1), at - first};
  };
  for (int y = 0; y < height; ++y) {
    const Tap v = taps(y, height, image.height());
    for (int x = 0; x < width; ++x) {
      const Tap u = taps(x, width, image.width());
      for (int c = 0; c < channels; ++c) {
        const auto value = [&](int i, int j) { return static_cast<double>(image.channels<std::uint8_t>(i, j)[c]); };
        const double low = (1 - u.share) * value(u.first, v.first) + u.share * value(u.second, v.first);
        const double high = (1 - u.share) * value(u.first, v.second) + u.share * value(u.second, v.second);
        result.channels<std::uint8_t>(x, y)[c] = static_cast<std::uint8_t>((1 - v.share) * low + v.share * high + 0.5);
      }
    }
  }
  return result;
}

}  // namespace etalon::bench
