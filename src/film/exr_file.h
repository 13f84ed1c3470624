// Pictures as EXR files of one part with any channels, window and metadata. Who calls it:
// film_output.h and bench. It must not know films, routes or scenes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "film/image_io.h"

namespace nephroid {

/// Puts the channels of all pixels of row y of the window where `row` points. Called by any thread.
using FillRow = std::function<void(int y, float* row)>;

/// Writes a picture whose rows are made as they are written. Layers (channels of one name before
/// the last dot) of which `may_be_half` says so are written as 16-bit floats if all their values
/// fit: none above the largest one, and not all of them so small that they lose digits. Throws
/// IoError; see atomic_file.h for what then remains.
void write_exr(const std::string& path, const PictureHead& head,
               const std::vector<bool>& may_be_half, const FillRow& fill);

/// Writes a picture in 32-bit floats.
void write_exr(const std::string& path, const Picture& picture);

/// The most that write_exr may hold, unless a few blocks of rows are more.
inline constexpr uint64_t kMaxEncoderBytes = uint64_t{64} << 20;
/// What write_exr holds at most while it writes a picture of this width and so many channels.
uint64_t encoder_bytes(int width, size_t channels);

}  // namespace nephroid
