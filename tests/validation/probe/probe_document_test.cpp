// PROBE.json: what is written is read back, and the bounds that follow; whatever is not whole is refused by the member's name.
#include "validation/probe/probe_document.h"

#include <cmath>
#include <filesystem>
#include <functional>

#include <doctest/doctest.h>

#include "core/io/atomic_file.h"
#include "tests/io/scratch.h"
#include "validation/report/json_report.h"

using namespace etalon;
using namespace etalon::validation;
using nlohmann::ordered_json;

namespace {

ProbeRecord gpu_like_record() {
  ProbeRecord record;
  record.device = {"Imaginary 3000, OpenGL 4.6", "Imaginary 3000", "Imaginary", "4.6", "EGL", 8};
  record.day = "2026-01-31";
  ProbeFindings& f = record.findings;
  f.coverage = {.triangles = 1000,
                .texels = 2000,
                .subtexel_bits = 8,
                .snap = SnapRounding::half_up,
                .fill_rule = FillRule::left_ymax,
                .differing = 0,
                .nearest_bits = 8,
                .nearest_snap = SnapRounding::half_up,
                .nearest_rule = FillRule::left_ymax};
  f.interpolation = {.samples = 100, .unbounded = 3, .affine = 0.25, .perspective = 0.5, .depth = 0.125};
  f.nearest = {.steps = true, .earliest_texel = -0x1p-9, .latest_texel = 0, .fixed_bits = 8};
  f.linear_unorm8 = {.weight_bits = 8,
                     .weights_rounded = true,
                     .largest_weight_error = 0x1p-9,
                     .levels_of_small_step = 257,
                     .largest_value_error = 0.01,
                     .value_error_over_model = 0.001};
  f.linear_float32 = {.weight_bits = {}, .largest_weight_error = 1e-7, .largest_value_error = 1e-7, .value_error_over_model = 0};
  f.storage = {.half = HalfRounding::nearest_even, .half_values = 10, .unorm8_nearest = true};
  return record;
}

RunInfo run_info() { return {.version = "0", .threads = 1}; }

std::string refusal(const std::function<void(ordered_json&)>& change, ProbeRecord record = gpu_like_record()) {
  ordered_json document = probe_document(record, run_info());
  change(document);
  const etalon::test::ScratchFolder folder;
  const auto path = folder.put("p.json", to_text(document));
  const std::string message = etalon::test::input_error([&] { (void)read_probe(path.string()); });
  return message.starts_with(path.string()) ? message.substr(path.string().size()) : message;
}

}  // namespace

TEST_CASE("probe document: what is written is read back") {
  const ordered_json document = probe_document(gpu_like_record(), run_info());
  const etalon::test::ScratchFolder folder;
  const ProbeRecord read = read_probe(folder.put("p.json", to_text(document)).string());
  CHECK(probe_document(read, run_info()) == document);
  CHECK(read.device.name == "Imaginary 3000, OpenGL 4.6");
  CHECK(read.findings.coverage.fill_rule == FillRule::left_ymax);
  CHECK_FALSE(read.findings.linear_float32.weight_bits.has_value());
}

TEST_CASE("probe document: the bounds are magnitudes times the factor, and whole steps of fixed point") {
  const ProbeRecord record = gpu_like_record();
  const DeviceModel model = model_of_findings(record.findings, record.device.name, record.day);
  CHECK(model.origin == BoundOrigin::measured);
  CHECK(model.valid_for == "2026-01-31, times 4");
  CHECK(model.factor == 2);  // the largest of the three, times 4
  CHECK(model.coordinate_error_texel == 0x1p-8);
  CHECK(model.weight_error_unorm8_texel == 0x1p-8);
  CHECK(model.weight_error_texel == 0);
  CHECK(model.filter_error_unorm8 == 0.004);
  CHECK_FALSE(model.unorm_toward_zero);
  CHECK_FALSE(model.fixed_point_linear8);
  ProbeFindings uneven = record.findings;
  uneven.nearest.fixed_bits.reset();
  uneven.nearest.earliest_texel = -0.01;
  uneven.nearest.latest_texel = 0.02;
  CHECK(model_of_findings(uneven, "", "").coordinate_error_texel == 0.08);
}

