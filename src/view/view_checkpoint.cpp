#include "view/view_checkpoint.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/errors.h"
#include "film/state_file.h"
#include "session/checkpoint/checkpoint.h"

namespace nephroid {

std::string ViewCheckpoint::write(LiveRender& live) {
  return write(live, &Render::save);
}

std::string ViewCheckpoint::write_last(LiveRender& live) {
  return write(live, &Render::save_last);
}

std::string ViewCheckpoint::write(LiveRender& live, Save save) {
  try {
    live.with_picture([&](const RenderAtRest& rest) { write(rest, save); });
  } catch (const UsageError& error) {
    return fmt::format("{} was not written: {}", output_, error.what());
  }
  if (is_edited_)
    return fmt::format("wrote {}; camera or settings were changed, so --resume cannot go on",
                       output_);
  return fmt::format("wrote {} and {}, with which --resume goes on", output_,
                     state_path_beside(output_));
}

void ViewCheckpoint::write(const RenderAtRest& rest, Save save) {
  const bool continues = generation_ ? *generation_ == rest.generation : rest.render.has_resumed();
  if (!generation_) has_older_work_ = std::filesystem::exists(output_);
  if (!continues && !keeps_older_work_) {
    keep_files(output_);
    keeps_older_work_ = has_older_work_;
  }
  // Noted before the files are written: if that fails, the next attempt must not put what this one
  // has left in the place of the files that were kept.
  generation_ = rest.generation;
  is_edited_ = rest.is_edited;
  (rest.render.*save)(output_, !rest.is_edited);
}

}  // namespace nephroid
