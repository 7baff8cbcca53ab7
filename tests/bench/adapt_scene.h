// A whole texture adaptation [Chen & Chuang 2006, sec. 4]: the embedded head from 7,684 faces to 499 and back.
#pragma once

#include "tests/bench/bench_scene.h"

namespace etalon::bench {

/// The passes that take an indexing map (RG32F, size × size) from the finest level to the base and up again, packed and one by one.
[[nodiscard]] BenchScene adapt_scene(int size, Filter filter, std::size_t faces = 499);

}  // namespace etalon::bench
