// The clock of the view.
#pragma once

#include <chrono>

namespace nephroid {

/// Seconds since some moment, by a clock that nobody sets.
inline double steady_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

}  // namespace nephroid
