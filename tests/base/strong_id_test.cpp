// Ids: invalid by default, ordered by index, and not convertible into each other.
#include "core/base/strong_id.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace {

using AppleId = etalon::StrongId<struct AppleTag>;
using PearId = etalon::StrongId<struct PearTag>;

static_assert(!std::is_convertible_v<AppleId, PearId>);
static_assert(!std::is_constructible_v<AppleId, PearId>);
static_assert(!std::is_convertible_v<std::uint32_t, AppleId>);

}  // namespace

TEST_CASE("strong id: invalid by default, valid with an index") {
  CHECK_FALSE(AppleId().valid());
  CHECK(AppleId(0u).valid());
  CHECK(AppleId(7u).index == 7);
  CHECK(AppleId(std::size_t{7}) == AppleId(7u));
}

TEST_CASE("strong id: ordered by index, the invalid one last") {
  CHECK(AppleId(1u) < AppleId(2u));
  CHECK(AppleId(2u) < AppleId());
}
