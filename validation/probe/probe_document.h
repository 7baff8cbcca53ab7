// PROBE.json, `etalon/probe/1` (docs/schemas/probe.json): written by `etalon probe`, read by `etalon diff --device PROBE.json`.
#pragma once

#include <string>

#include "validation/probe/device_probe.h"
#include "validation/report/run_info.h"

namespace etalon::validation {

/// The device in its own words.
struct DeviceWords {
  std::string name;  ///< "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6"
  std::string renderer, vendor, version, origin;
  int declared_subtexel_bits = 0;  ///< GL_SUBPIXEL_BITS
};

struct ProbeRecord {
  DeviceWords device;
  std::string day;  ///< of the measurement, "2027-01-31"
  ProbeFindings findings;
};

/// `run`.device and its day are taken from the record.
[[nodiscard]] nlohmann::ordered_json probe_document(const ProbeRecord& record, const RunInfo& run);

/// InputError "FILE: PATH: what, expected, got": not JSON, another schema, a member missing, of the wrong type, out of range or unknown; a
/// measurement that found no finite error.
[[nodiscard]] ProbeRecord read_probe(const std::string& path);

/// What was found, one line each, for a person.
[[nodiscard]] std::vector<std::string> probe_lines(const ProbeFindings& findings);

}  // namespace etalon::validation
