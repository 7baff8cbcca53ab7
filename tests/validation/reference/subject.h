// What the judge is compared with: the renderer's code for one sample, the other transcription of the judge, or a planted defect.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "core/draw/draw_list.h"
#include "validation/reference/sample.h"

namespace etalon::validation::reference {

class SampleSubject {
 public:
  virtual ~SampleSubject() = default;
  /// Whether triangle t covers the sample of texel (i, j), which lies in the frame.
  [[nodiscard]] virtual bool covers(std::uint32_t t, int i, int j) const = 0;
  /// The bytes of every target of the frame where t is visible at (i, j), which it covers, without a runner-up.
  virtual void store(std::uint32_t t, int i, int j, std::byte* const* target_bytes) const = 0;
};

/// Makes a subject for one thread; list and frame outlive it.
using MakeSubject = std::function<std::unique_ptr<SampleSubject>(const DrawList&, const Frame&)>;

/// raster::SampleQuery, double enclosures first.
[[nodiscard]] MakeSubject raster_subject();
/// raster::SampleQuery, wide integers always.
[[nodiscard]] MakeSubject exact_raster_subject();
/// A transcription of the judge.
[[nodiscard]] MakeSubject judge_subject(Arithmetic arithmetic);

}  // namespace etalon::validation::reference
