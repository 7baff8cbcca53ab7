#include "cli/diff_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "cli/usage_error.h"
#include "validation/metrics/pixel_comparison.h"

namespace etalon::cli {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  constexpr std::array kExtensions{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr"};
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// A texture that render --write-draws wrote beside STEM.draws: STEM.0.png, STEM.1.exr, …
bool is_texture_of_draws(const fs::path& path) {
  const fs::path stem = path.stem();
  const std::string number = stem.extension().string();
  if (number.size() < 2 || number.find_first_not_of("0123456789", 1) != std::string::npos) return false;
  std::error_code ignored;
  return fs::exists(path.parent_path() / stem.stem().concat(".draws"), ignored);
}

std::map<std::string, std::string> pictures_below(const std::string& folder) {
  std::map<std::string, std::string> found;
  std::error_code error;
  // Folders behind links too: what is not looked at would pass.
  constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
  for (fs::recursive_directory_iterator at(folder, kFollow, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->is_regular_file(ignored) && is_picture(at->path()) && !is_texture_of_draws(at->path()))
      found.emplace(at->path().lexically_relative(folder).generic_string(), at->path().string());
  }
  if (error) throw InputError(fmt::format("{}: {}", folder, error.message()));
  return found;
}

// A golden without a candidate takes the one of the same name in another format: golden.exr and golden.png. Only where there is one of each.
void pair_by_stem(std::map<std::string, FilePair>& pairs) {
  std::map<std::string, std::array<std::vector<std::string>, 2>> single;
  for (const auto& [name, pair] : pairs)
    if (pair.golden.empty() || pair.candidate.empty())
      single[fs::path(name).replace_extension().generic_string()][pair.golden.empty() ? 1 : 0].push_back(name);
  for (const auto& [stem, names] : single) {
    if (names[0].size() != 1 || names[1].size() != 1) continue;
    pairs[names[0].front()].candidate = pairs[names[1].front()].candidate;
    pairs.erase(names[1].front());
  }
}

}  // namespace

std::vector<FilePair> file_pairs(const std::string& golden, const std::string& candidate) {
  std::error_code ignored;
  const bool folders = fs::is_directory(golden, ignored);
  if (folders != fs::is_directory(candidate, ignored)) {
    if (!fs::exists(golden, ignored)) throw InputError(golden + ": No such file or directory");
    if (!fs::exists(candidate, ignored)) throw InputError(candidate + ": No such file or directory");
    throw UsageError(fmt::format("expected two pictures or two folders, got {} and {}", golden, candidate));
  }
  if (!folders) return {{fs::path(candidate).filename().string(), golden, candidate}};
  std::map<std::string, FilePair> pairs;
  for (const auto& [name, path] : pictures_below(golden)) pairs[name] = {name, path, ""};
  for (const auto& [name, path] : pictures_below(candidate)) {
    pairs[name].name = name;
    pairs[name].candidate = path;
  }
  pair_by_stem(pairs);
  if (pairs.empty()) throw InputError(fmt::format("{}: expected pictures, got none, and none in {}", golden, candidate));
  std::vector<FilePair> result;
  for (auto& [name, pair] : pairs) result.push_back(std::move(pair));
  return result;
}

std::vector<std::string> with_two_dashes(const std::vector<std::string>& arguments) {
  constexpr std::array kNames{"-fail",         "-failrelative", "-failpercent", "-hardfail", "-allowfailures", "-warn",
                              "-warnrelative", "-warnpercent",  "-hardwarn",    "-od",       "-abs",           "-scale"};
  std::vector<std::string> result = arguments;
  if (result.empty() || result.front() != "diff") return result;
  for (std::string& argument : result) {
    if (argument == "--") break;
    const std::string name = argument.substr(0, argument.find('='));
    if (std::find(kNames.begin(), kNames.end(), name) != kNames.end()) argument.insert(0, "-");
  }
  return result;
}

Image difference_image(const Image& golden, const Image& candidate, double scale, bool absolute, bool as_float) {
  const int channels = std::max(golden.format().channels, candidate.format().channels);
  const int stored = !as_float && channels == 2 ? 3 : channels;  // a PNG has no two channels of colour
  Image image(golden.width(), golden.height(), {as_float ? ChannelType::float32 : ChannelType::unorm8, stored});
  std::vector<double> a(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(stored)), b(a.size());
  for (int y = 0; y < image.height(); ++y) {
    validation::row_values(golden, y, stored, a.data());
    validation::row_values(candidate, y, stored, b.data());
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double difference = (b[i] - a[i]) * scale;
      const double value = absolute ? std::abs(difference) : difference;
      if (as_float)
        image.channels<float>(0, y)[i] = static_cast<float>(value);
      else
        image.channels<std::uint8_t>(0, y)[i] = static_cast<std::uint8_t>(value > 0 ? std::min(255.0, std::floor(value * 255 + 0.5)) : 0);
    }
  }
  return image;
}

}  // namespace etalon::cli
