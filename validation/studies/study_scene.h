// A drawing of a study: what any renderer takes.
#pragma once

#include "core/draw/draw_list.h"

namespace etalon::validation {

/// Two targets: colour (RGBA unorm8 on black) and triangle ids.
struct StudyScene {
  DrawList list;
  Frame frame;
};

}  // namespace etalon::validation
