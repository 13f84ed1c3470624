// Writes single-part EXR files with arbitrary channels, data window and metadata. It must not know
// films, routes or scenes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "film/image_io.h"

namespace nephroid {

/// Writes all pixels of row y of the window, interleaved, to `row`. Called by any thread.
using FillRow = std::function<void(int y, float* row)>;

/// Writes a picture whose rows are computed on demand. A layer is all channels with the same name
/// before the last dot. Channels with `may_be_half` are written as 16-bit floats if the values of
/// their layer fit: none above 65504, and the largest not below 6e-5. Throws IoError; the old file
/// then remains (atomic_file.h).
void write_exr(const std::string& path, const PictureHead& head,
               const std::vector<bool>& may_be_half, const FillRow& fill);

/// Writes a picture in 32-bit floats.
void write_exr(const std::string& path, const Picture& picture);

/// Bytes that write_exr may hold; more only where a few blocks of rows need more. Wide pictures
/// have large blocks and are written by fewer threads.
inline constexpr uint64_t kMaxEncoderBytes = uint64_t{384} << 20;
/// Upper bound of write_exr's memory in bytes, for a picture of this width and number of channels.
uint64_t encoder_bytes(int width, size_t channels);

}  // namespace nephroid
