// The layout of a state in a picture's file: names of parts and channels, windows of streams, and
// frames over memory. Only exr_file.cpp and state_file.cpp include it, since it has OpenEXR's
// types. It must not know what a state means.
#pragma once

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "film/film.h"

namespace nephroid {

inline constexpr const char* kPartPrefix = "state.";
/// The last part: two words for each other one, by which damage is seen.
inline constexpr const char* kChecksums = "checksums";
/// In that part's header: hash_of_texts of the picture. Times differ from run to run, what is in
/// the parts does not. The key names the hash: a state without it is of an earlier build, and is
/// not taken for a damaged one.
inline constexpr const char* kTextsKey = "nephroid:texts.xxh3";
/// How many words of a part are used.
inline constexpr const char* kWordsKey = "nephroid:words";

/// Sums are noise below and nearly nothing above, of which run lengths find all that there is.
inline constexpr Imf::Compression kStateCompression = Imf::RLE_COMPRESSION;
/// True for headers of rows of words in that compression, and so of all parts of states.
bool is_of_state(const Imf::Header& header);

/// Items of a part, or of the picture, as they lie in memory: `channels` 32-bit numbers together.
Imf::FrameBuffer frame_of(const PixelBounds& window, const std::vector<std::string>& channels,
                          Imf::PixelType type, const void* memory);

/// The pixels, of a word each, of what is not of pixels.
PixelBounds window_of_stream(size_t words);

std::vector<std::string> channels_of_words(size_t words);

/// A checksum as two words, the lower one first.
std::array<uint32_t, 2> words_of_hash(uint64_t hash);

/// Of all texts in a header, which say what the picture is; in hexadecimal digits.
std::string hash_of_texts(const Imf::Header& header);

}  // namespace nephroid
