#include "validation/diff/pair_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>

#include "core/base/error.h"
#include "core/io/draws_file.h"
#include "validation/diff/defect_patterns.h"
#include "validation/diff/picture.h"
#include "validation/diff/worst_unexplained.h"
#include "validation/probe/probe_document.h"
#include "validation/report/json_report.h"
#include "validation/verify/draw_list_hash.h"
#include "validation/verify/drawn_pair.h"
#include "validation/verify/pictures.h"
#include "validation/verify/verify_case.h"

namespace etalon::validation {
namespace {

namespace fs = std::filesystem;

// Two images of one format, for what needs that: floats of the values where the formats differ.
std::pair<Image, Image> in_one_format(const Image& a, const Image& b) {
  if (a.format() == b.format()) return {a, b};
  const int channels = std::max(a.format().channels, b.format().channels);
  std::vector<double> row(static_cast<std::size_t>(a.width()) * static_cast<std::size_t>(channels));
  const auto as_float = [&](const Image& image) {
    Image result(image.width(), image.height(), {ChannelType::float32, channels});
    for (int y = 0; y < image.height(); ++y) {
      row_values(image, y, channels, row.data());
      std::transform(row.begin(), row.end(), result.channels<float>(0, y), [](double value) { return static_cast<float>(value); });
    }
    return result;
  };
  return {as_float(a), as_float(b)};
}

// The draws that the golden was made from, where they are to be had.
std::optional<io::DrawsFile> find_draws(const Picture& golden, const PairOptions& options, PairResult& result) {
  const fs::path picture(golden.path);
  const auto attribute = [&](const char* key) {
    const auto found = golden.attributes.find(key);
    return found == golden.attributes.end() ? std::string() : found->second;
  };
  fs::path path = options.draws_path;
  const bool named = path.empty() && !attribute("drawsFile").empty();
  if (named) path = picture.parent_path() / fs::path(attribute("drawsFile")).filename();
  if (path.empty()) path = fs::path(picture).replace_extension(".draws");
  if (options.draws_path.empty() && !fs::exists(path)) {
    if (named) result.note = fmt::format("{}: named by the golden, not found", path.string());
    return std::nullopt;
  }
  io::DrawsFile draws = io::read_draws(path);
  const std::string expected = attribute("drawListSha256"), got = draw_list_sha256(draws.list);
  if (!expected.empty() && expected != got)
    throw InputError(fmt::format("{}: expected the draw list {} that {} was made from, got {}", path.string(), expected, golden.path, got));
  result.draws_path = path.string();
  return draws;
}

void require_fill_rule(const io::DrawsFile& draws, const DiffDevice& device, const std::string& path) {
  if (device.fill_rule && *device.fill_rule != draws.frame.state.fill_rule)
    throw InputError(fmt::format("{}: {} fills edges by {}: expected state.fill_rule to be that, got {}; draw the golden of draws with it",
                                 path, device.model.name, to_string(*device.fill_rule), to_string(draws.frame.state.fill_rule)));
}

void require_on_grid(const io::DrawsFile& draws, const DiffDevice& device, const std::string& path) {
  const int bits = draws.frame.state.subtexel_bits;
  if (device.subtexel_bits == 0 || bits <= device.subtexel_bits) return;
  const std::int32_t step = 1 << (bits - device.subtexel_bits);
  for (std::size_t n = 0; n < draws.list.vertices.size(); ++n) {
    const RasterVertex& v = draws.list.vertices[n];
    if (v.x % step != 0 || v.y % step != 0)
      throw InputError(fmt::format(
          "{}: vertex {}: {} has {} sub-texel bits: expected multiples of {} sub-texels, got ({}, {}); draw the golden with --snap-bits {}",
          path, n, device.model.name, device.subtexel_bits, step, v.x, v.y, device.subtexel_bits));
  }
}

Image as_srgb(Image image) {
  Image curved(image.width(), image.height(), {ChannelType::srgb8, image.format().channels});
  std::copy(image.bytes().begin(), image.bytes().end(), curved.bytes().begin());
  return curved;
}

TargetSpec color_target(const io::DrawsFile& draws, PixelFormat format) {
  TargetSpec target{.content = TargetContent::color, .format = format, .clear = {0, 0, 0, 0}};
  for (const TargetSpec& spec : draws.frame.targets) {
    if (spec.content != TargetContent::color) continue;
    target.clear = spec.clear;
    if (spec.format.type == ChannelType::srgb8 && format.type == ChannelType::unorm8) target.format.type = ChannelType::srgb8;
  }
  return target;
}

Image in_target_format(const Image& image, const TargetSpec& target) {
  return target.format.type == ChannelType::srgb8 && image.format().type == ChannelType::unorm8 ? as_srgb(image) : image;
}

// The golden must be what its draws give: else nothing follows from them.
void require_golden_of_draws(const Picture& golden, const io::DrawsFile& draws, Renderer& exact, const std::string& draws_path) {
  Frame frame = draws.frame;
  if (frame.width != golden.color.width() || frame.height != golden.color.height())
    throw InputError(fmt::format("{}: expected the {}x{} of {}, got {}x{}", golden.path, frame.width, frame.height, draws_path,
                                 golden.color.width(), golden.color.height()));
  frame.targets = {color_target(draws, golden.color.format())};
  const Image drawn = exact.render(draws.list, frame).front(), given = in_target_format(golden.color, frame.targets.front());
  const std::size_t differing = differing_texels(drawn, given);
  if (differing == 0) return;
  const ImageDifference d = measure_difference(drawn, given);
  throw InputError(fmt::format("{}: expected the picture that {} gives, got {} texels that differ, the largest first at ({}, {})",
                               golden.path, draws_path, differing, d.total.max_x, d.total.max_y));
}

// Classes by the draws. Returns the class image; the golden becomes what its draws give in the candidate's format.
Image classify_by_draws(PairResult& result, Picture& golden, const Picture& candidate, const io::DrawsFile& draws, Renderer& exact,
                        const PairOptions& options) {
  require_fill_rule(draws, *options.device, result.draws_path);
  require_on_grid(draws, *options.device, result.draws_path);
  require_golden_of_draws(golden, draws, exact, result.draws_path);
  Frame frame = draws.frame;
  frame.state.half_rounding = options.device->half_rounding.value_or(frame.state.half_rounding);
  frame.targets = {color_target(draws, candidate.color.format())};
  DrawnPair pair;
  pair.gl.push_back(in_target_format(candidate.color, frame.targets.front()));
  if (!candidate.ids.empty()) frame.targets.push_back({TargetContent::triangle_id, kR32ui, {}}), pair.gl.push_back(candidate.ids);
  if (!candidate.depth.empty()) frame.targets.push_back({TargetContent::depth, kR32f, {}}), pair.gl.push_back(candidate.depth);
  pair.cpu = exact.render(draws.list, frame);
  picture_targets(pair, frame);
  VerifyOptions asked;
  asked.worst_count = options.worst_count;
  asked.picture_px = std::max(options.picture_px, 1);
  const DeviceModel& model = options.device->model;
  const DiffResult diff =
      classify_case(result.page, pair, draws.list, frame, model, asked, options.picture_px > 0 ? mark_reach(frame, options.picture_px) : 0);
  result.bounds_proven = model.origin == BoundOrigin::exact || model.origin == BoundOrigin::derived;
  if (options.texel) result.texel = explain_texel(draws.list, frame, model, pair.cpu, pair.gl, options.texel->x, options.texel->y).sentence;
  if (!diff.agreed()) {
    // A mistake that explains nearly all of them says more than the place does.
    if (result.page.causes.empty() || result.page.causes.front().share < 0.9)
      result.patterns = defect_patterns(draws.list, draws.frame, diff.class_image, pair.cpu.front(), pair.gl.front(), exact);
    for (const std::string& pattern : result.patterns) result.page.diagnosis += " Pattern: " + pattern + ".";
    DiffResult shown = diff;
    shown.worst = worst_unexplained(diff, pair, draws.list, frame, model, options.worst_count);
    result.page.worst = worst_texels(shown, pair, frame.targets, options.worst_count);
  }
  golden.color = std::move(pair.cpu.front());
  return diff.class_image;
}

// One step of what the image stores, as a number.
double storage_step(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
    case ChannelType::srgb8: return 1.0 / 255;
    case ChannelType::unorm16: return 1.0 / 65535;
    case ChannelType::half: return 0x1p-10;
    default: return 0x1p-23;
  }
}

// NaN equals NaN, and infinity infinity of its sign; neither is near anything else.
bool within(double a, double b, double limit) {
  if (!std::isfinite(a) || !std::isfinite(b)) return a == b || (std::isnan(a) && std::isnan(b));
  return std::abs(a - b) <= limit * std::max(1.0, std::abs(b));
}

// Classes by the pictures alone: what is within one step of the golden's value there, or of one of the eight around it, may be a legal
// rounding or a tie. Nothing more can be said: "tie?".
Image classify_by_image(PairResult& result, const Image& golden, const Image& candidate) {
  const int width = golden.width(), height = golden.height();
  const int channels = std::max(golden.format().channels, candidate.format().channels);
  const double step = std::max(storage_step(golden.format().type), storage_step(candidate.format().type)) * (1 + 0x1p-20);
  const auto row_size = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  std::vector<double> around[3], own(row_size);
  for (auto& row : around) row.resize(row_size);
  Image classes(width, height, {ChannelType::unorm8, 1});
  for (int y = 0; y < height; ++y) {
    for (int k = 0; k < 3; ++k) row_values(golden, std::clamp(y + k - 1, 0, height - 1), channels, around[k].data());
    row_values(candidate, y, channels, own.data());
    for (int x = 0; x < width; ++x) {
      const double* value = own.data() + static_cast<std::ptrdiff_t>(x) * channels;
      const auto near = [&](int k, int nx, double limit) {
        const double* other = around[k].data() + static_cast<std::ptrdiff_t>(std::clamp(nx, 0, width - 1)) * channels;
        for (int c = 0; c < channels; ++c)
          if (!within(value[c], other[c], limit)) return false;
        return true;
      };
      TexelClass texel_class = TexelClass::unexplained;
      if (near(1, x, 0)) {
        texel_class = TexelClass::identical;
      } else {
        for (int k = 0; k < 3; ++k)
          for (int dx = -1; dx <= 1; ++dx)
            if (near(k, x + dx, step)) texel_class = TexelClass::tie;
      }
      ++result.page.tally.texels;
      result.page.tally.identical += texel_class == TexelClass::identical ? 1 : 0;
      result.page.tally.unexplained += texel_class == TexelClass::unexplained ? 1 : 0;
      result.unproven_ties += texel_class == TexelClass::tie ? 1 : 0;
      *classes.channels<std::uint8_t>(x, y) = static_cast<std::uint8_t>(texel_class);
    }
  }
  return classes;
}

// The golden where a texel is explained, the candidate elsewhere: what the thresholds are asked about.
PixelComparison unexplained_pixels(const Image& golden, const Image& candidate, const Image& classes, const PixelThresholds& thresholds) {
  const auto [a, b] = in_one_format(golden, candidate);
  Image masked = a;
  const auto size = static_cast<std::size_t>(bytes_per_texel(a.format()));
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      if (*classes.channels<std::uint8_t>(x, y) == static_cast<std::uint8_t>(TexelClass::unexplained))
        std::memcpy(masked.texel(x, y), b.texel(x, y), size);
  return compare_pixels(a, masked, thresholds);
}

std::string difference_sentence(const Picture& golden, const Picture& candidate, const TexelPlace& at) {
  if (at.x >= golden.color.width() || at.y >= golden.color.height())
    throw InputError(
        fmt::format("texel ({}, {}) is outside the pictures of {}x{}", at.x, at.y, golden.color.width(), golden.color.height()));
  const std::string a = texel_text(golden.color, at.x, at.y), b = texel_text(candidate.color, at.x, at.y);
  return fmt::format("texel ({}, {}): golden {} ({}), candidate {} ({})", at.x, at.y, a, to_string(golden.color.format()), b,
                     to_string(candidate.color.format()));
}

void add_pictures(PairResult& result, const Picture& golden, const Picture& candidate, const Image& classes, int picture_px) {
  DrawnPair pair;
  auto [a, b] = in_one_format(golden.color, candidate.color);
  Frame frame;
  frame.width = a.width(), frame.height = a.height();
  frame.targets = {{TargetContent::color, a.format(), {}}};
  pair.cpu.push_back(std::move(a)), pair.gl.push_back(std::move(b));
  picture_targets(pair, frame);
  const int reach = mark_reach(frame, picture_px);
  result.page.targets = {measure_target(pair, 0, frame.targets.front(), picture_px, reach)};
  if (!classes.empty()) result.page.class_picture = reduced(class_picture(pair.cpu_picture.front(), classes, reach), picture_px);
}

PairVerdict verdict_of(const PixelComparison& pixels) {
  switch (pixels.verdict) {
    case PixelVerdict::pass: return PairVerdict::pass;
    case PixelVerdict::warning: return PairVerdict::warning;
    case PixelVerdict::failure: return PairVerdict::failure;
  }
  return PairVerdict::failure;
}

// Channels of OpenEXR beside the colours that both files have, by the same thresholds.
void compare_others(PairResult& result, const Picture& golden, const Picture& candidate, const PixelThresholds& thresholds) {
  for (const auto& [name, image] : golden.others) {
    const auto other = candidate.others.find(name);
    if (other == candidate.others.end()) continue;
    const PixelComparison pixels = compare_pixels(image, other->second, thresholds);
    if (pixels.differing == 0) continue;
    result.verdict = std::max(result.verdict, verdict_of(pixels));
    result.note += fmt::format("{}channel {}: {} of {} values differ, by at most {:.6g}", result.note.empty() ? "" : "; ", name,
                               grouped(pixels.differing), grouped(pixels.pixels), pixels.max_error);
  }
}

void compare(PairResult& result, Renderer& exact, const PairOptions& options) {
  auto [golden, candidate] = read_pictures(result.golden_path, result.candidate_path);
  result.golden_sha256 = golden.sha256, result.candidate_sha256 = candidate.sha256;
  const Image &a = golden.color, &b = candidate.color;
  result.page.width = a.width(), result.page.height = a.height();
  if (a.width() != b.width() || a.height() != b.height()) {
    result.status = PairStatus::sizes_differ, result.verdict = PairVerdict::sizes_differ;
    result.problem = fmt::format("sizes differ: golden {}x{}, candidate {}x{}", a.width(), a.height(), b.width(), b.height());
    return;
  }
  result.pixels = compare_pixels(a, b, options.thresholds);
  result.verdict = verdict_of(result.pixels);
  if (!options.device) compare_others(result, golden, candidate, options.thresholds);
  Image classes;
  if (options.device) {
    const std::optional<io::DrawsFile> draws = find_draws(golden, options, result);
    result.device = options.device->model.name;
    result.bound_origin = to_string(options.device->model.origin);
    if (result.note.empty()) result.note = options.device->caveat;
    result.bounds = fmt::format("{}: {}", to_string(options.device->model.origin), options.device->model.valid_for);
    classes = draws ? classify_by_draws(result, golden, candidate, *draws, exact, options) : classify_by_image(result, a, b);
    if (draws) result.pixels = compare_pixels(a, b, options.thresholds);
    const PixelComparison unexplained = unexplained_pixels(a, b, classes, options.thresholds);
    // Texels whose colours agree and whose ids or depths do not have no size that a threshold could be asked about.
    result.verdict = result.page.tally.unexplained > unexplained.differing ? PairVerdict::failure : verdict_of(unexplained);
    if (result.verdict == PairVerdict::pass && result.unproven_ties > 0) result.verdict = PairVerdict::warning;
  }
  if (options.texel && result.texel.empty()) result.texel = difference_sentence(golden, candidate, *options.texel);
  if (options.picture_px > 0) add_pictures(result, golden, candidate, classes, options.picture_px);
}

void name_page(PairResult& result) {
  result.page.job = "diff";
  result.page.model = result.name;
  result.page.view = result.device.empty() ? "by thresholds" : "device " + result.device;
  result.page.sampling = to_string(result.verdict);
  result.page.description = result.problem;
  result.page.sides = {"golden", "candidate", "the golden picture", "the candidate", "golden", "candidate"};
  if (result.status != PairStatus::compared) result.page.skipped = result.problem;
}

}  // namespace

