// The embedded default model: a closed, textured head, the size of the parasaur head of [Chen & Chuang 2006].
#pragma once

#include "core/procedural/model.h"

namespace etalon::procedural {

struct HeadOptions {
  int faces = 7685;         ///< 72..2,000,000; a closed mesh with a mirror plane has a multiple of 4: the next one below is made (7,684)
  int texture_size = 1024;  ///< texels on a side, 64..8192
};

/// A young crested dinosaur: closed, manifold, genus 0, mirror-symmetric, looking toward +Z, +Y up. Charts, apart by gutters, none folded,
/// mirrored or overlapping: the skin, cut open along the ventral midline; the tip of the bill; the base of the neck; and, where the
/// mesh is fine enough, each eye. The texture is lit (sky visibility, key and rim light baked in), so that drawing it unlit looks solid. InputError
/// where an option is out of range.
[[nodiscard]] Model make_head(const HeadOptions& options = {});

}  // namespace etalon::procedural
