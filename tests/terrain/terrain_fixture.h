// Small terrains for the tests.
#pragma once

#include "core/terrain/height_field.h"
#include "core/terrain/terrain_view.h"

namespace etalon::test {

/// Ridged value noise over (2^bits+1)² points, 20 m apart, rough and smooth places; heights of about ±300 m.
[[nodiscard]] terrain::HeightField rough_field(int bits, std::uint64_t seed = 1);

/// Every height a chance number of ±range units.
[[nodiscard]] terrain::HeightField random_field(int bits, std::int32_t range, std::uint64_t seed);

/// From a corner over the field, about a tenth of it in the frustum.
[[nodiscard]] terrain::TerrainView low_view(const terrain::HeightField& field);

/// $ETALON_DATA's davosdorf in the window of the studies, or nothing.
[[nodiscard]] std::optional<terrain::HeightField> davosdorf(int grid_bits = 8);

}  // namespace etalon::test