PairResult diff_pair(const std::string& name, const std::string& golden_path, const std::string& candidate_path, Renderer& exact,
                     const PairOptions& options) {
  PairResult result;
  result.name = name;
  result.golden_path = golden_path, result.candidate_path = candidate_path;
  try {
    compare(result, exact, options);
  } catch (const InputError& error) {
    result.status = PairStatus::unreadable, result.verdict = PairVerdict::bad_input;
    result.problem = error.what();
  }
  name_page(result);
  return result;
}

PairResult missing_pair(const std::string& name, PairStatus status) {
  PairResult result;
  result.name = name;
  result.status = status;
  result.verdict = PairVerdict::failure;
  result.problem = status == PairStatus::only_golden ? "the candidate is missing" : "there is no golden picture of it";
  name_page(result);
  return result;
}

PairVerdict worst_verdict(const std::vector<PairResult>& pairs) {
  PairVerdict worst = PairVerdict::pass;
  for (const PairResult& pair : pairs) worst = std::max(worst, pair.verdict);
  return worst;
}

DiffDevice device_of_name(const std::string& name) {
  if (name == "contract") return {contract_model(), 0};
  if (name == "llvmpipe") return {llvmpipe_model(), 8};
  if (name == "gl") {
    // 1e-5 = 168 · 2^-24.
    return {specified_model("gl", 168, 0, "OpenGL 4.6 core, 2.3.4.1: operations are accurate to about 1 part in 10^5; SUBPIXEL_BITS >= 4"),
            4};
  }
  if (name == "d3d11") {
    DiffDevice device{
        .model = specified_model("d3d11", 2, 8,
                                 "Direct3D 11.3 functional specification, 3.1.3: within 1 ULP; 3.2.2: halves toward zero; "
                                 "3.2.3.6: unorm within 0.6 steps; 3.2.4, 7.18.8: 8 bits of texel fraction; 3.4.1: 8 bits of position"),
        .subtexel_bits = 8,
        .half_rounding = HalfRounding::toward_zero};
    device.model.unorm_error_steps = 0.1;
    return device;
  }
  if (name.starts_with("vulkan:")) {
    const auto number = [](const std::string& text) {
      const bool digits = !text.empty() && text.size() <= 2 && text.find_first_not_of("0123456789") == std::string::npos;
      return digits ? std::stoi(text) : 0;
    };
    const std::size_t colon = name.find(':', 7);
    const int bits = number(name.substr(7, colon - 7)), texel_bits = colon == std::string::npos ? 4 : number(name.substr(colon + 1));
    if (bits >= 4 && bits <= 16 && texel_bits >= 4 && texel_bits <= 24)
      return {specified_model(
                  name, 5, texel_bits,
                  fmt::format("Vulkan 1.3, Precision of Individual Operations: within 2.5 ULP; Required Limits: subPixelPrecisionBits {}, "
                              "subTexelPrecisionBits {}",
                              bits, texel_bits)),
              bits};
  }
  throw InputError(
      fmt::format("expected contract, llvmpipe, gl, d3d11 or vulkan:BITS[:TEXELBITS] (4 to 16 sub-texel bits; 4 to 24 of texture "
                  "coordinates), got '{}'",
                  name));
}

