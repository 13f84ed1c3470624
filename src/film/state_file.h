// The state of a render as a file of its own beside the picture: all that it needs to go on, or to
// be added to the passes of others. Sections of compressed blocks, and at the end an index with a
// checksum of each. Who calls it: the session and merge. It must not know what the state means.
#pragma once

#include <memory>
#include <string>

#include "film/image_io.h"
#include "film/render_state.h"

namespace nephroid {

/// "a/b.exr" -> "a/b.state"; the name of a state is its own.
std::string state_path_beside(const std::string& picture_path);

/// What a state file says beside the state.
struct StateHead {
  Vec2i resolution{0, 0};  ///< of the full picture
  PixelBounds window;      ///< pixels of it that there are
  Metadata metadata;
};

/// Writes the state. Takes some 10 MB whatever its size. Throws IoError; see atomic_file.h for what
/// then remains.
void write_state(const std::string& path, const StateHead& head, const RenderState& state);

/// A state that write_state wrote. All throw IoError, which names the file.
class StateFile {
 public:
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
  /// Reads all arrays and streams, each of which must be in the file with the size that it has
  /// here, and be whole.
  void load(const RenderState& state);

 private:
  struct Input;
  std::unique_ptr<Input> input_;
};

}  // namespace nephroid
