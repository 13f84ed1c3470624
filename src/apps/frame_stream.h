// Writes a render to a pipe as frames, for a parent process that shows it: pictures, progress and
// messages. docs/stream.md has the format. It must not know how a picture is rendered.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "session/render_session.h"
#include "session/signals.h"

namespace nephroid {

class FrameStream {
 public:
  /// Writes to a file descriptor. If its reader has gone, `signals` gets a request to stop; after
  /// any such request nothing more is written.
  FrameStream(int descriptor, SignalFlags& signals) : descriptor_(descriptor), signals_(signals) {}
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  /// The layers of the film that have one of the names.
  void picture(const ShownPicture& shown, const std::vector<std::string>& layers);
  void progress(const RenderProgress& progress);
  /// A text; its kind is "note", "warning" or "error".
  void message(const std::string& kind, const std::string& text);
  /// The last frame of a render that no signal stopped; `report` is the text for the user.
  void end(const RenderResult& result, const std::string& report);

 private:
  /// Writes a frame. False if it was given up.
  bool write_frame(const std::string& header, std::span<const std::byte> payload = {});
  bool write_all(std::span<const std::byte> bytes);

  int descriptor_;
  SignalFlags& signals_;
};

}  // namespace nephroid
