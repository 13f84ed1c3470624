// Writes and reads state files: everything a render needs to resume or to be merged. A file has
// sections of compressed blocks, and at the end an index with a checksum for each section. It must
// not know what the state means.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "film/image_io.h"
#include "film/render_state.h"

namespace nephroid {

/// "a/b.exr" -> "a/b.state"; the name of a state file stays.
std::string state_path_beside(const std::string& picture_path);

/// Description of the picture that a state belongs to.
struct StateHead {
  Vec2i resolution{0, 0};  ///< full picture, in pixels
  PixelBounds window;      ///< rendered part
  Metadata metadata;
};

/// Writes the state with about 10 MB of buffers, whatever its size. Throws IoError; the old file
/// then remains (atomic_file.h).
void write_state(const std::string& path, const StateHead& head, const RenderState& state);

/// Reads a file of write_state. All functions throw IoError with the file's name.
class StateFile {
 public:
  /// True if the file begins like a state, of any version.
  static bool is_state(const std::string& path);
  /// Reads the index.
  explicit StateFile(const std::string& path);
  ~StateFile();
  StateFile(StateFile&&) noexcept;
  StateFile& operator=(StateFile&&) noexcept;

  const std::string& path() const;
  const Metadata& metadata() const;
  Vec2i resolution() const;
  PixelBounds window() const;
  /// Bytes of the file.
  uint64_t size() const;
  /// Reads all arrays and streams. Each must be in the file, undamaged and with the size it has
  /// here. Optional streams may be missing. Returns an error, with the file's name, for each
  /// optional stream that cannot be read.
  std::vector<std::string> load(const RenderState& state);
  /// The same for the streams of `state` alone. The file's arrays are not read.
  std::vector<std::string> load_streams(const RenderState& state);
  /// True if the file has a section of that name that is not empty.
  bool has_words(const std::string& section) const;

 private:
  struct Input;
  std::unique_ptr<Input> input_;
};

}  // namespace nephroid
