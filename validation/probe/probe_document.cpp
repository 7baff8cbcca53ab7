#include "validation/probe/probe_document.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "validation/report/json_report.h"

namespace etalon::validation {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class T>
Json optional_name(const std::optional<T>& value) {
  return value ? Json(to_string(*value)) : Json(nullptr);
}

// NaN from a device has no size that a number could say.
Json size_json(double error) { return std::isfinite(error) ? Json(error) : Json(nullptr); }

Json linear_json(const LinearFinding& linear) {
  return {{"weight_bits", optional_json(linear.weight_bits)},
          {"weights_rounded", linear.weights_rounded},
          {"largest_weight_error", size_json(linear.largest_weight_error)},
          {"levels_of_small_step", linear.levels_of_small_step},
          {"largest_value_error", size_json(linear.largest_value_error)},
          {"value_error_over_model", size_json(linear.value_error_over_model)}};
}

template <class T>
std::string name_or(const std::optional<T>& value, const char* none) {
  return value ? to_string(*value) : none;
}

std::string linear_line(const char* texels, const LinearFinding& linear) {
  std::string text = fmt::format("linear      {}: ", texels);
  text += linear.weight_bits ? fmt::format("weights of {} bits, {}", *linear.weight_bits, linear.weights_rounded ? "rounded" : "truncated")
                             : std::string("weights finer than 2^-15");
  if (linear.levels_of_small_step == 2) text += ", results are bytes";
  return text + fmt::format("; largest error {:.3g}", linear.largest_value_error);
}

}  // namespace

nlohmann::ordered_json probe_document(const ProbeRecord& record, const RunInfo& run) {
  const ProbeFindings& f = record.findings;
  Json document = document_head("probe", {});
  document["device"] = {{"name", record.device.name},     {"renderer", record.device.renderer},
                        {"vendor", record.device.vendor}, {"version", record.device.version},
                        {"origin", record.device.origin}, {"declared_subtexel_bits", record.device.declared_subtexel_bits}};
  document["coverage"] = {{"triangles", f.coverage.triangles},
                          {"texels", f.coverage.texels},
                          {"subtexel_bits", optional_json(f.coverage.subtexel_bits)},
                          {"snap", optional_name(f.coverage.snap)},
                          {"fill_rule", optional_name(f.coverage.fill_rule)},
                          {"differing", f.coverage.differing},
                          {"nearest",
                           {{"subtexel_bits", f.coverage.nearest_bits},
                            {"snap", to_string(f.coverage.nearest_snap)},
                            {"fill_rule", to_string(f.coverage.nearest_rule)}}}};
  document["interpolation"] = {{"samples", f.interpolation.samples},
                               {"unbounded", f.interpolation.unbounded},
                               {"affine", size_json(f.interpolation.affine)},
                               {"perspective", size_json(f.interpolation.perspective)},
                               {"depth", size_json(f.interpolation.depth)}};
  document["nearest"] = {{"steps", f.nearest.steps},
                         {"earliest_texel", f.nearest.earliest_texel},
                         {"latest_texel", f.nearest.latest_texel},
                         {"fixed_bits", optional_json(f.nearest.fixed_bits)}};
  document["linear"] = {{"unorm8", linear_json(f.linear_unorm8)}, {"float32", linear_json(f.linear_float32)}};
  document["storage"] = {{"half", optional_name(f.storage.half)},
                         {"half_values", f.storage.half_values},
                         {"unorm8_nearest", optional_json(f.storage.unorm8_nearest)}};
  document["factor"] = kProbeFactor;
  RunInfo told = run;
  told.device = record.device.name;
  Json circumstances = to_json(told);
  circumstances["day"] = record.day;
  document["run"] = std::move(circumstances);
  return document;
}

std::vector<std::string> probe_lines(const ProbeFindings& f) {
  std::vector<std::string> lines;
  const CoverageFinding& c = f.coverage;
  if (c.exact())
    lines.push_back(fmt::format("coverage    {} sub-texel bits, snap {}, fill rule {}: all {} texels of {} triangles",
                                c.subtexel_bits ? fmt::format("{}{}", *c.subtexel_bits, *c.subtexel_bits == 16 ? " or more" : "") : "?",
                                name_or(c.snap, "not seen"), name_or(c.fill_rule, "?"), grouped(c.texels), grouped(c.triangles)));
  else
    lines.push_back(fmt::format("coverage    by no grid and rule; nearest {} bits, {}, {}: {} of {} texels differ", c.nearest_bits,
                                to_string(c.nearest_snap), to_string(c.nearest_rule), grouped(c.differing), grouped(c.texels)));
  lines.push_back(fmt::format("values      {:.3f} (affine), {:.3f} (perspective), {:.3f} (depth) of llvmpipe's derived bound, {} samples",
                              f.interpolation.affine, f.interpolation.perspective, f.interpolation.depth,
                              grouped(f.interpolation.samples)));
  if (!f.nearest.steps)
    lines.push_back("nearest     texels do not follow one another: no border was found");
  else
    lines.push_back(fmt::format(
        "nearest     borders from {:g} to {:g} texel beside their place: {}", f.nearest.earliest_texel, f.nearest.latest_texel,
        f.nearest.fixed_bits ? fmt::format("coordinates of {} bits, rounded", *f.nearest.fixed_bits) : std::string("no fixed point seen")));
  lines.push_back(linear_line("bytes", f.linear_unorm8));
  lines.push_back(linear_line("floats", f.linear_float32));
  lines.push_back(fmt::format("storage     half {}, unorm8 {}", name_or(f.storage.half, "by neither rule"),
                              !f.storage.unorm8_nearest ? "by neither rule" : (*f.storage.unorm8_nearest ? "nearest" : "toward_zero")));
  return lines;
}

}  // namespace etalon::validation
