// Pictures as EXR files of any channels, with window and metadata; and with the state of the render
// behind them, from which it can go on. Each array of the state is a part of the file with UINT
// channels; the picture is the first part, as a viewer expects it. Its .cpp is where the
// layer meets OpenEXR. Who calls it: film_output.h
// and the session. It must not know films, routes or scenes.
#pragma once

#include <memory>
#include <string>

#include "film/image_io.h"
#include "film/render_state.h"

namespace nephroid {

/// Writes a float EXR with display window and data window, and the state, if there is one, in
/// further parts. Throws IoError; see atomic_file.h for what then remains.
void write_exr(const std::string& path, const Picture& picture, const RenderState* state = nullptr);

/// The most that the encoder may hold, unless a single buffer of rows is larger: then it has one.
inline constexpr uint64_t kMostEncoderBytes = uint64_t{64} << 20;
/// What it holds while it writes a picture of this width and so many channels, with a state of so
/// many words in a pixel, all parts together.
uint64_t encoder_bytes(int width, size_t channels, size_t state_words);

/// The state in a picture's file. All throw IoError, which names the file.
class StateFile {
 public:
  /// Opens a file of write_exr.
  explicit StateFile(const std::string& path);
  ~StateFile();
  StateFile(StateFile&&) noexcept;
  StateFile& operator=(StateFile&&) noexcept;

  /// Of the picture.
  const Metadata& metadata() const { return metadata_; }
  const std::string& path() const;
  /// Width and height of the full picture, and the pixels of it that there are.
  Vec2i resolution() const;
  PixelBounds window() const;
  /// Bytes of the file.
  uint64_t size() const;
  bool has_state() const;
  /// Reads all arrays and streams, each of which must be in the file with the size that it has
  /// here, and be whole.
  void load(const RenderState& state);

 private:
  struct Input;
  std::unique_ptr<Input> input_;
  Metadata metadata_;
};

}  // namespace nephroid
