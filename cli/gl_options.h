// The GL side of the command line: --context, --driver, --shader, and the device they lead to.
#pragma once

#include <memory>
#include <string>

#include <CLI/App.hpp>

#include "core/draw/renderer.h"
#include "validation/bounds.h"
#include "validation/probe/probe_document.h"

namespace etalon::cli {

struct GlOptions {
  std::string context = "auto";
  std::string driver = "default";
  std::string shader = "native";  ///< or exact: the device then owes every bound 0
};

void add_gl_options(CLI::App& verb, GlOptions& options);

/// A device, or why there is none.
struct OpenedDevice {
  std::unique_ptr<Renderer> renderer;
  validation::DeviceModel model;
  std::string unavailable;  ///< one line; empty where renderer is set
};

/// Never throws for a missing device.
/// `threads`: of the device, 0 for its own choice.
[[nodiscard]] OpenedDevice open_device(const GlOptions& options, int threads);

/// A device that draws what it is given as it stands, for `etalon probe`, with what it says of itself.
struct OpenedProbeDevice {
  std::unique_ptr<Renderer> renderer;
  validation::DeviceWords words;
  std::string unavailable;  ///< one line; empty where renderer is set
};

/// Never throws for a missing device. UsageError for --shader exact, whose values are not the device's.
[[nodiscard]] OpenedProbeDevice open_probe_device(const GlOptions& options, int threads);

}  // namespace etalon::cli
