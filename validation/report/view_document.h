// A view written as the file that --view reads.
#pragma once

#include <string>

#include "core/draw/camera.h"

namespace etalon::validation {

/// `etalon/view/1` of a frame of width × height: numbers in the shortest form that reads back as the same double.
[[nodiscard]] std::string view_document(const Camera& camera, int width, int height);

}  // namespace etalon::validation
