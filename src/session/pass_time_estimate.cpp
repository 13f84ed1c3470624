#include "session/pass_time_estimate.h"

#include <algorithm>

namespace nephroid {
namespace {

/// Part of a group's pixels after which their speed is known.
constexpr double kEnoughPixels = 0.02;

}  // namespace

void PassTimeEstimate::begin(double now, std::span<const double> fractions) {
  fractions_.assign(fractions.begin(), fractions.end());
  is_open_ = true;
  was_begun_before_ = std::ranges::any_of(fractions, [](double done) { return done > 0; });
  pass_start_ = last_observed_ = group_start_ = pixels_start_ = now;
  group_ = 0;
  pass_end_.reset();
}

void PassTimeEstimate::observe(double now, std::span<const double> fractions) {
  for (size_t g = 0; g < fractions.size(); ++g) {
    if (fractions[g] >= 1) continue;
    observe_group(now, g, fractions[g]);
    break;
  }
  last_observed_ = now;
}

void PassTimeEstimate::observe_group(double now, size_t group, double fraction) {
  if (group != group_) {
    group_ = group;
    group_start_ = pixels_start_ = last_observed_;
  }
  const double done = (fraction - fractions_[group]) / (1 - fractions_[group]);
  if (done <= 0) pixels_start_ = now;
  if (done < kEnoughPixels) return;
  const double left = (now - pixels_start_) * (1 - done) / done;
  // Nothing is known of later groups, so they take as long as this one.
  const double later = static_cast<double>(fractions_.size() - 1 - group);
  pass_end_ = now + left + later * (now - group_start_ + left);
}

void PassTimeEstimate::end(double now) {
  is_open_ = false;
  if (was_begun_before_) return;
  (passes_ == 0 ? seconds_of_first_ : seconds_of_others_) += now - pass_start_;
  ++passes_;
}

std::optional<double> PassTimeEstimate::seconds_of_pass() const {
  if (passes_ > 1) return seconds_of_others_ / (passes_ - 1);
  if (passes_ == 1) return seconds_of_first_;
  if (!is_open_ || was_begun_before_ || !pass_end_) return std::nullopt;
  return *pass_end_ - pass_start_;
}

std::optional<double> PassTimeEstimate::seconds_left(double now) const {
  if (!is_open_) return 0;
  std::optional<double> end = pass_end_;
  // Each pass traces photons before its first pixel. Only earlier passes show how long that takes.
  if (passes_ > 0 && !was_begun_before_) {
    const double expected = pass_start_ + *seconds_of_pass();
    if (!end || now < expected) end = expected;
  }
  return end ? std::optional(std::max(0.0, *end - now)) : std::nullopt;
}

}  // namespace nephroid
