// The loop over passes: pass, stop rules, progress, intermediate picture.
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
#include "film/exr_file.h"
#include "film/film_output.h"
#include "film/state_file.h"
#include "scene/scene.h"
#include "session/checkpoint/film_metadata.h"
#include "session/learn_lights.h"
#include "session/quick_look.h"
#include "session/report/choices_report.h"
#include "session/report/invalid_samples.h"
#include "session/report/lamp_report.h"
#include "session/report/noise.h"

namespace nephroid {
namespace {

/// Writing pictures and estimating the error for display wait this many times as long as they took
/// last time. So they cost less than 2 % of the time.
constexpr double kIdlePerWork = 50;
/// The same for pictures that a viewer is shown: those of the first seconds should come soon.
constexpr double kIdlePerFirstShow = 8, kIdlePerShow = 40, kSecondsOfFirstShows = 5;
/// The interval between these grows with the time so far, over this number, within limits.
constexpr double kShownPictures = 20, kMinShowInterval = 0.2, kMaxShowInterval = 5;  ///< seconds
constexpr double kErrorInterval = 1;       ///< least seconds between error estimates for progress
constexpr double kProgressInterval = 0.2;  ///< seconds between progress reports within a pass
constexpr double kShortestWait = 0.02;     ///< least seconds between two calls of look_in()
/// The variance of fewer passes is too uncertain for the noise target.
constexpr uint32_t kMinPassesForNoise = 4;

double steady_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

void check_fits(const EstimatorSet& set, const Film& film, const RenderOptions& options) {
  if (options.last_pass && *options.last_pass < options.first_pass)
    throw UsageError("--passes: the range ends before it begins, expected A..B with A <= B");
  if (options.first_pass > 0 && film.rejection() != nullptr)
    throw UsageError(fmt::format(
        "--passes {}..: each pass depends on those before it, because of --outliers reject; "
        "expected a range from 0",
        options.first_pass));
  const std::vector<PassRange>& before = options.begin_with.passes.ranges();
  const bool from_zero = before.empty() || (before.size() == 1 && before[0].first == 0);
  for (const auto& estimator : set.estimators) {
    const Capabilities capabilities = estimator->descriptor().capabilities;
    if (!from_zero && !capabilities.independent_passes)
      throw UsageError(
          fmt::format("--resume: the passes of this integrator depend on each other, and the "
                      "picture has passes {}, expected a picture whose passes begin at 0",
                      options.begin_with.passes.text()));
    if (options.first_pass > 0 && !capabilities.independent_passes)
      throw UsageError(
          fmt::format("--passes {}..: the passes of this integrator depend on each "
                      "other, expected a range from 0",
                      options.first_pass));
    if (options.noise_target > 0 && (capabilities.per_pixel_state || !capabilities.consistent))
      throw UsageError(
          "--noise: this integrator cannot estimate its error, expected --passes or --time");
  }
}

}  // namespace

RenderSession::RenderSession(const Scene& scene, EstimatorSet& set, Film& film,
                             RenderOptions options)
    : scene_(scene), set_(set), film_(film), options_(std::move(options)), clock_(steady_seconds) {
  check_fits(set_, film_, options_);
  done_ = options_.begin_with.passes;
  passes_before_ = passes_done_ = static_cast<uint32_t>(done_.count());
  open_pass_ = options_.begin_with.open_pass;
  if (options_.last_pass)
    passes_wanted_ = *options_.last_pass - options_.first_pass + 1;
  else if (!(options_.time_limit > 0) && !(options_.noise_target > 0))
    passes_wanted_ = std::max(1, scene_.samples_per_pixel);
  if (open_pass_ && !is_wanted(*open_pass_) && next_pass())
    throw UsageError(
        fmt::format("--resume: pass {} of the picture is incomplete, expected a range of --passes "
                    "that includes it",
                    *open_pass_));
  if (!options_.output.empty()) check_picture_can_be_written(options_.output);
}

void RenderSession::on_progress(std::function<void(const RenderProgress&)> callback) {
  progress_ = std::move(callback);
}
void RenderSession::on_picture(std::function<void(const ShownPicture&)> callback) {
  picture_ = std::move(callback);
}
void RenderSession::on_request(std::function<void()> callback) {
  request_ = std::move(callback);
}
void RenderSession::on_warning(std::function<void(const std::string&)> callback) {
  warning_ = std::move(callback);
}
void RenderSession::use_clock(std::function<double()> seconds) {
  clock_ = std::move(seconds);
}

RenderResult RenderSession::run(SignalFlags& signals) {
  start_ = clock_();
  next_preview_seconds_ = std::min(options_.first_preview, options_.preview_interval);
  next_checkpoint_seconds_ = options_.checkpoint_interval;
  RenderResult result;
  // The first preview must not depend on earlier renders of the scene.
  scene_.light_sampler->learn({});
  take_quick_look(signals);
  std::optional<StopReason> reason;
  if (options_.learns_lights && !learn_lights(scene_, signals, clock_))
    reason = StopReason::kSignal;
  if (!reason && !done_.empty() && (!open_pass_ || !is_wanted(*open_pass_))) {
    // Earlier runs may already have met a stop rule.
    if (options_.noise_target > 0 && error_check_is_due()) renew_error();
    reason = reason_to_stop(signals);
  }
  // Time may have ended the unfinished pass of an earlier run.
  if (!reason) reason = reason_to_end_pass(signals);
  while (!reason) {
    if (!render_one_pass(signals)) {
      reason = *reason_to_end_pass(signals);
      break;
    }
    if (passes_of_run() == 1) first_pass_statistics_ = statistics();
    if (error_check_is_due()) renew_error();
    reason = reason_to_stop(signals);
    report_progress(false);
    if (!reason) {
      write_if_due(signals);
      show_if_due();
    }
  }
  if (first_pass_statistics_.empty()) first_pass_statistics_ = statistics();

  result.reason = *reason;
  result.signal = *reason == StopReason::kSignal ? signals.stop.load() : 0;
  result.passes_done = passes_done_;
  result.has_unfinished_pass = film_.has_open_pass();
  result.passes_add_up = passes_add_up(set_, film_);
  result.passes_of_run = passes_of_run();
  result.seconds = elapsed();
  result.first_pass_statistics = first_pass_statistics_;
  result.statistics = statistics();
  const bool is_dropped = *reason == StopReason::kSignal && options_.output.empty();
  if (!is_dropped) report_errors(&result);
  // A signal may come before there is anything to write.
  result.has_picture = passes_done_ > 0 || film_.has_light();
  result.has_state = result.has_picture && (options_.keeps_state || *reason == StopReason::kSignal);
  if (!options_.output.empty() && result.has_picture) {
    write_last_picture(result.has_state);
  }
  if (picture_ && result.has_picture && !is_dropped)
    picture_({film_, elapsed(), passes_done_, true});
  return result;
}

void RenderSession::report_errors(RenderResult* result) {
  // The error is estimated now and then, so it may be that of an earlier pass.
  if ((options_.noise_target > 0 || shows_error()) && error_pass_ != passes_done_) renew_error();
  if (error_ && !is_black_) result->error = error_->total();
  renew_error_text();
  result->error_text = error_text_;
  result->faults = invalid_samples(scene_, film_);
}

std::optional<uint32_t> RenderSession::next_pass() const {
  if (open_pass_ && is_wanted(*open_pass_)) return open_pass_;
  const uint32_t pass = done_.first_missing(options_.first_pass);
  constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();  // --passes cannot name it
  return pass != kNone && is_wanted(pass) ? std::optional(pass) : std::nullopt;
}

bool RenderSession::is_wanted(uint32_t pass) const {
  return pass >= options_.first_pass && (!options_.last_pass || pass <= *options_.last_pass) &&
         (!passes_wanted_ || pass - options_.first_pass < *passes_wanted_);
}

bool RenderSession::render_one_pass(SignalFlags& signals) {
  const double begin = clock_();
  const PassKey key{options_.seed, *next_pass()};
  PassWatch watch(signals, clock_, [&] { look_in(signals, watch); });
  watch.wake_at(begin);
  open_pass_ = key.pass;
  has_begun_pass_ = true;
  time_of_pass_.begin(begin, progress_of_groups());
  try {
    set_.render_pass(key, scene_, film_, watch);
  } catch (const PassStopped&) {
    return false;
  }
  time_of_pass_.end(clock_());
  open_pass_.reset();
  film_.finish_pass();
  done_.add(key.pass);
  ++passes_done_;
  return true;
}

std::optional<StopReason> RenderSession::reason_to_end_pass(const SignalFlags& signals) const {
  if (signals.stop.load() != 0) return StopReason::kSignal;
  // A time limit waits until there is a picture to show.
  const bool has_light = film_.can_be_shown();
  if (has_light && is_past_time_limit()) return StopReason::kTime;
  return std::nullopt;
}

void RenderSession::look_in(SignalFlags& signals, PassWatch& watch) {
  if (reason_to_end_pass(signals)) throw PassStopped{};
  const bool can_write = film_.can_be_shown();
  if (can_write || request_) write_if_due(signals);
  watch.answer_writes(can_write || request_);
  if (can_write) show_if_due();
  if (progress_ && elapsed() >= next_progress_seconds_) {
    report_progress(true);
    next_progress_seconds_ = elapsed() + kProgressInterval;
  }
  double wake = progress_ ? next_progress_seconds_ : kInfinity;
  if (!options_.output.empty())
    wake = std::min({wake, next_preview_seconds_, next_checkpoint_seconds_});
  if (picture_) wake = std::min(wake, next_picture_seconds_);
  if (options_.time_limit > 0)
    wake = std::min(wake, options_.time_limit - options_.begin_with.seconds);
  watch.wake_at(start_ + std::max(wake, elapsed() + kShortestWait));
}

std::vector<EstimatorStatistics> RenderSession::statistics() const {
  return set_.statistics();
}

std::optional<StopReason> RenderSession::reason_to_stop(const SignalFlags& signals) const {
  if (!next_pass()) return StopReason::kPasses;
  if (options_.noise_target > 0 && error_pass_ == passes_done_ &&
      passes_done_ >= kMinPassesForNoise && error_ && error_->total() <= options_.noise_target)
    return StopReason::kNoise;
  if (is_past_time_limit()) return StopReason::kTime;
  if (signals.stop.load() != 0) return StopReason::kSignal;
  return std::nullopt;
}

/// With a noise target the checks are at fixed passes, about 6 % apart, so that the end of a render
/// does not depend on the clock. Without one the estimate is for display and follows the clock.
bool RenderSession::error_check_is_due() const {
  if (options_.noise_target > 0)
    return passes_done_ >= kMinPassesForNoise &&
           passes_done_ % std::max(1u, std::bit_floor(passes_done_) / 16) == 0;
  return shows_error() && elapsed() >= next_error_seconds_;
}

void RenderSession::renew_error() {
  const double begin = clock_();
  error_ = estimated_error(film_);
  is_black_ = is_black(film_);
  error_pass_ = passes_done_;
  const double cost = clock_() - begin;
  next_error_seconds_ = elapsed() + std::max(kErrorInterval, kIdlePerWork * cost);
}

void RenderSession::renew_error_text() {
  if (error_text_pass_ == passes_done_ && !open_pass_) return;
  error_text_pass_ = passes_done_;
  error_text_.reset();
  if (passes_done_ > 0 && is_black(film_)) {
    error_text_ = black_picture_report(statistics());
    return;
  }
  for (const auto& estimator : set_.estimators)
    if (!estimator->descriptor().capabilities.consistent) return;
  error_text_ = error_report(film_);
}

void RenderSession::write_if_due(SignalFlags& signals) {
  const bool asked = signals.write.exchange(false);
  if (asked && request_) request_();
  if (options_.output.empty()) return;
  if (asked || elapsed() >= next_checkpoint_seconds_) {
    next_checkpoint_seconds_ = write_now(options_.checkpoint_interval, [this] { write_picture(); });
    next_preview_seconds_ = elapsed() + options_.preview_interval;
  } else if (elapsed() >= next_preview_seconds_) {
    next_preview_seconds_ = write_now(options_.preview_interval, [this] { write_png(); });
  }
}

void RenderSession::take_quick_look(const SignalFlags& signals) {
  const bool is_seen = picture_ || !options_.output.empty();
  if (options_.quick_look_depth == 0 || !is_seen || !done_.empty() || open_pass_ ||
      !is_worth_a_quick_look(set_, film_.format()))
    return;
  const auto show_film = [&](const Film& film) {
    if (picture_) show({film, elapsed(), 0, false});
    if (options_.output.empty()) return;
    write_now(0, [&] {
      keep_previous();
      write_preview(options_.output, film, options_.png_exposure);
    });
  };
  nephroid::take_quick_look({.scene = scene_,
                             .max_depth = options_.quick_look_depth,
                             .seed = options_.seed,
                             .show = show_film},
                            signals, clock_);
}

void RenderSession::show(const ShownPicture& shown) {
  const double begin = clock_();
  picture_(shown);
  const double cost = clock_() - begin;
  const double interval =
      std::clamp(elapsed() / kShownPictures, kMinShowInterval, kMaxShowInterval);
  const double idle = elapsed() < kSecondsOfFirstShows ? kIdlePerFirstShow : kIdlePerShow;
  next_picture_seconds_ = elapsed() + std::max(interval, idle * cost);
}

void RenderSession::show_if_due() {
  if (picture_ && elapsed() >= next_picture_seconds_) show({film_, elapsed(), passes_done_, false});
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

}  // namespace nephroid
