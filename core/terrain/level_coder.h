// One level of a terrain stream after the other, written once for both directions: a Side that encodes is told each bit and number, one that decodes
// tells them.
//
// The points that could come next, because their parents are there, wait in a list by level of the hierarchy. A level of detail asks each of them, coarse to
// fine, whether its edge is split now; the children that become possible are asked in the same round. So every bit is about a real choice, and what must be
// split for the sake of conformity has been asked already.
//
// Contexts of a split: the distortion that the point is expected to take away, against what those of the last level took (its parents' residuals,
// the area, the weight of its place in the view: binary logarithms); how many of its four siblings are there; whether it has been passed over before.
// Contexts of a residual: the expected size, and the sign of the surface's own bend there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/arithmetic_coder.h"
#include "core/base/error.h"
#include "core/terrain/levels.h"
#include "core/terrain/quadtree.h"
#include "core/terrain/stream_header.h"

namespace etalon::terrain {

class EncodeSide {
 public:
  bool bit(bool value, AdaptiveBit& context) {
    coder.encode(value, context);
    return value;
  }
  std::int32_t number(std::int32_t value, AdaptiveInteger& context) {
    context.encode(value, coder);
    return value;
  }
  void check(bool) const {}
  ArithmeticEncoder coder;
};

class DecodeSide {
 public:
  DecodeSide(std::span<const std::byte> bytes, std::size_t at) : coder(bytes), at_(at) {}
  bool bit(bool, AdaptiveBit& context) {
    check(!coder.exhausted());
    return coder.decode(context);
  }
  std::int32_t number(std::int32_t, AdaptiveInteger& context) {
    check(!coder.exhausted());
    return context.decode(coder);
  }
  /// InputError unless what was decoded can be.
  void check(bool is_possible) const;
  ArithmeticDecoder coder;

 private:
  std::size_t at_;
};

/// The state that both sides share: heights and points so far, and what is expected of the next ones.
class LevelCoder {
 public:
  explicit LevelCoder(const StreamHeader& header);

  /// The four corners, coded in the first level.
  template <class Side>
  void corners(Side& side, const HeightField* source);
  /// Level `level`; wanted(index) and source are for the side that encodes.
  template <class Side, class Wanted>
  void level(Side& side, std::uint16_t level, const Wanted& wanted, const HeightField* source);

  [[nodiscard]] const HeightField& field() const { return field_; }
  [[nodiscard]] const std::vector<std::uint16_t>& first_level() const { return first_level_; }
  [[nodiscard]] std::vector<std::uint16_t> take_first_level() { return std::move(first_level_); }
  [[nodiscard]] HeightField take_field() { return std::move(field_); }
  [[nodiscard]] std::uint32_t vertex_count() const { return vertex_count_; }

 private:
  struct Candidate {
    std::uint32_t point;
    std::uint16_t since;  ///< level that made it possible
    std::int16_t score;   ///< binary logarithm of the expected gain; kHidden outside the view
    std::uint8_t size;    ///< class of the expected residual
    std::int8_t bend;     ///< sign of what the right angles say about it
  };
  static constexpr int kHidden = -1000, kScores = 14, kSizes = 24;

  [[nodiscard]] bool is_there(GridPoint p) const { return first_level_[point_index(field_.bits, p)] != kNoLevel; }
  [[nodiscard]] std::int32_t predicted(GridPoint p, const Split& split) const;
  [[nodiscard]] Candidate candidate(GridPoint p, std::uint16_t level) const;
  [[nodiscard]] std::size_t split_context(const Candidate& c, std::uint16_t level) const;
  void add_children(GridPoint p, const Split& split, std::uint16_t level);

  HeightField field_;
  std::int32_t lowest_, highest_;
  std::optional<ViewFrustum> frustum_;
  std::vector<std::uint16_t> first_level_;
  std::vector<std::uint8_t> sizes_;  ///< by point: bits of |residual|
  std::vector<std::vector<Candidate>> waiting_;
  std::array<AdaptiveBit, (kScores + 1) * 5 * 3> splits_;
  std::array<AdaptiveInteger, kSizes * 3> residuals_;
  AdaptiveInteger corner_;
  std::int64_t score_sum_ = 0, score_count_ = 0;  ///< of the splits of this level
  int reference_score_ = 0;                       ///< their mean, of the level before
  std::uint32_t vertex_count_ = 0;
};

template <class Side>
void LevelCoder::corners(Side& side, const HeightField* source) {
  const int s = field_.steps();
  std::int32_t before = lowest_ + (highest_ - lowest_) / 2;
  for (const GridPoint p : {GridPoint{0, 0}, GridPoint{s, 0}, GridPoint{0, s}, GridPoint{s, s}}) {
    const std::uint32_t index = point_index(field_.bits, p);
    const std::int64_t h = std::int64_t{before} + side.number(source != nullptr ? source->heights[index] - before : 0, corner_);
    side.check(h >= lowest_ && h <= highest_);
    field_.heights[index] = before = static_cast<std::int32_t>(h);
    first_level_[index] = 0;
    ++vertex_count_;
  }
  waiting_[0].push_back(candidate({s / 2, s / 2}, 0));
}

template <class Side, class Wanted>
void LevelCoder::level(Side& side, std::uint16_t level, const Wanted& wanted, const HeightField* source) {
  for (std::vector<Candidate>& asked : waiting_) {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < asked.size(); ++n) {
      const Candidate c = asked[n];
      if (!side.bit(wanted(c.point), splits_[split_context(c, level)])) {
        asked[kept++] = c;
        continue;
      }
      const GridPoint p = point_at(field_.bits, c.point);
      const Split split = split_of(field_.bits, p);
      const std::int32_t expected = predicted(p, split);
      const std::int32_t told = source != nullptr ? source->heights[c.point] - expected : 0;
      const std::int32_t residual = side.number(told, residuals_[static_cast<std::size_t>(c.size * 3 + c.bend + 1)]);
      const std::int64_t h = std::int64_t{expected} + residual;
      side.check(h >= lowest_ && h <= highest_);
      field_.heights[c.point] = static_cast<std::int32_t>(h);
      first_level_[c.point] = level;
      sizes_[c.point] = static_cast<std::uint8_t>(std::bit_width(static_cast<std::uint32_t>(residual < 0 ? -residual : residual)));
      ++vertex_count_;
      if (c.score != kHidden) score_sum_ += c.score, ++score_count_;
      add_children(p, split, level);
    }
    asked.resize(kept);
  }
  if (score_count_ > 0) reference_score_ = static_cast<int>(score_sum_ / score_count_);
  score_sum_ = score_count_ = 0;
}

}  // namespace etalon::terrain