DiffDevice device_of_probe(const std::string& path) {
  const ProbeRecord record = read_probe(path);
  const ProbeFindings& found = record.findings;
  DiffDevice device{.model = model_of_findings(found, record.device.name, record.day)};
  // A grid of 16 bits is one that was too fine to be seen.
  const int bits = found.coverage.subtexel_bits.value_or(found.coverage.nearest_bits);
  device.subtexel_bits = bits == 16 ? 0 : bits;
  device.fill_rule = found.coverage.fill_rule;
  device.half_rounding = found.storage.half;
  if (!found.coverage.fill_rule)
    device.caveat = fmt::format("{} covers texels by no one fill rule: differences of coverage are unexplained", record.device.name);
  return device;
}

std::string to_string(PairStatus status) {
  switch (status) {
    case PairStatus::compared: return "compared";
    case PairStatus::sizes_differ: return "sizes_differ";
    case PairStatus::only_golden: return "only_golden";
    case PairStatus::only_candidate: return "only_candidate";
    case PairStatus::unreadable: return "unreadable";
  }
  return "?";
}

std::string to_string(PairVerdict verdict) {
  switch (verdict) {
    case PairVerdict::pass: return "pass";
    case PairVerdict::warning: return "warning";
    case PairVerdict::failure: return "failure";
    case PairVerdict::sizes_differ: return "sizes_differ";
    case PairVerdict::bad_input: return "bad_input";
  }
  return "?";
}

}  // namespace etalon::validation