TEST_CASE("probe document: refused by name where something is missing, wrong, out of range or unknown") {
  CHECK(refusal([](ordered_json&) {}) == "no error");
  CHECK(refusal([](ordered_json& d) { d["schema"] = "etalon/diff/1"; }) == ": schema: expected 'etalon/probe/1', got 'etalon/diff/1'");
  CHECK(refusal([](ordered_json& d) { d.erase("coverage"); }).find("expected a member 'coverage', got none") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["coverage"].erase("snap"); }).find("expected a member 'snap'") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["coverage"]["subtexel_bits"] = 17; }) ==
        ": coverage.subtexel_bits: expected an integer from 1 to 16, got 17");
  CHECK(refusal([](ordered_json& d) { d["coverage"]["nearest"]["subtexel_bits"] = nullptr; }).find("expected an integer") !=
        std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["coverage"]["fill_rule"] = "top_left"; }).find("coverage.fill_rule: expected one of left_ymin, ") !=
        std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["interpolation"]["affine"] = "small"; }) ==
        ": interpolation.affine: expected a number, got string");
  CHECK(refusal([](ordered_json& d) { d["interpolation"]["affine"] = -1; }) ==
        ": interpolation.affine: expected a number from 0 to 1e+06, got -1");
  CHECK(refusal([](ordered_json& d) { d["interpolation"]["samples"] = 0; }).find("expected at least 1 sample") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["nearest"]["steps"] = false; }).find("was not measured") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["nearest"]["latest_texel"] = 2; }).find("nearest.latest_texel") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["linear"]["unorm8"]["weight_bits"] = 40; }).find("linear.unorm8.weight_bits") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["linear"]["rgb"] = 1; }).find("got a member 'rgb'") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["storage"]["half"] = "up"; }).find("storage.half: expected one of nearest_even") !=
        std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["storage"]["unorm8_nearest"] = 1; }).find("expected true or false") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["factor"] = 2; }) == ": factor: expected 4, got 2: measure again with this version");
  CHECK(refusal([](ordered_json& d) { d["run"].erase("day"); }).find("expected a member 'day'") != std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["device"]["declared_subtexel_bits"] = 65; }).find("device.declared_subtexel_bits") !=
        std::string::npos);
  CHECK(refusal([](ordered_json& d) { d["more"] = 1; }).find("got a member 'more'") != std::string::npos);
  ProbeRecord nan = gpu_like_record();
  nan.findings.interpolation.perspective = HUGE_VAL;
  CHECK(refusal([](ordered_json&) {}, nan).find("interpolation.perspective: expected a finite error, got none") != std::string::npos);
}

TEST_CASE("probe document: every truncation is refused") {
  const std::string whole = to_text(probe_document(gpu_like_record(), run_info()));
  const etalon::test::ScratchFolder folder;
  for (std::size_t size = 1; size + 2 < whole.size(); size += 7) {
    const auto path = folder.put("p.json", whole.substr(0, size));
    CAPTURE(size);
    CHECK(etalon::test::input_error([&] { (void)read_probe(path.string()); }).find("p.json: expected a JSON document") !=
          std::string::npos);
  }
  const std::string nest = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  for (const std::string& text : {nest, "{\"schema\":" + nest + "}", "{\"schema\":\"etalon/probe/1\",\"device\":" + nest + "}"}) {
    const auto path = folder.put("deep.json", text);
    CHECK(etalon::test::input_error([&] { (void)read_probe(path.string()); }).find("deep.json: ") != std::string::npos);
  }
  CHECK(etalon::test::input_error([&] { (void)read_probe((folder / "none.json").string()); }).find("none.json") != std::string::npos);
}
