// Image files: PNG 8/16 bit, JPEG, TIFF 8/16/32 bit/half/float, OpenEXR half/float/uint32.
// Rows are flipped by rows: the file's top row becomes our last, so that row 0 is v = 0. No colour conversion, no (un)premultiplication,
// no rotation by EXIF: the stored numbers are the numbers. Does not: palettes as such (expanded), CMYK (turned to RGB by OpenImageIO),
// layers, mipmaps, metadata.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "core/image/image.h"

namespace etalon::io {

/// Reads an image. The content decides on the format, not the extension.
/// Channels: grey stays one channel; grey with alpha becomes RGBA (r = g = b; our two-channel format is RG); palettes become RGB or RGBA;
/// less than 8 bits become 8. TIFF with two channels of which none is alpha stays RG. Types: unorm8, unorm16, half, float32, uint32;
/// a double TIFF is rounded to float32, one of signed 16 bits becomes float32, its numbers unchanged. OpenEXR: the channels R, RG, RGB, RGBA
/// or Y (one channel); half, float or uint32, mixed half and float become float; others are for read_exr (exr_file.h). JPEG is decoded by the installed library: versions differ in last bits.
/// InputError: missing, truncated, corrupt, another format, a side over 32768 (refused before decoding), other types or channel counts.
[[nodiscard]] Image read_image(const std::filesystem::path& path);

/// The same from memory; `name` stands for the file in messages.
[[nodiscard]] Image decode_image(std::span<const std::byte> bytes, const std::string& name);

/// Writes `image` atomically, by extension: .png (unorm8, srgb8, unorm16; 1, 3 or 4 channels), .tif/.tiff (all types, uncompressed loss-free),
/// .exr (half, float32, uint32). read_image gives back the same image (srgb8 as unorm8: the files carry no such mark of ours).
/// WriteError where the file cannot be written or the format cannot hold the image.
void write_image(const std::filesystem::path& path, const Image& image);

/// The bytes of a PNG file of `image`; WriteError naming `name` where PNG cannot hold it.
[[nodiscard]] std::string encode_png(const Image& image, const std::string& name);

}  // namespace etalon::io
