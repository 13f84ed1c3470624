// The loop over passes: decides when to stop, to write and to report. The only place with a clock:
// time decides the number of passes, never the result of a pass. It must not know how estimators
// work.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "film/film_output.h"
#include "film/image_io.h"
#include "integrator/presets/estimator_set.h"
#include "session/checkpoint/checkpoint.h"
#include "session/pass_time_estimate.h"
#include "session/pass_watch.h"
#include "session/report/noise.h"
#include "session/signals.h"
#include "session/stop_reason.h"

namespace nephroid {

/// Stop rules and output of a render. The first rule that is met stops it. Without a last pass, a
/// time limit or a noise target, the number of passes is the scene's pixel samples.
struct RenderOptions {
  uint32_t first_pass = 0;
  std::optional<uint32_t> last_pass;  ///< last pass, included; empty: no limit
  double time_limit = 0;              ///< seconds; 0: none
  double noise_target = 0;            ///< limit of estimated_error().total(); 0: none
  bool show_error = true;             ///< true: progress has the error, which takes a little time
  uint64_t seed = 0;
  std::string output;               ///< EXR, with a PNG beside it; empty: nothing is written
  std::string rescue_directory;     ///< used if the last picture cannot be written; empty: none
  double first_preview = 0.5;       ///< seconds until the first intermediate PNG, if there is light
  double preview_interval = 5;      ///< least seconds between intermediate PNGs
  double checkpoint_interval = 60;  ///< least seconds between intermediate EXRs
  bool keeps_state = true;          ///< true: the last picture keeps its state
  LayerPrecision layer_precision = LayerPrecision::kHalf;
  Checkpoint begin_with;  ///< progress that film and estimators already hold
  float png_exposure = 1;
  /// Whether the render begins with a survey of which lights reach which places
  /// (transport/light_survey.h), which its scene's light sampler keeps until the next render.
  bool learns_lights = true;
  /// Path depth of the quick look before the first pass (quick_look.h); 0: none.
  int quick_look_depth = 0;
  std::vector<std::string> notes;  ///< notes on choices, for the picture's metadata
  RenderIdentity identity;         ///< for the picture's metadata; the session sets film and seed
};

/// The progress of a render, after a pass or within one.
struct RenderProgress {
  uint32_t passes_done = 0;               ///< whole passes
  bool within_pass = false;               ///< called while a pass is rendered
  std::optional<uint32_t> passes_wanted;  ///< empty if only time or error stop it
  double seconds = 0;
  std::optional<double> seconds_left;  ///< estimate, by the rule that will be met first
  std::optional<double> error;         ///< the last estimate, updated now and then
  double fraction = 0;  ///< fraction of the render that is done, 0..1; the last one if unknown
  uint64_t rays = 0;
  uint64_t photons_stored = 0;
};

struct RenderResult {
  StopReason reason = StopReason::kPasses;
  int signal = 0;                    ///< signal that stopped it, 0 if none
  uint32_t passes_done = 0;          ///< whole passes of all runs
  bool has_unfinished_pass = false;  ///< some pixels have estimates of one more pass
  bool passes_add_up = true;         ///< merge takes whole passes of the picture
  bool has_picture = false;          ///< there is light to show; else nothing was written
  bool has_state = false;            ///< the picture has its state beside it
  uint32_t passes_of_run = 0;        ///< whole passes of this run
  double seconds = 0;  ///< time of this run with intermediate pictures, without the last one
  std::optional<double> error;  ///< estimated_error().total(); empty for a black picture
  /// error_report(), if all estimators are consistent; black_picture_report() for a black picture.
  std::optional<std::string> error_text;
  std::vector<std::string> faults;  ///< invalid_samples()
  /// Statistics of the estimators after the first pass (initial radii) and after the last one.
  std::vector<EstimatorStatistics> first_pass_statistics, statistics;
};

/// A picture on its way to a viewer.
struct ShownPicture {
  const Film& film;
  double seconds = 0;   ///< time of this run
  uint32_t passes = 0;  ///< whole passes; 0 also for a quick look
  bool is_last = false;
};

class RenderSession {
 public:
  /// Keeps references to scene, set and film. The film has the set's layout. Throws UsageError if
  /// the options do not fit the estimators, IoError if the output cannot be written.
  RenderSession(const Scene& scene, EstimatorSet& set, Film& film, RenderOptions options);

  /// Called after every pass, and a few times a second within passes.
  void on_progress(std::function<void(const RenderProgress&)> callback);
  /// Called with the picture as soon as there is one, then a few times a second and less often as
  /// it changes less, and at the end unless a signal stopped the render.
  void on_picture(std::function<void(const ShownPicture&)> callback);
  /// Called soon after a request to write (SignalFlags::write), while no pixel is rendered: the
  /// film may be read. Without an output file this is all that the request does.
  void on_request(std::function<void()> callback);
  /// Called when an intermediate picture cannot be written; rendering goes on.
  void on_warning(std::function<void(const std::string&)> callback);
  /// Seconds from any origin; the machine's steady clock unless set. Called by any thread.
  void use_clock(std::function<double()> seconds);

