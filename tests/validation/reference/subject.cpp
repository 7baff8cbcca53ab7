#include "tests/validation/reference/subject.h"

#include <cstring>

#include "raster/sample_query.h"

namespace etalon::validation::reference {

namespace {

class RasterSubject final : public SampleSubject {
 public:
  RasterSubject(const DrawList& list, const Frame& frame, raster::Evaluation evaluation) : query_(list, frame, evaluation) {}
  bool covers(std::uint32_t t, int i, int j) const override { return query_.covers(t, i, j); }
  void store(std::uint32_t t, int i, int j, std::byte* const* target_bytes) const override { query_.store(t, i, j, target_bytes); }

 private:
  raster::SampleQuery query_;
};

class JudgeSubject final : public SampleSubject {
 public:
  JudgeSubject(const DrawList& list, const Frame& frame, Arithmetic arithmetic) : list_(list), frame_(frame), arithmetic_(arithmetic) {}

  bool covers(std::uint32_t t, int i, int j) const override { return judge(t).verdict(i, j).covered; }

  void store(std::uint32_t t, int i, int j, std::byte* const* target_bytes) const override {
    std::vector<TexelBytes> bytes(frame_.targets.size());
    judge(t).store(i, j, frame_.targets, std::nullopt, bytes.data());
    for (std::size_t n = 0; n < bytes.size(); ++n)
      std::memcpy(target_bytes[n], bytes[n].data(), static_cast<std::size_t>(bytes_per_texel(frame_.targets[n].format)));
  }

 private:
  const TriangleJudge& judge(std::uint32_t t) const {
    if (t != current_) current_judge_ = make_triangle_judge(list_, frame_, t, arithmetic_), current_ = t;
    return *current_judge_;
  }
  const DrawList& list_;
  const Frame& frame_;
  Arithmetic arithmetic_;
  mutable std::uint32_t current_ = kNoTriangle;
  mutable std::unique_ptr<TriangleJudge> current_judge_;
};

MakeSubject raster_subject(raster::Evaluation evaluation) {
  return [evaluation](const DrawList& list, const Frame& frame) { return std::make_unique<RasterSubject>(list, frame, evaluation); };
}

}  // namespace

MakeSubject raster_subject() { return raster_subject(raster::Evaluation::filtered); }
MakeSubject exact_raster_subject() { return raster_subject(raster::Evaluation::exact); }

MakeSubject judge_subject(Arithmetic arithmetic) {
  return [arithmetic](const DrawList& list, const Frame& frame) { return std::make_unique<JudgeSubject>(list, frame, arithmetic); };
}

}  // namespace etalon::validation::reference
