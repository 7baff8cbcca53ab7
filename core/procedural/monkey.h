// A painted monkey's head with vertex colours, of the size of the Monkey of [Kim, Choi & Lee 2008, table 1].
#pragma once

#include "core/mesh/mesh.h"
#include "core/procedural/iso_mesh.h"

namespace etalon::procedural {

struct MonkeyOptions {
  int faces = 101'002;  ///< even, 20,000 to 10,000,000; the default has the paper's 50,503 vertices
  ProcedureProgress progress;
};

/// Closed, manifold, genus 0; looks toward +Z, +Y up; about 2.4 units tall. Stripes, spots and hair are drawn in colours, not in form.
/// InputError where an option is out of range.
[[nodiscard]] Mesh make_monkey(const MonkeyOptions& options = {});

}  // namespace etalon::procedural
