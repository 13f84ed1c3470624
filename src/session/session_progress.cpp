// Reports the progress of a session: passes, time left, error, counts.
#include <algorithm>

#include "session/render_session.h"

namespace nephroid {

std::vector<double> RenderSession::progress_of_groups() const {
  std::vector<double> fractions(film_.layout().group_count());
  for (size_t g = 0; g < fractions.size(); ++g)
    fractions[g] = film_.fraction_of_pass(static_cast<int>(g));
  return fractions;
}

/// The picture may also have passes outside of the wanted range; these do not count.
uint32_t RenderSession::passes_done_of_wanted() const {
  if (!passes_wanted_) return passes_done_;
  const uint32_t last = options_.first_pass + (*passes_wanted_ - 1);
  return static_cast<uint32_t>(done_.count({options_.first_pass, last}));
}

std::optional<double> RenderSession::seconds_left() const {
  std::optional<double> left;
  const auto at_most = [&](double candidate) {
    left = std::max(0.0, left ? std::min(*left, candidate) : candidate);
  };
  if (is_past_time_limit()) {
    // A pass goes on only until there is a picture, and nobody knows how long that takes.
    return open_pass_ ? std::nullopt : std::optional(0.0);
  }
  if (options_.time_limit > 0) at_most(options_.time_limit - seconds_of_all_runs());
  const std::optional<double> of_open = time_of_pass_.seconds_left(clock_());
  const std::optional<double> per_pass = time_of_pass_.seconds_of_pass();
  if (passes_wanted_ && of_open) {
    const uint32_t later = *passes_wanted_ - passes_done_of_wanted() - (open_pass_ ? 1 : 0);
    if (later == 0 || per_pass) at_most(*of_open + later * per_pass.value_or(0));
  }
  if (options_.noise_target > 0 && error_ && error_->total() > 0 && per_pass)
    at_most(*per_pass * (error_pass_ * passes_to(*error_, options_.noise_target) - passes_done_));
  return left;
}

void RenderSession::report_progress(bool within_pass) {
  if (!progress_) return;
  if (within_pass) time_of_pass_.observe(clock_(), progress_of_groups());
  RenderProgress progress;
  progress.within_pass = within_pass;
  progress.passes_done = passes_done_of_wanted();
  progress.passes_wanted = passes_wanted_;
  progress.seconds = elapsed();
  progress.seconds_left = seconds_left();
  if (error_ && !is_black_) progress.error = error_->total();
  if (progress.seconds_left) {
    const double total = progress.seconds + *progress.seconds_left;
    fraction_ = total > 0 ? progress.seconds / total : 1;
  } else if (is_past_time_limit()) {
    fraction_ = 1;
  }
  progress.fraction = fraction_;
  for (const EstimatorStatistics& s : statistics()) {
    progress.rays += s.rays;
    progress.photons_stored += s.photons_stored;
  }
  progress_(progress);
}

}  // namespace nephroid
