#include "validation/probe/device_probe.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etalon::validation {

ProbeFindings probe_device(Renderer& device, const ProbeOptions& options) {
  ProbeFindings findings;
  const auto begin = [&](const char* experiment) {
    if (options.progress) options.progress(experiment, 0, 1);
  };
  findings.coverage = probe_coverage(device, options);
  // Positions must be on the device's grid, or its snapping would be taken for an error of its interpolation.
  findings.interpolation = probe_interpolation(device, options, std::min(8, findings.coverage.nearest_bits));
  begin("nearest texels");
  findings.nearest = probe_nearest(device);
  begin("linear filter, bytes");
  findings.linear_unorm8 = probe_linear(device, ChannelType::unorm8);
  begin("linear filter, floats");
  findings.linear_float32 = probe_linear(device, ChannelType::float32);
  begin("storage");
  findings.storage = probe_storage(device);
  return findings;
}

namespace {

double weight_error(const LinearFinding& linear) { return linear.weight_bits ? std::ldexp(1.0, -*linear.weight_bits) : 0; }

}  // namespace

DeviceModel model_of_findings(const ProbeFindings& findings, const std::string& device, const std::string& day) {
  DeviceModel model =
      measured_model(device, kProbeFactor * findings.interpolation.largest(), fmt::format("{}, times {:g}", day, kProbeFactor));
  const NearestFinding& nearest = findings.nearest;
  model.coordinate_error_texel =
      nearest.fixed_bits ? std::ldexp(1.0, -*nearest.fixed_bits) : kProbeFactor * std::max(-nearest.earliest_texel, nearest.latest_texel);
  model.weight_error_unorm8_texel = weight_error(findings.linear_unorm8);
  model.weight_error_texel = weight_error(findings.linear_float32);
  model.filter_error_unorm8 = kProbeFactor * findings.linear_unorm8.value_error_over_model;
  model.filter_error = kProbeFactor * findings.linear_float32.value_error_over_model;
  model.unorm_toward_zero = findings.storage.unorm8_nearest == false;
  return model;
}

}  // namespace etalon::validation
