// Writes the picture and state of a view with -o. It must not know when.
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
  /// could go on from it. Files from before the view are kept under another name for good; files
  /// of the view's own earlier renders are, if no older ones are. Returns what was done, or why
  /// nothing was. Throws IoError.
  std::string write(LiveRender& live);
  /// The same at the end of the view: what cannot be written there is rescued
  /// (RenderSession::save_last).
  std::string write_last(LiveRender& live);

 private:
  using Save = void (Render::*)(const std::string&, bool);
  std::string write(LiveRender& live, Save save);
  void write(const RenderAtRest& rest, Save save);

  std::string output_;
  std::optional<uint64_t> generation_;  ///< last one that was written
  bool is_edited_ = false;              ///< the last one that was written
  bool has_older_work_ = false;         ///< files from before the view
  bool keeps_older_work_ = false;       ///< they have another name
};

}  // namespace nephroid
