#include "validation/verify/drawn_pair.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "validation/verify/pictures.h"

namespace etalon::validation {
namespace {

std::string channel_text(const Image& image, int x, int y, int c) {
  switch (image.format().type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return std::to_string(image.channels<std::uint8_t>(x, y)[c]);
    case ChannelType::unorm16: return std::to_string(image.channels<std::uint16_t>(x, y)[c]);
    case ChannelType::half: return fmt::format("{}", half_value(image.channels<std::uint16_t>(x, y)[c]));
    case ChannelType::float32: return fmt::format("{}", image.channels<float>(x, y)[c]);
    case ChannelType::uint32: {
      const std::uint32_t id = image.channels<std::uint32_t>(x, y)[c];
      return id == kNoTriangle ? "-" : std::to_string(id);
    }
  }
  return "";
}

std::string short_name(TargetContent content) { return content == TargetContent::triangle_id ? "id" : to_string(content); }

// "texel (3, 4): triangle 7, …" → "Triangle 7, …": the place is shown apart.
std::string without_place(const std::string& sentence) {
  const std::size_t colon = sentence.rfind("texel (", 0) == 0 ? sentence.find("): ") : std::string::npos;
  std::string text = colon == std::string::npos ? sentence : sentence.substr(colon + 3);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

bool same_bytes(const DrawnPair& pair, std::size_t target, int x, int y) {
  const std::size_t size = static_cast<std::size_t>(bytes_per_texel(pair.cpu[target].format()));
  return std::memcmp(pair.cpu[target].texel(x, y), pair.gl[target].texel(x, y), size) == 0;
}

std::size_t first_differing_target(const DrawnPair& pair, int x, int y) {
  for (std::size_t t = 0; t < pair.cpu.size(); ++t) {
    if (!same_bytes(pair, t, x, y)) return t;
  }
  return 0;
}

// The targets in which the two sides differ at a texel, with the values of one side.
std::string side_text(const DrawnPair& pair, const std::vector<Image>& side, const std::vector<TargetSpec>& targets, int x, int y) {
  std::string text;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (same_bytes(pair, t, x, y)) continue;
    // Where there is one target, whose value it is goes without saying.
    const std::string name = targets.size() == 1 ? "" : short_name(targets[t].content) + std::string(" ");
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", name, texel_text(side[t], x, y));
  }
  return text;
}

WorstTexel worst_texel(const TexelReport& report, const DrawnPair& pair, const std::vector<TargetSpec>& targets) {
  WorstTexel worst;
  worst.x = report.x;
  worst.y = report.y;
  worst.texel_class = to_string(report.verdict.texel_class);
  worst.cpu_value = side_text(pair, pair.cpu, targets, report.x, report.y);
  worst.gl_value = side_text(pair, pair.gl, targets, report.x, report.y);
  worst.explanation = without_place(report.sentence);
  const std::size_t shown = first_differing_target(pair, report.x, report.y);
  worst.cpu_crop = crop(pair.cpu_picture[shown], report.x, report.y, kCropSize);
  worst.gl_crop = crop(pair.gl_picture[shown], report.x, report.y, kCropSize);
  return worst;
}

std::vector<const TexelReport*> shown_reports(const std::vector<TexelReport>& worst, int count) {
  std::vector<const TexelReport*> shown;
  std::array<int, kClassCount> taken{};
  for (const TexelReport& report : worst) {
    const TexelClass texel_class = report.verdict.texel_class;
    const int limit = texel_class == TexelClass::unexplained ? count : texel_class == TexelClass::rounding ? 1 : (count + 1) / 2;
    if (static_cast<int>(shown.size()) < count && taken[static_cast<std::size_t>(texel_class)]++ < limit) shown.push_back(&report);
  }
  return shown;
}

}  // namespace

ClassTally tally_of(const ClassCounts& counts) {
  ClassTally tally;
  tally.texels = counts.total();
  tally.identical = counts[TexelClass::identical];
  tally.rounding = counts[TexelClass::rounding];
  tally.tie = counts[TexelClass::tie];
  tally.unbounded = counts[TexelClass::unbounded];
  tally.unexplained = counts[TexelClass::unexplained];
  return tally;
}

std::string texel_text(const Image& image, int x, int y) {
  std::string text;
  for (int c = 0; c < image.format().channels; ++c) text += (c > 0 ? " " : "") + channel_text(image, x, y, c);
  return text;
}

void picture_targets(DrawnPair& pair, const Frame& frame) {
  for (std::size_t t = 0; t < frame.targets.size(); ++t) {
    const bool is_depth = frame.targets[t].content == TargetContent::depth;
    const ValueRange range = is_depth ? drawn_range(pair.cpu[t]) : ValueRange{};
    pair.cpu_picture.push_back(picture_of(pair.cpu[t], range.low, range.high));
    if (!pair.gl.empty()) pair.gl_picture.push_back(picture_of(pair.gl[t], range.low, range.high));
  }
}

TargetResult measure_target(const DrawnPair& pair, std::size_t t, const TargetSpec& spec, int picture_px, int reach) {
  TargetResult target;
  target.content = to_string(spec.content);
  target.format = to_string(spec.format);
  target.cpu_sha256 = pair.cpu[t].sha256();
  target.cpu_picture = reduced(pair.cpu_picture[t], picture_px);
  if (pair.gl.empty()) return target;
  target.gl_sha256 = pair.gl[t].sha256();
  target.difference = measure_difference(pair.cpu[t], pair.gl[t]);
  if (target.difference->identical) return target;
  target.gl_picture = reduced(pair.gl_picture[t], picture_px);
  target.error_picture = reduced(error_picture(pair.cpu[t], pair.gl[t], reach), picture_px);
  return target;
}

int mark_reach(const Frame& frame, int picture_px) {
  const int longest = std::max(frame.width, frame.height);
  return std::max({(longest + picture_px - 1) / picture_px, longest / 340, 1});
}

std::vector<WorstTexel> worst_texels(const DiffResult& diff, const DrawnPair& pair, const std::vector<TargetSpec>& targets, int count) {
  std::vector<WorstTexel> worst;
  for (const TexelReport* report : shown_reports(diff.worst, count)) worst.push_back(worst_texel(*report, pair, targets));
  return worst;
}

}  // namespace etalon::validation
