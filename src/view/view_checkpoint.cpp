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
  if (*was_edited_)
    return fmt::format("wrote {}; camera or settings were changed, so --resume cannot go on",
                       output_);
  return fmt::format("wrote {} and {}, with which --resume goes on", output_,
                     state_path_beside(output_));
}

void ViewCheckpoint::write(const RenderAtRest& rest) {
  const bool continues = was_edited_ ? *was_edited_ == rest.is_edited : rest.render.has_resumed();
  if (!continues) keep_files(output_);
  rest.render.save(output_, !rest.is_edited);
  was_edited_ = rest.is_edited;
}

}  // namespace nephroid
