// The loop of render_session.h on one page: pass, stop rules, progress, intermediate picture.
#include "session/render_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <utility>

#include "core/errors.h"
#include "film/atomic_file.h"
#include "film/exr_file.h"
#include "film/film_output.h"
#include "scene/scene.h"
#include "session/checkpoint/film_metadata.h"
#include "session/report/choices_report.h"
#include "session/report/invalid_samples.h"
#include "session/report/noise.h"

namespace nephroid {
namespace {

/// Work that is not rendering (writing, estimating the error for display) waits this many times as
/// long as it took last time, so that it costs less than 2 % of the time.
constexpr double kIdlePerWork = 50;
constexpr double kErrorInterval = 1;  ///< s between estimates for progress, at least
/// A spread of fewer passes says too little to stop on.
constexpr uint32_t kMinPassesForNoise = 4;

double steady_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

[[noreturn]] void lacks_memory(const std::string& path) {
  throw IoError(path + ": cannot write: there is not enough memory");
}

void check_fits(const EstimatorSet& set, const Film& film, const RenderOptions& options) {
  if (options.last_pass && *options.last_pass < options.first_pass)
    throw UsageError("--passes: the range ends before it begins");
  if (options.first_pass > 0 && film.rejection() != nullptr)
    throw UsageError(
        fmt::format("--passes {}..: with --outliers reject what a pass shows depends on the passes "
                    "before it, expected a range from 0",
                    options.first_pass));
  const std::vector<PassRange>& before = options.begin_with.passes.ranges();
  const bool from_zero = before.empty() || (before.size() == 1 && before[0].first == 0);
  for (const auto& estimator : set.estimators) {
    const Capabilities capabilities = estimator->descriptor().capabilities;
    if (!from_zero && !capabilities.independent_passes)
      throw UsageError(
          fmt::format("--resume: the passes of this integrator depend on each other, and the "
                      "picture has {}, expected a range from 0",
                      options.begin_with.passes.text()));
    if (options.first_pass > 0 && !capabilities.independent_passes)
      throw UsageError(
          fmt::format("--passes {}..: the passes of this integrator depend on each "
                      "other, expected a range from 0",
                      options.first_pass));
    if (options.noise_target > 0 && (capabilities.per_pixel_state || !capabilities.consistent))
      throw UsageError(
          "--noise: this integrator cannot tell how far off its picture is, expected --passes or "
          "--time");
  }
}

}  // namespace

RenderSession::RenderSession(const Scene& scene, EstimatorSet& set, Film& film,
                             RenderOptions options)
    : scene_(scene), set_(set), film_(film), options_(std::move(options)), clock_(steady_seconds) {
  check_fits(set_, film_, options_);
  done_ = options_.begin_with.passes;
  passes_before_ = passes_done_ = static_cast<uint32_t>(done_.count());
  last_pass_seconds_ = options_.begin_with.last_pass_seconds;
  if (options_.last_pass)
    passes_wanted_ = *options_.last_pass - options_.first_pass + 1;
  else if (!(options_.time_limit > 0) && !(options_.noise_target > 0))
    passes_wanted_ = std::max(1, scene_.samples_per_pixel);
  if (!options_.output.empty()) {
    check_file_can_be_written(options_.output);
    check_file_can_be_written(png_path_beside(options_.output));
  }
}

void RenderSession::on_progress(std::function<void(const RenderProgress&)> callback) {
  progress_ = std::move(callback);
}
void RenderSession::on_warning(std::function<void(const std::string&)> callback) {
  warning_ = std::move(callback);
}
void RenderSession::use_clock(std::function<double()> seconds) {
  clock_ = std::move(seconds);
}

RenderResult RenderSession::run(SignalFlags& signals) {
  start_ = clock_();
  error_text_pass_ = error_pass_ = 0;
  error_.reset();
  next_error_seconds_ = 0;
  next_preview_seconds_ = options_.preview_interval;
  next_checkpoint_seconds_ = options_.checkpoint_interval;
  RenderResult result;
  std::optional<StopReason> reason;
  if (!done_.empty()) {
    // It may have come as far as was wished for.
    if (options_.noise_target > 0 && error_check_is_due()) renew_error();
    reason = reason_to_stop(signals);
    if (reason) first_pass_statistics_ = statistics();
  }
  while (!reason) {
    render_one_pass();
    if (passes_of_run() == 1) first_pass_statistics_ = statistics();
    if (error_check_is_due()) renew_error();
    reason = reason_to_stop(signals);
    report_progress();
    if (!reason) write_if_due(signals);
  }

  result.reason = *reason;
  result.signal = *reason == StopReason::kSignal ? signals.stop.load() : 0;
  result.passes_done = passes_done_;
  result.passes_of_run = passes_of_run();
  result.seconds = elapsed();
  // What the clock let stand is of an earlier picture.
  if ((options_.noise_target > 0 || shows_error()) && error_pass_ != passes_done_) renew_error();
  if (error_) result.error = error_->total();
  result.first_pass_statistics = first_pass_statistics_;
  result.statistics = statistics();
  renew_error_text();
  result.error_text = error_text_;
  result.faults = invalid_samples(scene_, film_);
  if (!options_.output.empty())
    write_last_picture(options_.keeps_state || *reason == StopReason::kSignal);
  return result;
}

std::optional<uint32_t> RenderSession::next_pass() const {
  const uint32_t pass = done_.first_missing(options_.first_pass);
  constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();  // --passes cannot name it
  if (pass == kNone || (options_.last_pass && pass > *options_.last_pass) ||
      (passes_wanted_ && pass - options_.first_pass >= *passes_wanted_))
    return std::nullopt;
  return pass;
}

void RenderSession::render_one_pass() {
  const double begin = clock_();
  const PassKey key{options_.seed, *next_pass()};
  set_.render_pass(key, scene_, film_);
  film_.finish_pass();
  done_.add(key.pass);
  ++passes_done_;
  last_pass_seconds_ = clock_() - begin;
}

std::vector<EstimatorStatistics> RenderSession::statistics() const {
  return set_.statistics();
}

/// A pass that would end further behind the time limit than this one ends before it is not begun.
std::optional<StopReason> RenderSession::reason_to_stop(const SignalFlags& signals) const {
  if (!next_pass()) return StopReason::kPasses;
  if (options_.noise_target > 0 && error_pass_ == passes_done_ &&
      passes_done_ >= kMinPassesForNoise && error_ && error_->total() <= options_.noise_target)
    return StopReason::kNoise;
  if (options_.time_limit > 0 &&
      seconds_of_all_runs() + last_pass_seconds_ / 2 >= options_.time_limit)
    return StopReason::kTime;
  if (signals.stop.load() != 0) return StopReason::kSignal;
  return std::nullopt;
}

/// With a noise target the checks are at fixed passes, about 6 % apart, so that the clock has no
/// say in where the render stops. Without one the estimate is for display and follows the clock.
bool RenderSession::error_check_is_due() const {
  if (options_.noise_target > 0)
    return passes_done_ >= kMinPassesForNoise &&
           passes_done_ % std::max(1u, std::bit_floor(passes_done_) / 16) == 0;
  return shows_error() && elapsed() >= next_error_seconds_;
}

void RenderSession::renew_error() {
  const double begin = clock_();
  error_ = estimated_error(film_);
  error_pass_ = passes_done_;
  const double cost = clock_() - begin;
  next_error_seconds_ = elapsed() + std::max(kErrorInterval, kIdlePerWork * cost);
}

void RenderSession::renew_error_text() {
  if (error_text_pass_ == passes_done_) return;
  error_text_pass_ = passes_done_;
  error_text_.reset();
  for (const auto& estimator : set_.estimators)
    if (!estimator->descriptor().capabilities.consistent) return;
  error_text_ = error_report(film_);
}

/// A picture may have passes beyond the range that is wanted now.
uint32_t RenderSession::passes_done_of_wanted() const {
  if (!passes_wanted_) return passes_done_;
  const uint32_t last = options_.first_pass + (*passes_wanted_ - 1);
  return static_cast<uint32_t>(done_.count({options_.first_pass, last}));
}

std::optional<double> RenderSession::seconds_left(double seconds) const {
  std::optional<double> left;
  const auto at_most = [&](double candidate) {
    left = std::max(0.0, left ? std::min(*left, candidate) : candidate);
  };
  const double per_pass = seconds / passes_of_run();
  if (passes_wanted_)
    at_most(per_pass * (static_cast<double>(*passes_wanted_) - passes_done_of_wanted()));
  if (options_.time_limit > 0) at_most(options_.time_limit - options_.begin_with.seconds - seconds);
  if (options_.noise_target > 0 && error_ && error_->total() > 0)
    at_most(per_pass * (error_pass_ * passes_to(*error_, options_.noise_target) - passes_done_));
  return left;
}

void RenderSession::report_progress() {
  if (!progress_) return;
  RenderProgress progress;
  progress.passes_done = passes_done_of_wanted();
  progress.passes_wanted = passes_wanted_;
  progress.seconds = elapsed();
  progress.seconds_left = seconds_left(progress.seconds);
  if (error_) progress.error = error_->total();
  if (progress.seconds_left) {
    const double total = progress.seconds + *progress.seconds_left;
    progress.fraction = total > 0 ? progress.seconds / total : 1;
  }
  for (const EstimatorStatistics& s : statistics()) {
    progress.rays += s.rays;
    progress.photons_stored += s.photons_stored;
  }
  progress_(progress);
}

void RenderSession::write_if_due(SignalFlags& signals) {
  const bool asked = signals.write.exchange(false);
  if (options_.output.empty()) return;
  if (asked || elapsed() >= next_checkpoint_seconds_) {
    next_checkpoint_seconds_ = write_now(options_.checkpoint_interval, [this] { write_picture(); });
    next_preview_seconds_ = elapsed() + options_.preview_interval;
  } else if (elapsed() >= next_preview_seconds_) {
    next_preview_seconds_ = write_now(options_.preview_interval, [this] { write_png(); });
  }
}

double RenderSession::write_now(double interval, const std::function<void()>& write) {
  const double begin = clock_();
  try {
    write();
  } catch (const IoError& error) {
    if (warning_) warning_(std::string(error.what()) + " (rendering goes on)");
  }
  const double cost = clock_() - begin;
  return elapsed() + std::max(interval, kIdlePerWork * cost);
}

void RenderSession::write_last_picture(bool with_state) {
  namespace fs = std::filesystem;
  try {
    write_exr_file(options_.output, with_state);
  } catch (const IoError& error) {
    // A directory of its own: nobody else can have put a link there.
    const std::string random_letters(6, 'X');  // that mkdtemp puts in their place
    std::string directory =
        (fs::path(options_.rescue_directory) / ("nephroid-" + random_letters)).string();
    const auto lost = [&] {
      return IoError(
          fmt::format("{}; nor into '{}': what was rendered since it was last written is lost",
                      error.what(), options_.rescue_directory));
    };
    if (options_.rescue_directory.empty() || ::mkdtemp(directory.data()) == nullptr) throw lost();
    const fs::path rescue = fs::path(directory) / fs::path(options_.output).filename();
    try {
      write_exr_file(rescue.string(), with_state);
    } catch (const IoError&) {
      std::error_code ignored;
      fs::remove_all(directory, ignored);
      throw lost();
    }
    throw IoError(fmt::format("{}; the picture is in {}", error.what(), rescue.string()));
  }
  write_png();
}

void RenderSession::write_picture() {
  write_exr_file(options_.output, true);
  write_png();
}

void RenderSession::write_png() {
  try {
    write_preview(options_.output, film_, options_.png_exposure);
  } catch (const std::bad_alloc&) {
    lacks_memory(png_path_beside(options_.output));
  }
}

void RenderSession::write_exr_file(const std::string& path, bool with_state) {
  renew_error_text();
  std::optional<RenderState> state;
  if (with_state) state = state_of(scene_, set_, film_);
  try {
    write_exr(path, film_picture(film_, picture_metadata()), state ? &*state : nullptr);
  } catch (const std::bad_alloc&) {
    lacks_memory(path);
  }
}

/// What the program chose, and what is wrong with the picture, a line each.
std::string RenderSession::choices_text() const {
  std::string choices;
  for (const std::string& line :
       choices_report(first_pass_statistics_, statistics(), passes_of_run()))
    choices += line + "\n";
  for (const std::string& note : options_.notes) choices += "note: " + note + "\n";
  if (error_text_) choices += *error_text_ + "\n";
  for (const std::string& fault : invalid_samples(scene_, film_))
    choices += "warning: " + fault + "\n";
  return choices;
}

Metadata RenderSession::picture_metadata() const {
  // Who renders nothing more has nothing to say that the picture does not say already.
  const bool rendered = passes_of_run() > 0;
  const Checkpoint& before = options_.begin_with;
  RenderIdentity identity = options_.identity;
  identity.set_film(film_, options_.seed);
  identity.instruction_sets = joined_instruction_sets(
      before.instruction_sets, rendered ? identity.instruction_sets : std::string());
  Metadata metadata = identity.to_metadata();
  add_film_metadata(film_, passes_are_independent(set_), &metadata);
  Checkpoint progress;
  progress.passes = done_;
  progress.seconds = seconds_of_all_runs();
  progress.last_pass_seconds = last_pass_seconds_;
  progress.history = before.history;
  if (rendered)
    progress.history += fmt::format("{} passes in {:.3f} s\n", passes_of_run(), elapsed());
  add_progress(progress, &metadata);
  metadata.emplace_back(kChoicesKey, rendered ? choices_text() : before.choices);
  add_estimates(film_, &metadata);
  return metadata;
}

}  // namespace nephroid
