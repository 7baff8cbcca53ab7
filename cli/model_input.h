// MODEL on the command line: a mesh file with its textures, or one of the embedded models, ready to draw.
#pragma once

#include <string>

#include <CLI/App.hpp>

#include "cli/call_files.h"
#include "core/base/error.h"
#include "core/io/mesh_file.h"
#include "core/procedural/model.h"
#include "validation/verify/verify.h"

namespace etalon::cli {

struct ModelOptions {
  std::string texture;  ///< image that replaces the model's own textures
  bool flip_v = false;  ///< the model's v runs the other way
  int snap_bits = 8;    ///< sub-texel bits
};

void add_model_options(CLI::App& verb, ModelOptions& options);

/// Reads model and textures. A model without texture is drawn in its vertex colours; without those, with a checkerboard, which is projected
/// along z where there are no texture coordinates either; the notes say so. InputError. All that is read is added to
/// `files`: UsageError where one of them is an output.
[[nodiscard]] validation::VerifyModel load_model(const std::string& path, const ModelOptions& options, CallFiles& files);

/// What `draw` returns; an InputError of a scene made from the model at `path` names that file.
template <typename Draw>
auto naming_the_model(const std::string& path, const Draw& draw) {
  try {
    return draw();
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

/// A file as a document names it: name, sha256, role, and whom to credit. InputError where it cannot be read.
[[nodiscard]] validation::VerifyInput file_input(const std::string& path, const std::string& role);

/// Adds what the model was read from besides its own file: material libraries, buffers, textures.
void add_side_files(CallFiles& files, const io::LoadedModel& model);

/// The same from a procedural model; its input's sha256 is over mesh and texture.
[[nodiscard]] validation::VerifyModel embedded_model(procedural::Model model);

/// sha256 over the mesh's arrays (positions, colours, wedges, faces, materials), in this order, as stored in memory.
[[nodiscard]] std::string mesh_sha256(const Mesh& mesh);

}  // namespace etalon::cli
