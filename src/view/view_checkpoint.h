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
  /// could go on from it. Files of other renders, also of those before an edit, a restart or a
  /// change of the scene, are kept under another name. Returns what was done, or why nothing was.
  /// Throws IoError.
  std::string write(LiveRender& live);

 private:
  void write(const RenderAtRest& rest);

  std::string output_;
  std::optional<uint64_t> generation_;  ///< of the render that its files are of
  bool is_edited_ = false;              ///< of the same
};

}  // namespace nephroid
