#include "apps/progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "apps/messages.h"
#include "core/counted.h"
#include "session/report/short_number.h"

namespace nephroid {
namespace {

constexpr double kBarInterval = 0.1;  ///< seconds
constexpr double kLineInterval = 10;  ///< seconds
constexpr int kBarWidth = 24;

std::string bar(double fraction) {
  const int filled = std::clamp(static_cast<int>(std::lround(fraction * kBarWidth)), 0, kBarWidth);
  return "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '-') + "]";
}

std::string description(const RenderProgress& p) {
  std::string text = fmt::format("{}", p.passes_done);
  if (p.passes_wanted) text += fmt::format("/{}", *p.passes_wanted);
  text += in_number(p.passes_wanted.value_or(p.passes_done), " pass", " passes");
  if (p.seconds_left) text += fmt::format(", {} left", clock_text(*p.seconds_left));
  if (p.seconds > 0 && p.rays > 0)
    text += fmt::format(", {} rays/s", short_number(static_cast<double>(p.rays) / p.seconds));
  if (p.photons_stored > 0)
    text += fmt::format(", {} kept", short_count(static_cast<double>(p.photons_stored), "photon"));
  if (p.error) text += fmt::format(", error {:.3g}", *p.error);
  return text;
}

}  // namespace

ProgressDisplay::ProgressDisplay() : is_terminal_(::isatty(STDERR_FILENO) == 1) {
  if (!is_terminal_) next_seconds_ = kLineInterval;
}

void ProgressDisplay::show(const RenderProgress& progress) {
  if (progress.seconds < next_seconds_) return;
  next_seconds_ = progress.seconds + (is_terminal_ ? kBarInterval : kLineInterval);
  if (!is_terminal_) {
    say(fmt::format("nephroid: {} after {}\n", description(progress),
                    clock_text(progress.seconds)));
    return;
  }
  say(fmt::format("\r{} {}\x1b[K", bar(progress.fraction), description(progress)));
  bar_is_drawn_ = true;
}

void ProgressDisplay::clear() {
  if (!bar_is_drawn_) return;
  say("\r\x1b[K");
  bar_is_drawn_ = false;
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<int64_t>(std::ceil(std::min(seconds, 1e12)));
  const int64_t hours = whole / 3600, minutes = whole / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
  return fmt::format("{}:{:02}", minutes, whole % 60);
}

}  // namespace nephroid
