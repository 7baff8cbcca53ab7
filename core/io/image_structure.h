// A walk over the outer structure of image files before a decoder sees them: the decoders fill in for missing ends, we refuse them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace etalon::io {

/// PNG: all chunks complete up to IEND, their CRCs right. InputError "NAME: byte OFFSET: …".
void check_png_structure(std::span<const std::byte> bytes, const std::string& name);

/// JPEG: all segments complete up to the EOI marker that ends the image.
void check_jpeg_structure(std::span<const std::byte> bytes, const std::string& name);

/// TIFF and BigTIFF: the first directory, the values that it points at, and every strip or tile lie within the file; sides at most 32768.
void check_tiff_structure(std::span<const std::byte> bytes, const std::string& name);

/// OpenEXR: magic, single-part flat image, complete header; the data window at most 32768 on a side.
void check_exr_structure(std::span<const std::byte> bytes, const std::string& name);

}  // namespace etalon::io
