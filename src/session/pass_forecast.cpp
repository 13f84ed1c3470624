#include "session/pass_forecast.h"

#include <algorithm>
#include <numeric>

namespace nephroid {
namespace {

/// Part of a group's pixels after which their speed is known.
constexpr double kEnoughPixels = 0.02;

}  // namespace

void PassForecast::begin(double now, std::span<const double> fractions) {
  begun_with_.assign(fractions.begin(), fractions.end());
  const double done = std::accumulate(fractions.begin(), fractions.end(), 0.0);
  part_ = std::max(1 - done / static_cast<double>(fractions.size()), kEnoughPixels);
  begin_ = group_begin_ = pixels_begin_ = now;
  is_open_ = true;
  group_ = 0;
  end_.reset();
}

void PassForecast::look(double now, std::span<const double> fractions) {
  for (size_t g = 0; g < fractions.size(); ++g)
    if (fractions[g] < 1) return look_at_group(now, g, fractions[g]);
}

void PassForecast::look_at_group(double now, size_t group, double fraction) {
  if (group != group_) {
    group_ = group;
    group_begin_ = pixels_begin_ = now;
  }
  const double before = begun_with_[group];
  const double done = (fraction - before) / (1 - before);
  if (done <= 0) pixels_begin_ = now;
  if (done < kEnoughPixels) return;
  const double left = (now - pixels_begin_) * (1 - done) / done;
  // Nothing is known of later groups, so they take as long as this one.
  const double later = static_cast<double>(begun_with_.size() - 1 - group);
  end_ = now + left + later * (now - group_begin_ + left);
}

void PassForecast::end(double now) {
  is_open_ = false;
  const double seconds = (now - begin_) / part_;
  (ended_ == 0 ? first_seconds_ : later_seconds_) += seconds;
  ++ended_;
}

std::optional<double> PassForecast::seconds_of_pass() const {
  if (ended_ > 1) return later_seconds_ / (ended_ - 1);
  if (ended_ == 1) return first_seconds_;
  return end_ ? std::optional((*end_ - begin_) / part_) : std::nullopt;
}

std::optional<double> PassForecast::seconds_left(double now) const {
  if (!is_open_) return 0;
  // What comes before the pixels takes its time in each pass, and only earlier passes tell it.
  if (ended_ > 0 && now < begin_ + *seconds_of_pass()) return begin_ + *seconds_of_pass() - now;
  return end_ ? std::optional(std::max(0.0, *end_ - now)) : std::nullopt;
}

}  // namespace nephroid
