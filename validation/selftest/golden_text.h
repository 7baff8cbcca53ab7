// data/golden/hash_scenes.sha256 as CMake found it.
#pragma once

namespace etalon::validation {

extern const char* const kGoldenText;

}  // namespace etalon::validation
