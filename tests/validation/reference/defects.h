// Planted defects: subjects that are wrong on purpose, to show that the suites see it.
#pragma once

#include <memory>

#include "tests/validation/reference/subject.h"

namespace etalon::validation::reference {

/// The renderer under a changed frame or draw list: `change` edits copies of what the judge sees.
[[nodiscard]] inline MakeSubject changed_subject(const MakeSubject& inner, std::function<void(DrawList&, Frame&)> change) {
  class Changed final : public SampleSubject {
   public:
    Changed(const MakeSubject& make, const DrawList& list, const Frame& frame, const std::function<void(DrawList&, Frame&)>& edit)
        : list_(list), frame_(frame) {
      edit(list_, frame_);
      inner_ = make(list_, frame_);
    }
    bool covers(std::uint32_t t, int i, int j) const override { return inner_->covers(t, i, j); }
    void store(std::uint32_t t, int i, int j, std::byte* const* target_bytes) const override { inner_->store(t, i, j, target_bytes); }

   private:
    DrawList list_;
    Frame frame_;
    std::unique_ptr<SampleSubject> inner_;
  };
  return [inner, change](const DrawList& list, const Frame& frame) { return std::make_unique<Changed>(inner, list, frame, change); };
}

/// The renderer whose last bit of every target is wrong at one covered sample in `n`.
[[nodiscard]] inline MakeSubject flipped_bit_subject(const MakeSubject& inner, std::uint32_t n) {
  class Flipped final : public SampleSubject {
   public:
    Flipped(std::unique_ptr<SampleSubject> subject, std::uint32_t period) : inner_(std::move(subject)), period_(period) {}
    bool covers(std::uint32_t t, int i, int j) const override { return inner_->covers(t, i, j); }
    void store(std::uint32_t t, int i, int j, std::byte* const* target_bytes) const override {
      inner_->store(t, i, j, target_bytes);
      if (++stored_ % period_ == 0) target_bytes[0][0] ^= std::byte{1};
    }

   private:
    std::unique_ptr<SampleSubject> inner_;
    std::uint32_t period_;
    mutable std::uint32_t stored_ = 0;
  };
  return [inner, n](const DrawList& list, const Frame& frame) { return std::make_unique<Flipped>(inner(list, frame), n); };
}

}  // namespace etalon::validation::reference
