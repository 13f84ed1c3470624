// Shows the progress of a render on standard error: a bar on a terminal, else a plain line now and
// then. It must not know scenes or estimators.
#pragma once

#include <cstdint>
#include <string>

#include "session/render_session.h"

namespace nephroid {

class ProgressDisplay {
 public:
  ProgressDisplay();
  /// Shows the progress if the last one was shown long enough.
  void show(const RenderProgress& progress);
  /// Removes the bar, so that something else can be printed.
  void clear();

 private:
  bool is_terminal_;
  bool bar_is_drawn_ = false;
  double next_seconds_ = 0;
};

/// "1:02:03", "2:03" or "0:03".
std::string clock_text(double seconds);

}  // namespace nephroid
