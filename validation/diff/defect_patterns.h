// Where unexplained texels lie, for mistakes that have no name: of one image, of a rectangle of it, at some minification, in a part of the frame;
// and whether their colours are a function of the right ones. Does: sentences. Does not: prove; a pattern is a hint where to look.
#pragma once

#include <string>
#include <vector>

#include "core/draw/renderer.h"

namespace etalon::validation {

/// `classes`: numbers of TexelClass (R unorm8); `golden` and `candidate`: the colours, of one format. Empty where there is no pattern.
[[nodiscard]] std::vector<std::string> defect_patterns(const DrawList& list, const Frame& frame, const Image& classes, const Image& golden,
                                                       const Image& candidate, Renderer& exact);

}  // namespace etalon::validation
