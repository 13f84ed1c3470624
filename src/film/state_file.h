// The state of a render in the file of its picture, as exr_file.h writes it, read back. Who calls
// it: the session and merge. It must not know what the state means.
#pragma once

#include <memory>
#include <string>

#include "film/image_io.h"
#include "film/render_state.h"

namespace nephroid {

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
