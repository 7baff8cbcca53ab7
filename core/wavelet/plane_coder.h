// The embedded coder itself, written once for both directions: bit-planes of quadtrees of blocks that are not yet significant, in the manner of
// EZBC [Hsiang & Woods 2000, "Embedded image coding using zeroblocks of subband/wavelet coefficients and context modeling"] with the contexts of
// neighbours of EBCOT [Taubman 2000] in graded form.
//
// A Coder has `bool code(bool truth, AdaptiveBit&)`: an encoder writes `truth` and gives it back, a decoder gives what it reads; and on_significant().
// One that has on_pass_end() too hears of it after each pass.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "core/base/arithmetic_coder.h"
#include "core/base/error.h"
#include "core/wavelet/band_state.h"
#include "core/wavelet/contexts.h"

namespace etalon::wavelet {

/// The coefficients of one band as the encoder has them: magnitude | kSignBit, row by row. A decoder has none.
using BandTruth = std::vector<std::uint32_t>;

template <class Coder>
class PlaneCoder {
 public:
  /// `truths`: one a band for encoders (with top_plane set in the bands' grids), empty for decoders.
  PlaneCoder(std::vector<BandState>& bands, const std::vector<BandTruth>& truths, Coder& coder)
      : bands_(bands), truths_(truths), coder_(coder) {}

  /// Codes all passes; a Coder stops it early by an exception, between two bits. The bands' `known` holds what was sent, at any such moment.
  void run(const std::vector<Pass>& passes) {
    for (const Pass& pass : passes) {
      state_ = &bands_[pass.band];
      truth_ = truths_.empty() ? nullptr : &truths_[pass.band];
      contexts_ = &models_.of_channel(state_->channel);
      plane_ = pass.plane;
      pass.refines ? refine() : find_significant();
      if constexpr (requires { coder_.on_pass_end(); }) coder_.on_pass_end();
    }
  }

 private:
  void find_significant() {
    BandState& s = *state_;
    s.refinable = s.significant.size();
    if (s.is_delayed()) wake();
    for (std::size_t depth = 0; depth < s.pending.size(); ++depth) {
      std::vector<Place>& list = s.pending[depth];
      std::size_t kept = 0;
      for (std::size_t i = 0; i < list.size(); ++i) {
        const Place place = list[i];
        if (!is_significant(depth, place, false)) {
          if (has_next_plane(depth, place)) list[kept++] = place;
        } else {
          open(depth, place);
        }
      }
      list.resize(kept);
    }
  }

  void wake() {
    std::vector<Waiting>& due = state_->wakes[static_cast<std::size_t>(plane_ - state_->last_plane)];
    for (const Waiting& w : due) state_->pending[w.depth].push_back(w.place);
    due = {};
  }

  [[nodiscard]] bool has_next_plane(std::size_t depth, Place place) const {
    return state_->is_delayed() ? state_->grids[depth].last_plane[state_->grids[depth].index(place)] < plane_ : plane_ > 0;
  }

  bool is_significant(std::size_t depth, Place place, bool in_split) {
    AdaptiveBit& context = depth == 0 ? coefficient_context(place) : block_context(depth, place, in_split);
    return coder_.code(truth_ != nullptr && is_truly_significant(depth, place), context);
  }
  [[nodiscard]] bool is_truly_significant(std::size_t depth, Place place) const {
    const BlockGrid& grid = state_->grids[depth];
    return grid.top_plane[grid.index(place)] >= plane_;
  }

  // A block with a significant coefficient: the coefficient itself, or its four parts.
  void open(std::size_t depth, Place place) {
    if (depth == 0) return appear(place);
    BlockGrid& grid = state_->grids[depth];
    grid.is_significant[grid.bordered(place)] = 1;

    std::array<Place, 4> parts;
    std::size_t count = 0;
    const BlockGrid& fine = state_->grids[depth - 1];
    for (int part = 0; part < 4; ++part) {
      const int x = 2 * place_x(place) + part % 2, y = 2 * place_y(place) + part / 2;
      if (x < fine.width && y < fine.height && is_open_now(depth - 1, make_place(x, y))) parts[count++] = make_place(x, y);
    }
    bool found = false;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_implied = !found && i + 1 == count;
      if (is_implied && truth_ != nullptr)
        ETALON_CHECK(is_truly_significant(depth - 1, parts[i]), fmt::format("block {} at depth {}", place, depth));
      if (is_implied || is_significant(depth - 1, parts[i], true)) {
        found = true;
        open(depth - 1, parts[i]);
      } else if (has_next_plane(depth - 1, parts[i])) {
        state_->pending[depth - 1].push_back(parts[i]);
      }
    }
  }

