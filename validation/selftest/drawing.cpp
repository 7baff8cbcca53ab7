#include "validation/selftest/drawing.h"

#include "core/base/parallel.h"

namespace etalon::validation {

using raster::Evaluation;

void apply(const Drawing& drawing) {
  if (drawing.evaluation == Evaluation::vectorised) raster::set_simd_level(drawing.level);
  set_thread_count(drawing.threads);
}

std::string to_string(Evaluation evaluation) {
  switch (evaluation) {
    case Evaluation::vectorised: return "vectorised";
    case Evaluation::filtered: return "filtered";
    case Evaluation::exact: return "exact";
  }
  return "?";
}

std::string level_name(const Drawing& drawing) {
  return drawing.evaluation == Evaluation::vectorised ? raster::to_string(drawing.level) : "-";
}

}  // namespace etalon::validation
