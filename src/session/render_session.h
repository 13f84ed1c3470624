// The loop over passes: when to stop, when to write, what to say. The only place with a clock, and
// no pixel depends on it: time decides how many passes there are, never what a pass computes. It
// must not know how an estimator makes light.
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
#include "session/pass_watch.h"
#include "session/report/noise.h"
#include "session/signals.h"

namespace nephroid {

/// What to render. The rules combine and the first met stops; without a last pass, a time limit or
/// a noise target the number of passes is the scene's pixel samples.
struct RenderOptions {
  uint32_t first_pass = 0;
  std::optional<uint32_t> last_pass;  ///< included
  double time_limit = 0;              ///< s, 0: none
  double noise_target = 0;            ///< as estimated_error().total(), 0: none
  bool show_error = true;             ///< progress has the error, which takes a little time
  uint64_t seed = 0;
  std::string output;               ///< EXR, a PNG is written beside it; empty: nothing is written
  std::string rescue_directory;     ///< for the last picture if it cannot be written; empty: none
  double first_preview = 0.5;       ///< s until the first intermediate PNG, if there is light
  double preview_interval = 5;      ///< s between intermediate PNGs, at least
  double checkpoint_interval = 60;  ///< s between intermediate EXRs, at least
  bool keeps_state = true;          ///< a state is left beside the last picture
  LayerPrecision layer_precision = LayerPrecision::kHalf;
  Checkpoint begin_with;  ///< what film and estimators hold already
  float png_exposure = 1;
  /// Depth of the paths of a first PNG, before the first pass (quick_look.h); 0: there is none.
  int quick_look_depth = 0;
  std::vector<std::string> notes;  ///< of the choices that a picture tells
  RenderIdentity identity;         ///< what the picture tells; the session sets film and seed
};

enum class StopReason { kPasses, kTime, kNoise, kSignal };

/// Where a render stands, after a pass or within one.
struct RenderProgress {
  uint32_t passes_done = 0;               ///< whole ones
  bool within_pass = false;               ///< called while a pass is rendered
  std::optional<uint32_t> passes_wanted;  ///< empty if only time or error stop it
  double seconds = 0;
  std::optional<double> seconds_left;  ///< by the rule that will be met first, as it looks now
  std::optional<double> error;         ///< the last estimate, renewed now and then
  double fraction = 0;                 ///< of the whole, 0..1
  uint64_t rays = 0;
  uint64_t photons_stored = 0;
};

struct RenderResult {
  StopReason reason = StopReason::kPasses;
  int signal = 0;                    ///< that stopped it, if one did
  uint32_t passes_done = 0;          ///< in all runs, whole ones
  bool has_unfinished_pass = false;  ///< pixels have more estimates than these, some of them
  bool has_picture = false;          ///< there is light to be shown; else nothing was written
  bool has_state = false;            ///< the picture has its state beside it
  uint32_t passes_of_run = 0;        ///< in this one
  double seconds = 0;  ///< rendering, with intermediate pictures, without the last; of this run
  std::optional<double> error;  ///< as estimated_error().total(); empty of a black picture
  /// As error_report(), of consistent estimators alone; of a black picture black_picture_report().
  std::optional<std::string> error_text;
  std::vector<std::string> faults;  ///< as invalid_samples()
  /// As those of the estimators: after the first pass (for where radii began) and after the last.
  std::vector<EstimatorStatistics> first_pass_statistics, statistics;
};

class RenderSession {
 public:
  /// Keeps references to all three. The film has the set's layout. Throws UsageError if the
  /// options do not fit the estimators, IoError if the output cannot be written.
  RenderSession(const Scene& scene, EstimatorSet& set, Film& film, RenderOptions options);

  /// Called after every pass, and a few times a second within passes.
  void on_progress(std::function<void(const RenderProgress&)> callback);
  /// Called when an intermediate picture could not be written; rendering goes on.
  void on_warning(std::function<void(const std::string&)> callback);
  /// Seconds from any origin; the machine's steady clock unless set. Called by any thread.
  void use_clock(std::function<double()> seconds);

  /// Renders until a rule or a signal stops it and writes the picture. Throws IoError if the last
  /// picture cannot be written; it says where the picture is instead, if it could be rescued.
  RenderResult run(SignalFlags& signals);

 private:
  std::optional<StopReason> reason_to_stop(const SignalFlags& signals) const;
  double elapsed() const { return clock_() - start_; }
  double seconds_of_all_runs() const { return options_.begin_with.seconds + elapsed(); }
  std::optional<uint32_t> next_pass() const;
  /// True if a pass is of the range that is wanted.
  bool is_wanted(uint32_t pass) const;
  uint32_t passes_of_run() const { return passes_done_ - passes_before_; }
  bool shows_error() const { return progress_ && options_.show_error; }
  bool error_check_is_due() const;
  /// False if it was ended before it was whole.
  bool render_one_pass(SignalFlags& signals);
  /// Called within a pass. Throws PassStopped to end it.
  void look_in(SignalFlags& signals, PassWatch& watch);
  /// What stops the render within a pass.
  std::optional<StopReason> reason_to_end_pass(const SignalFlags& signals) const;
  /// How much of the pass that is not whole is done, 0..1.
  double fraction_of_pass() const;
  std::vector<EstimatorStatistics> statistics() const;
  void renew_error();
  /// Makes error_text_ that of the passes so far.
  void renew_error_text();
  void report_progress(bool within_pass);
  void write_if_due(SignalFlags& signals);
  /// If a PNG is wanted and there is none yet.
  void take_quick_look(const SignalFlags& signals);
  void write_picture();
  /// The picture without its PNG, and its state; without one, that of an intermediate picture goes.
  void write_exr_file(const std::string& path, bool with_state);
  /// Before the first of them and before the first PNG: what another render has left, if anything,
  /// takes the names of files_to_keep().
  void keep_previous();
  void write_png();
  void write_last_picture(bool with_state);
  /// Writes, says what went wrong, and returns when to do it again.
  double write_now(double interval, const std::function<void()>& write);
  uint32_t passes_done_of_wanted() const;
  std::optional<double> seconds_left(double seconds) const;
  std::string choices_text() const;
  Metadata state_metadata() const;

  const Scene& scene_;
  EstimatorSet& set_;
  Film& film_;
  RenderOptions options_;
  std::optional<uint32_t> passes_wanted_;
  std::function<void(const RenderProgress&)> progress_;
  std::function<void(const std::string&)> warning_;
  std::function<double()> clock_;

  double start_ = 0;
  std::vector<EstimatorStatistics> first_pass_statistics_;
  PassRanges done_;
  uint32_t passes_before_ = 0, passes_done_ = 0;  ///< before this run, and by now
  std::optional<uint32_t> open_pass_;             ///< begun and not whole
  double fraction_before_ = 0;                    ///< of the open pass, done in other runs
  std::optional<EstimatedError> error_;
  bool is_black_ = false;    ///< then error_, which is 0, is not told
  uint32_t error_pass_ = 0;  ///< passes done when error_ was estimated
  /// The line of error_report(), empty where an estimator knows only a part of its error.
  std::optional<std::string> error_text_;
  uint32_t error_text_pass_ = 0;   ///< passes done when it was made
  double next_error_seconds_ = 0;  ///< of the estimates for progress alone
  double next_preview_seconds_ = 0, next_checkpoint_seconds_ = 0;
  double next_progress_seconds_ = 0;  ///< within a pass
  bool has_written_ = false;          ///< a picture or a PNG
};

}  // namespace nephroid
