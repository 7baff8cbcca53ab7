// What `etalon info` has to say about a drawing, and about an image that may be depths.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/call_files.h"
#include "core/image/image.h"

namespace etalon::cli {

/// What there is to say about a file, for a person and for a program.
struct Finding {
  std::vector<std::string> lines;
  nlohmann::ordered_json members = nlohmann::ordered_json::object();
};

/// FILE.draws: frame, state, targets, counts, images, and the draw list's hash. InputError as io::read_draws.
[[nodiscard]] Finding examine_draws(const std::string& path, CallFiles& files);

/// Adds what one channel of 16 bits or reals means to bake and joint: depths or heights, from where to where, and how many samples are none
/// (0 of integers; of reals what is not finite). Nothing for other images.
void add_depths(Finding& finding, const Image& image);

}  // namespace etalon::cli
