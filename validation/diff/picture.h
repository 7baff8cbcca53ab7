// A picture from a file, as `etalon diff` takes it: the colours, and what a margins file holds beside them.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "core/image/image.h"

namespace etalon::validation {

struct Picture {
  std::string path;
  std::string sha256;                             ///< of the file
  Image color;                                    ///< of a picture without colour channels: depth, else ids, else the first channel
  Image ids;                                      ///< `id.triangle`; empty where there is none
  Image depth;                                    ///< `Z` as float32; likewise
  std::map<std::string, std::string> attributes;  ///< text of an OpenEXR header
  std::map<std::string, Image> others;            ///< of OpenEXR: the channels that `color` does not hold, by name, one channel each
};

/// InputError as read_image() and read_exr().
[[nodiscard]] Picture read_picture(const std::string& path);

/// Both at once. Where neither can be read, the first one's error.
[[nodiscard]] std::pair<Picture, Picture> read_pictures(const std::string& first, const std::string& second);

}  // namespace etalon::validation
