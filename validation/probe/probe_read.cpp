// Reading PROBE.json: every member is there, of its type and in its range, or the file is refused by the member's name.
#include <array>
#include <cmath>
#include <initializer_list>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/inputs.h"
#include "core/io/json_ref.h"
#include "validation/probe/probe_document.h"

namespace etalon::validation {
namespace {

using io::JsonRef;

double real_in(const JsonRef& ref, double low, double high) {
  const double value = ref.real();
  if (!(value >= low && value <= high)) ref.fail(fmt::format("expected a number from {:g} to {:g}, got {:g}", low, high, value));
  return value;
}

int integer_in(const JsonRef& ref, int low, int high) {
  const std::uint64_t value = ref.integer();
  if (value < static_cast<std::uint64_t>(low) || value > static_cast<std::uint64_t>(high))
    ref.fail(fmt::format("expected an integer from {} to {}, got {}", low, high, value));
  return static_cast<int>(value);
}

// A relative error beyond this is none of an arithmetic's.
double error_of(const JsonRef& ref) {
  if (ref.is_null()) ref.fail("expected a finite error, got none: the device gave NaN, from which no bound follows");
  return real_in(ref, 0, 1e6);
}

template <class T, std::size_t N>
T named(const JsonRef& ref, const std::array<T, N>& values) {
  const std::string name = ref.text();
  std::string expected;
  for (const T value : values) {
    if (to_string(value) == name) return value;
    expected += (expected.empty() ? "" : ", ") + to_string(value);
  }
  ref.fail(fmt::format("expected one of {}, got '{}'", expected, name));
}

constexpr std::array kRoundings{SnapRounding::nearest_even, SnapRounding::half_up, SnapRounding::half_away, SnapRounding::toward_zero,
                                SnapRounding::floor};
constexpr std::array kRules{FillRule::left_ymin, FillRule::left_ymax, FillRule::right_ymin, FillRule::right_ymax};
constexpr std::array kHalves{HalfRounding::nearest_even, HalfRounding::toward_zero};

template <class Read>
auto optional_of(const JsonRef& ref, const Read& read) -> std::optional<decltype(read(ref))> {
  if (ref.is_null()) return std::nullopt;
  return read(ref);
}

CoverageFinding coverage_of(const JsonRef& ref) {
  ref.require_only({"triangles", "texels", "subtexel_bits", "snap", "fill_rule", "differing", "nearest"});
  const JsonRef nearest = ref.at("nearest");
  nearest.require_only({"subtexel_bits", "snap", "fill_rule"});
  const auto bits = [](const JsonRef& r) { return integer_in(r, 1, 16); };
  const auto snap = [](const JsonRef& r) { return named(r, kRoundings); };
  const auto rule = [](const JsonRef& r) { return named(r, kRules); };
  CoverageFinding found;
  found.triangles = ref.at("triangles").integer();
  found.texels = ref.at("texels").integer();
  found.subtexel_bits = optional_of(ref.at("subtexel_bits"), bits);
  found.snap = optional_of(ref.at("snap"), snap);
  found.fill_rule = optional_of(ref.at("fill_rule"), rule);
  found.differing = ref.at("differing").integer();
  found.nearest_bits = bits(nearest.at("subtexel_bits"));
  found.nearest_snap = snap(nearest.at("snap"));
  found.nearest_rule = rule(nearest.at("fill_rule"));
  return found;
}

InterpolationFinding interpolation_of(const JsonRef& ref) {
  ref.require_only({"samples", "unbounded", "affine", "perspective", "depth"});
  InterpolationFinding found;
  found.samples = ref.at("samples").integer();
  if (found.samples == 0) ref.at("samples").fail("expected at least 1 sample, got 0");
  found.unbounded = ref.at("unbounded").integer();
  found.affine = error_of(ref.at("affine"));
  found.perspective = error_of(ref.at("perspective"));
  found.depth = error_of(ref.at("depth"));
  return found;
}

NearestFinding nearest_of(const JsonRef& ref) {
  ref.require_only({"steps", "earliest_texel", "latest_texel", "fixed_bits"});
  NearestFinding found;
  found.steps = ref.at("steps").boolean();
  if (!found.steps) ref.at("steps").fail("expected true: where texels end was not measured");
  found.earliest_texel = real_in(ref.at("earliest_texel"), -1, 0);
  found.latest_texel = real_in(ref.at("latest_texel"), 0, 1);
  found.fixed_bits = optional_of(ref.at("fixed_bits"), [](const JsonRef& r) { return integer_in(r, 1, 24); });
  return found;
}

LinearFinding linear_of(const JsonRef& ref) {
  ref.require_only(
      {"weight_bits", "weights_rounded", "largest_weight_error", "levels_of_small_step", "largest_value_error", "value_error_over_model"});
  LinearFinding found;
  found.weight_bits = optional_of(ref.at("weight_bits"), [](const JsonRef& r) { return integer_in(r, 0, 16); });
  found.weights_rounded = ref.at("weights_rounded").boolean();
  found.largest_weight_error = error_of(ref.at("largest_weight_error"));
  found.levels_of_small_step = integer_in(ref.at("levels_of_small_step"), 0, 1 << 16);
  found.largest_value_error = error_of(ref.at("largest_value_error"));
  found.value_error_over_model = error_of(ref.at("value_error_over_model"));
  return found;
}

StorageFinding storage_of(const JsonRef& ref) {
  ref.require_only({"half", "half_values", "unorm8_nearest"});
  StorageFinding found;
  found.half = optional_of(ref.at("half"), [](const JsonRef& r) { return named(r, kHalves); });
  found.half_values = ref.at("half_values").integer();
  found.unorm8_nearest = optional_of(ref.at("unorm8_nearest"), [](const JsonRef& r) { return r.boolean(); });
  return found;
}

DeviceWords words_of(const JsonRef& ref) {
  ref.require_only({"name", "renderer", "vendor", "version", "origin", "declared_subtexel_bits"});
  return {ref.at("name").text(),    ref.at("renderer").text(), ref.at("vendor").text(),
          ref.at("version").text(), ref.at("origin").text(),   integer_in(ref.at("declared_subtexel_bits"), 0, 64)};
}

}  // namespace

ProbeRecord read_probe(const std::string& path) {
  const io::FileBytes bytes = io::read_file(path);
  const nlohmann::json parsed = nlohmann::json::parse(bytes.text().begin(), bytes.text().end(), nullptr, false);
  if (parsed.is_discarded()) throw InputError(path + ": expected a JSON document of etalon probe, got something else, or a part of one");
  const JsonRef document(parsed, "document", path);
  if (document.at("schema").text() != "etalon/probe/1")
    document.at("schema").fail(fmt::format("expected 'etalon/probe/1', got '{}'", document.at("schema").text()));
  document.require_only(
      {"schema", "contract", "inputs", "device", "coverage", "interpolation", "nearest", "linear", "storage", "factor", "run"});
  if (const double factor = document.at("factor").real(); factor != kProbeFactor)
    document.at("factor").fail(fmt::format("expected {:g}, got {:g}: measure again with this version", kProbeFactor, factor));
  ProbeRecord record;
  record.device = words_of(document.at("device"));
  record.day = document.at("run").at("day").text();
  record.findings.coverage = coverage_of(document.at("coverage"));
  record.findings.interpolation = interpolation_of(document.at("interpolation"));
  record.findings.nearest = nearest_of(document.at("nearest"));
  const JsonRef linear = document.at("linear");
  linear.require_only({"unorm8", "float32"});
  record.findings.linear_unorm8 = linear_of(linear.at("unorm8"));
  record.findings.linear_float32 = linear_of(linear.at("float32"));
  record.findings.storage = storage_of(document.at("storage"));
  return record;
}

}  // namespace etalon::validation