  /// Renders until a rule or a signal stops it, and writes the picture. Called once. Throws IoError
  /// if the last picture cannot be written; the message has the place of the rescued picture, if
  /// there is one.
  RenderResult run(SignalFlags& signals);

  /// Writes what is rendered so far, with its PNG. Called after run() or from a callback. Throws
  /// IoError.
  void save(const std::string& path, bool with_state);
  /// The same for a picture that would be lost: if it cannot be written there, it is written into
  /// the rescue directory, and the error says so.
  void save_last(const std::string& path, bool with_state);
  /// Choices of the program, errors and faults of the picture so far, one a line.
  std::string report();

 private:
  std::optional<StopReason> reason_to_stop(const SignalFlags& signals) const;
  double elapsed() const { return clock_() - start_; }
  double seconds_of_all_runs() const { return options_.begin_with.seconds + elapsed(); }
  bool is_past_time_limit() const {
    return options_.time_limit > 0 && seconds_of_all_runs() >= options_.time_limit;
  }
  std::optional<uint32_t> next_pass() const;
  /// True if a pass is in the wanted range.
  bool is_wanted(uint32_t pass) const;
  uint32_t passes_of_run() const { return passes_done_ - passes_before_; }
  bool shows_error() const { return progress_ && options_.show_error; }
  bool error_check_is_due() const;
  /// False if the pass was stopped before its end.
  bool render_one_pass(SignalFlags& signals);
  /// Called within a pass. Throws PassStopped to end it.
  void look_in(SignalFlags& signals, PassWatch& watch);
  /// The reason to stop within a pass.
  std::optional<StopReason> reason_to_end_pass(const SignalFlags& signals) const;
  /// Progress of each group of estimates in the unfinished pass, 0..1.
  std::vector<double> progress_of_groups() const;
  std::vector<EstimatorStatistics> statistics() const;
  /// Error, its text and faults of the result.
  void report_errors(RenderResult* result);
  void renew_error();
  /// Updates error_text_ to the passes so far.
  void renew_error_text();
  void report_progress(bool within_pass);
  /// Answers requests to write.
  void write_if_due(SignalFlags& signals);
  /// Calls the picture's callback and sets the time of the next call.
  void show(const ShownPicture& shown);
  void show_if_due();
  /// Shows a quick look if a picture is wanted and there is none yet.
  void take_quick_look(const SignalFlags& signals);
  void write_picture();
  /// Writes the picture without its PNG. Writes its state too, or else removes that of an
  /// intermediate picture.
  void write_exr_file(const std::string& path, bool with_state);
  /// Called before the first write: renames the files of another render (files_to_keep()).
  void keep_previous();
  void write_png();
  void write_last_picture(bool with_state);
  void write_or_rescue(const std::string& path, bool with_state);
  /// Writes, warns of errors, and returns the time of the next write.
  double write_now(double interval, const std::function<void()>& write);
  uint32_t passes_done_of_wanted() const;
  std::optional<double> seconds_left() const;
  std::string choices_text() const;
  Metadata state_metadata() const;

  const Scene& scene_;
  EstimatorSet& set_;
  Film& film_;
  RenderOptions options_;
  std::optional<uint32_t> passes_wanted_;
  std::function<void(const RenderProgress&)> progress_;
  std::function<void(const ShownPicture&)> picture_;
  std::function<void()> request_;
  std::function<void(const std::string&)> warning_;
  std::function<double()> clock_;

  double start_ = 0;
  std::vector<EstimatorStatistics> first_pass_statistics_;
  PassRanges done_;
  uint32_t passes_before_ = 0, passes_done_ = 0;  ///< passes before this run, and in all runs
  std::optional<uint32_t> open_pass_;             ///< unfinished pass
  PassTimeEstimate time_of_pass_;
  double fraction_ = 0;  ///< the last RenderProgress::fraction
  std::optional<EstimatedError> error_;
  bool is_black_ = false;    ///< true: error_ is 0 and not reported
  uint32_t error_pass_ = 0;  ///< passes done when error_ was estimated
  /// error_report(); empty if an estimator knows only a part of its error.
  std::optional<std::string> error_text_;
  uint32_t error_text_pass_ = 0;   ///< passes done when error_text_ was made
  double next_error_seconds_ = 0;  ///< next error estimate for progress
  double next_preview_seconds_ = 0, next_checkpoint_seconds_ = 0;
  double next_picture_seconds_ = 0;   ///< next call of picture_
  double next_progress_seconds_ = 0;  ///< next progress report within a pass
  bool has_begun_pass_ = false;       ///< this run has added to a pass
  bool has_written_ = false;          ///< true after the first picture or PNG
};

}  // namespace nephroid
