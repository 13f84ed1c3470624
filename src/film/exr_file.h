// Pictures as EXR files of any channels, with window and metadata; and with the state of the render
// behind them, from which it can go on. Each array of the state is a part of the file with UINT
// channels; the picture is the first part, as a viewer expects it. Who calls it: film_output.h and
// the session; state_file.h reads what it writes. It must not know films, routes or scenes.
#pragma once

#include <cstdint>
#include <string>

#include "film/image_io.h"
#include "film/render_state.h"

namespace nephroid {

/// Writes a float EXR with display window and data window, and the state, if there is one, in
/// further parts. Throws IoError; see atomic_file.h for what then remains.
void write_exr(const std::string& path, const Picture& picture, const RenderState* state = nullptr);

/// The most that the encoder may hold, unless a single buffer of rows is larger: then it has one.
inline constexpr uint64_t kMaxEncoderBytes = uint64_t{64} << 20;
/// What it holds while it writes a picture of this width and so many channels, with a state of so
/// many words in a pixel, all parts together.
uint64_t encoder_bytes(int width, size_t channels, size_t state_words);

}  // namespace nephroid
