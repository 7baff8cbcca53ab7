// The two halves of the study, each for one subject.
#pragma once

#include "validation/studies/soucy_study.h"

namespace etalon::validation {

/// What both need.
struct SoucyTools {
  CheckedDrawing& drawing;
  const SoucyStudyOptions& options;
  std::function<void(const std::string&)> step;
};

/// How many times `step` is called.
[[nodiscard]] int scan_steps(const SoucyScan& scan, const SoucyStudyOptions& options);
[[nodiscard]] SoucyScanResult study_scan(const SoucyScan& scan, const SoucyTools& tools);
[[nodiscard]] int model_steps(const SoucyModel& model, const SoucyStudyOptions& options);
[[nodiscard]] SoucyModelResult study_model(const SoucyModel& model, const SoucyTools& tools);

}  // namespace etalon::validation
