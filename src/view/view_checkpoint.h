// The picture and state that a view leaves in its output file. It must not know when.
#pragma once

#include <optional>
#include <string>

#include "view/live_render.h"

namespace nephroid {

class ViewCheckpoint {
 public:
  /// `output` is an EXR.
  explicit ViewCheckpoint(std::string output) : output_(std::move(output)) {}

  /// Writes the picture, with its state unless camera or settings were edited: no other render
  /// could go on from it. Files of other renders are kept under another name. Returns what was
  /// done, or why nothing was. Throws IoError.
  std::string write(LiveRender& live);

 private:
  void write(const RenderAtRest& rest);

  std::string output_;
  std::optional<bool> was_edited_;  ///< of the files that it has written
};

}  // namespace nephroid