  // Whether the part has bits at this plane; if only later, it is set to wait for them.
  bool is_open_now(std::size_t depth, Place place) {
    if (!state_->is_delayed()) return true;
    const BlockGrid& grid = state_->grids[depth];
    const int first = grid.first_plane[grid.index(place)], last = grid.last_plane[grid.index(place)];
    if (first >= plane_) return last <= plane_;
    if (first >= last)
      state_->wakes[static_cast<std::size_t>(first - state_->last_plane)].push_back({static_cast<std::uint8_t>(depth), place});
    return false;
  }

  void appear(Place place) {
    BandState& s = *state_;
    const std::size_t at = s.grids[0].bordered(place), index = s.grids[0].index(place);
    const SignContext sign = sign_context(s.known.data() + at, s.grids[0].stride(), s.band.orientation);
    const bool truth = truth_ != nullptr && ((*truth_)[index] & kSignBit) != 0;
    const bool negative = coder_.code(truth != sign.flips, contexts_->sign[kind()][sign.index]) != sign.flips;
    const int bit = plane_ + s.delay(place);
    s.known[at] = (1u << bit) | (negative ? kSignBit : 0);
    s.known_plane[index] = static_cast<std::uint8_t>(bit);
    if (bit > 0) s.significant.push_back(place);
    coder_.on_significant();
  }

  void refine() {
    BandState& s = *state_;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < s.refinable; ++i) {
      const Place place = s.significant[i];
      const std::size_t at = s.grids[0].bordered(place), index = s.grids[0].index(place);
      const int bit = plane_ + s.delay(place);
      const bool truth = truth_ != nullptr && (((*truth_)[index] >> bit) & 1) != 0;
      const std::size_t context = refinement_context(s.known.data() + at, s.grids[0].stride(), bit);
      s.known[at] |= static_cast<std::uint32_t>(coder_.code(truth, contexts_->refinement[context])) << bit;
      s.known_plane[index] = static_cast<std::uint8_t>(bit);
      if (bit > 0) s.significant[kept++] = place;
    }
    s.significant.erase(s.significant.begin() + static_cast<std::ptrdiff_t>(kept),
                        s.significant.begin() + static_cast<std::ptrdiff_t>(s.refinable));
    s.refinable = 0;
  }

  [[nodiscard]] std::size_t kind() const { return state_->band.orientation == Orientation::hh ? 1 : 0; }

  AdaptiveBit& coefficient_context(Place place) {
    const BandState& s = *state_;
    const int bit = plane_ + s.delay(place);
    int activity = neighbour_activity(s.known.data() + s.grids[0].bordered(place), s.grids[0].stride(), bit, s.band.orientation);
    activity += related_activity(place, bit);
    return contexts_->coefficient[kind()][kActivityClass[static_cast<std::size_t>(std::min(activity, kMaxActivity))]];
  }

  // The coefficient over this one in the next coarser band, and in luma: 0, 1 or 2 each, by its size.
  [[nodiscard]] int related_activity(Place place, int bit) const {
    const BandState& s = *state_;
    int activity = 0;
    if (s.parent != nullptr) {
      const Place above = make_place(place_x(place) / 2, place_y(place) / 2);
      activity += kParentWeight * graded(s.parent->known[s.parent->grids[0].bordered(above)], bit + s.parent_shift);
    }
    if (s.luma != nullptr) activity += kLumaWeight * graded(s.luma->known[s.luma->grids[0].bordered(place)], bit + s.luma_shift);
    return activity;
  }

  AdaptiveBit& block_context(std::size_t depth, Place place, bool in_split) {
    const BandState& s = *state_;
    const BlockGrid& grid = s.grids[depth];
    const std::uint8_t* at = grid.is_significant.data() + grid.bordered(place);
    const std::ptrdiff_t row = grid.stride();
    const int sides = at[-1] + at[1] + at[-row] + at[row], corners = at[-row - 1] + at[-row + 1] + at[row - 1] + at[row + 1];
    int above = 0;
    if (s.parent != nullptr) above += is_known(*s.parent, depth - 1, place);
    if (s.luma != nullptr) above += is_known(*s.luma, depth, place);
    const std::size_t level = std::min<std::size_t>(depth, kBlockDepths) - 1;
    return contexts_
        ->block[in_split ? 1 : 0][level][static_cast<std::size_t>(above)][kBlockClass[static_cast<std::size_t>(2 * sides + corners)]];
  }

  static int is_known(const BandState& other, std::size_t depth, Place place) {
    depth = std::min(depth, other.grids.size() - 1);
    const BlockGrid& grid = other.grids[depth];
    if (place_x(place) >= grid.width || place_y(place) >= grid.height) return 0;
    return (depth == 0 ? other.known[grid.bordered(place)] != 0 : grid.is_significant[grid.bordered(place)] != 0) ? 1 : 0;
  }

  std::vector<BandState>& bands_;
  const std::vector<BandTruth>& truths_;
  Coder& coder_;
  ContextModels models_;
  BandState* state_ = nullptr;
  const BandTruth* truth_ = nullptr;
  ChannelContexts* contexts_ = nullptr;
  int plane_ = 0;
};

}  // namespace etalon::wavelet
