#include "view/view_checkpoint.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "film/state_file.h"
#include "session/checkpoint/checkpoint.h"

namespace nephroid {

std::string ViewCheckpoint::write(LiveRender& live) {
  try {
    live.with_picture([this](const RenderAtRest& rest) { write(rest); });
  } catch (const UsageError& error) {
    return fmt::format("{} was not written: {}", output_, error.what());
  }
  if (is_edited_)
    return fmt::format("wrote {}; camera or settings were changed, so --resume cannot go on",
                       output_);
  return fmt::format("wrote {} and {}, with which --resume goes on", output_,
                     state_path_beside(output_));
}

void ViewCheckpoint::write(const RenderAtRest& rest) {
  const bool continues = generation_ ? *generation_ == rest.generation : rest.render.has_resumed();
  if (!continues) keep_files(output_);
  // Noted before the files are written: if that fails, the next attempt must not put what this one
  // has left in the place of the files that were kept.
  generation_ = rest.generation;
  is_edited_ = rest.is_edited;
  rest.render.save(output_, !rest.is_edited);
}

}  // namespace nephroid
