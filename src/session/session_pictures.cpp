// Writes the pictures of a session and their metadata.
#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>
#include <new>

#include "core/counted.h"
#include "core/errors.h"
#include "film/exr_file.h"
#include "film/film_output.h"
#include "session/checkpoint/film_metadata.h"
#include "session/render_session.h"
#include "session/report/choices_report.h"
#include "session/report/invalid_samples.h"

namespace nephroid {
namespace {

[[noreturn]] void lacks_memory(const std::string& path) {
  throw IoError(path + ": cannot write: there is not enough memory");
}

}  // namespace

void RenderSession::write_or_rescue(const std::string& path, bool with_state) {
  namespace fs = std::filesystem;
  try {
    write_exr_file(path, with_state);
  } catch (const IoError& error) {
    // A new directory, in which nobody else can have put a link.
    const std::string random_letters(6, 'X');  // replaced by mkdtemp
    std::string directory =
        (fs::path(options_.rescue_directory) / ("nephroid-" + random_letters)).string();
    const auto lost = [&] {
      return IoError(fmt::format(
          "{}; writing into '{}' failed, too: everything rendered since the last write is lost",
          error.what(), options_.rescue_directory));
    };
    if (options_.rescue_directory.empty() || ::mkdtemp(directory.data()) == nullptr) throw lost();
    const fs::path rescue = fs::path(directory) / fs::path(path).filename();
    try {
      write_exr_file(rescue.string(), with_state);
    } catch (const IoError&) {
      std::error_code ignored;
      fs::remove_all(directory, ignored);
      throw lost();
    }
    throw IoError(fmt::format("{}; the picture was written to {}", error.what(), rescue.string()));
  }
}

void RenderSession::write_last_picture(bool with_state) {
  write_or_rescue(options_.output, with_state);
  write_png();
}

void RenderSession::save(const std::string& path, bool with_state) {
  write_exr_file(path, with_state);
  write_preview(path, film_, options_.png_exposure);
}

void RenderSession::save_last(const std::string& path, bool with_state) {
  write_or_rescue(path, with_state);
  write_preview(path, film_, options_.png_exposure);
}

void RenderSession::write_picture() {
  write_exr_file(options_.output, true);
  write_png();
}

void RenderSession::write_png() {
  keep_previous();
  try {
    write_preview(options_.output, film_, options_.png_exposure);
  } catch (const std::bad_alloc&) {
    lacks_memory(png_path_beside(options_.output));
  }
}

void RenderSession::write_exr_file(const std::string& path, bool with_state) {
  renew_error_text();
  const Metadata metadata = state_metadata();
  const std::string state_path = state_path_beside(path);
  if (path == options_.output) keep_previous();
  try {
    // The state comes first: the picture can be made from it, but not the reverse.
    if (with_state)
      write_state(state_path,
                  {{film_.settings().width, film_.settings().height}, film_.bounds(), metadata},
                  state_of(scene_, set_, film_));
    write_film_exr(path, film_, picture_metadata_of(metadata), options_.layer_precision);
  } catch (const std::bad_alloc&) {
    lacks_memory(path);
  }
  // Removes the state of an intermediate picture of this render.
  std::error_code ignored;
  if (!with_state) std::filesystem::remove(state_path, ignored);
}

void RenderSession::keep_previous() {
  const Checkpoint& before = options_.begin_with;
  if (has_written_ || !before.passes.empty() || before.open_pass) return;
  keep_files(options_.output);
  has_written_ = true;
}

std::string RenderSession::report() {
  renew_error_text();
  return choices_text();
}

/// Choices of the program and faults of the picture, one per line.
std::string RenderSession::choices_text() const {
  std::string choices;
  for (const std::string& line :
       choices_report(first_pass_statistics_, statistics(), passes_of_run()))
    choices += line + "\n";
  if (film_.has_open_pass() && passes_done_ == 0)
    choices += "note: the first pass is not whole: " + text_of_unreached_pixels(film_) + "\n";
  for (const std::string& note : options_.notes) choices += "note: " + note + "\n";
  if (error_text_) choices += *error_text_ + "\n";
  for (const std::string& fault : invalid_samples(scene_, film_))
    choices += "warning: " + fault + "\n";
  return choices;
}

Metadata RenderSession::state_metadata() const {
  // Without new passes the earlier metadata stay as they are.
  const Checkpoint& before = options_.begin_with;
  RenderIdentity identity = options_.identity;
  identity.set_film(film_, options_.seed);
  identity.instruction_sets = joined_instruction_sets(
      before.instruction_sets, has_begun_pass_ ? identity.instruction_sets : std::string());
  Metadata metadata = identity.to_metadata();
  add_film_metadata(film_, passes_add_up(set_, film_), &metadata);
  Checkpoint progress;
  progress.passes = done_;
  if (film_.has_open_pass()) progress.open_pass = open_pass_;
  progress.seconds = has_begun_pass_ ? seconds_of_all_runs() : before.seconds;
  progress.history = before.history;
  if (has_begun_pass_)
    progress.history +=
        fmt::format("{}{} in {:.3f} s\n", counted(passes_of_run(), "pass", "passes"),
                    film_.has_open_pass() ? " and a part of one" : "", elapsed());
  add_progress(progress, &metadata);
  metadata.emplace_back(kChoicesKey, has_begun_pass_ ? choices_text() : before.choices);
  add_estimates(film_, &metadata);
  return metadata;
}

}  // namespace nephroid
