#include "core/terrain/level_coder.h"

#include <fmt/format.h>

namespace etalon::terrain {

namespace {

// floor(log2 x) for finite x > 0, exactly.
int exponent_of(double x) {
  int e = 0;
  (void)std::frexp(x, &e);
  return e - 1;
}

}  // namespace

void DecodeSide::check(bool is_possible) const {
  if (!is_possible) throw InputError(fmt::format("terrain stream: byte {}: expected a level, got bytes that are none", at_));
}

LevelCoder::LevelCoder(const StreamHeader& header) : field_(header.grid), lowest_(header.lowest), highest_(header.highest) {
  if (header.view) frustum_.emplace(*header.view);
  field_.heights.assign(field_.point_count(), 0);
  first_level_.assign(field_.point_count(), kNoLevel);
  sizes_.assign(field_.point_count(), 0);
  waiting_.resize(static_cast<std::size_t>(2 * field_.bits));
}

// The middle of the edge.
std::int32_t LevelCoder::predicted(GridPoint p, const Split& split) const {
  return (field_.height(p.i - split.along.i, p.j - split.along.j) + field_.height(p.i + split.along.i, p.j + split.along.j)) >> 1;
}

LevelCoder::Candidate LevelCoder::candidate(GridPoint p, std::uint16_t level) const {
  const Split split = split_of(field_.bits, p);
  const std::int32_t along = predicted(p, split);
  std::int64_t across = 0;
  int parents = 0, bits = 0;
  for_each_parent(field_.bits, p, split, [&](GridPoint parent) {
    const std::uint32_t index = point_index(field_.bits, parent);
    across += field_.heights[index];
    bits += sizes_[index];
    ++parents;
  });
  // Half bits of the parents' residuals; of the first point, whose parents have none, those of a quarter of the range.
  const int half_bits = split.level == 0 ? 2 * std::bit_width(static_cast<std::uint32_t>(highest_ - lowest_) / 4) : 2 * bits / parents;
  Candidate c{};
  c.point = point_index(field_.bits, p);
  c.since = level;
  const std::int64_t bend = across - std::int64_t{parents} * along;
  const int bend_bits = std::bit_width(static_cast<std::uint64_t>(bend < 0 ? -bend : bend));
  const int size = (half_bits + 2 * std::max(0, bend_bits - 1)) / 4;
  c.size = static_cast<std::uint8_t>(std::min(size, kSizes - 1));
  c.bend = static_cast<std::int8_t>(bend_bits + 1 < half_bits / 2 ? 0 : (bend > 0 ? 1 : -1));
  double weight = 1;
  if (frustum_) weight = frustum_->pixels_per_metre({field_.position(p.i, p.j).x, along * field_.unit, field_.position(p.i, p.j).z});
  c.score = static_cast<std::int16_t>(
      weight > 0 && std::isfinite(weight) ? std::clamp(half_bits + 2 * exponent_of(weight) - split.level, -900, 900) : kHidden);
  return c;
}

std::size_t LevelCoder::split_context(const Candidate& c, std::uint16_t level) const {
  const GridPoint p = point_at(field_.bits, c.point);
  const Split split = split_of(field_.bits, p);
  std::size_t siblings = 0;
  for (const int a : {-1, 1})
    for (const int b : {-1, 1}) {
      const GridPoint q{p.i + a * split.along.i + b * split.across.i, p.j + a * split.along.j + b * split.across.j};
      if (inside(field_.bits, q) && is_there(q)) ++siblings;
    }
  const int score = c.score == kHidden ? kScores : std::clamp(c.score - reference_score_ + kScores / 2 + 2, 0, kScores - 1);
  const int age = level - c.since;
  const std::size_t waited = age == 0 ? 0 : (age < 4 ? 1 : 2);
  return (static_cast<std::size_t>(score) * 5 + siblings) * 3 + waited;
}

void LevelCoder::add_children(GridPoint p, const Split& split, std::uint16_t level) {
  for_each_child(field_.bits, p, split, [&](GridPoint child) {
    bool ready = true;
    for_each_parent(field_.bits, child, split_of(field_.bits, child), [&](GridPoint parent) { ready = ready && is_there(parent); });
    if (ready) waiting_[static_cast<std::size_t>(split.level + 1)].push_back(candidate(child, level));
  });
}

}  // namespace etalon::terrain
