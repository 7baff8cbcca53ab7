#include "validation/diff/picture.h"

#include <algorithm>
#include <array>
#include <exception>
#include <set>

#include "core/base/parallel.h"
#include "core/base/sha256.h"
#include "core/io/exr_file.h"
#include "core/io/image_file.h"
#include "core/io/inputs.h"

namespace etalon::validation {
namespace {

bool is_exr(std::span<const std::byte> bytes) {
  constexpr std::array kMagic{std::byte{0x76}, std::byte{0x2f}, std::byte{0x31}, std::byte{0x01}};
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

bool has_channel(const io::ExrContent& content, const std::string& name) {
  return std::any_of(content.layers.begin(), content.layers.end(),
                     [&](const io::ExrLayer& layer) { return layer.channel_names.front() == name; });
}

// What the bytes hold; the colours of a margins file are those of its colour channels.
void decode(std::span<const std::byte> bytes, Picture& picture) {
  const std::string& path = picture.path;
  if (!is_exr(bytes)) {
    picture.color = io::decode_image(bytes, path);
    return;
  }
  io::ExrContent content = io::decode_exr(bytes, path);
  picture.attributes = content.attributes;
  if (has_channel(content, "id.triangle")) picture.ids = io::channels_image(content, {"id.triangle"}, path);
  if (has_channel(content, "Z")) picture.depth = io::channels_image(content, {"Z"}, path);
  if (picture.ids.empty() || picture.ids.format() != kR32ui) picture.ids = {};
  if (picture.depth.empty() || picture.depth.format() != kR32f) picture.depth = {};
  std::set<std::string> in_color;
  if (has_channel(content, "R") || has_channel(content, "Y")) {
    picture.color = io::color_image(content, path);
    const bool grey = !has_channel(content, "R");
    for (const char* name : {"R", "G", "B", "A"})
      if (!grey && has_channel(content, name) && in_color.size() < static_cast<std::size_t>(picture.color.format().channels))
        in_color.insert(name);
    if (grey) in_color.insert("Y");
  } else if (!picture.depth.empty()) {
    picture.color = picture.depth, in_color.insert("Z");
  } else if (!picture.ids.empty()) {
    picture.color = picture.ids, in_color.insert("id.triangle");
  } else {
    picture.color = content.layers.front().image, in_color.insert(content.layers.front().channel_names.front());
  }
  for (io::ExrLayer& layer : content.layers)
    if (!in_color.contains(layer.channel_names.front())) picture.others.emplace(layer.channel_names.front(), std::move(layer.image));
}

}  // namespace

Picture read_picture(const std::string& path) {
  const io::FileBytes bytes = io::read_file(path);
  Picture picture{.path = path};
  parallel_for(2, [&](std::size_t part) {
    if (part == 0)
      decode(bytes.bytes(), picture);
    else
      picture.sha256 = sha256_hex(bytes.bytes());
  });
  return picture;
}

std::pair<Picture, Picture> read_pictures(const std::string& first, const std::string& second) {
  std::array<Picture, 2> pictures;
  std::array<std::exception_ptr, 2> errors;
  parallel_for(2, [&](std::size_t side) {
    try {
      pictures[side] = read_picture(side == 0 ? first : second);
    } catch (const std::exception&) {
      errors[side] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return {std::move(pictures[0]), std::move(pictures[1])};
}

}  // namespace etalon::validation
