// One sample at a time, without a frame: the renderer's own code for tests, probes and redraws of single texels.
#pragma once

#include "raster/sample_values.h"

namespace etalon::raster {

class SampleQuery {
 public:
  /// The list must outlive the query. Validates once.
  SampleQuery(const DrawList& list, const Frame& frame, Evaluation evaluation = Evaluation::filtered);

  /// Whether triangle t covers the sample of texel (i, j), inside the frame.
  [[nodiscard]] bool covers(std::uint32_t t, int i, int j) const;
  /// Its stored depth there; t must cover the texel.
  [[nodiscard]] float depth(std::uint32_t t, int i, int j) const;
  /// The bytes of every target of the frame as if t, which must cover the texel, were visible and had no runner-up.
  void store(std::uint32_t t, int i, int j, std::byte* const* texels) const;

 private:
  const TriangleSetup& setup(std::uint32_t t) const;
  const DrawList& list_;
  Frame frame_;
  Evaluation evaluation_;
  mutable std::uint32_t current_ = kNoTriangle;  ///< one query serves one thread
  mutable TriangleSetup setup_;
};

}  // namespace etalon::raster
