#include "session/stop_reason.h"

namespace nephroid {

const char* stop_reason_text(StopReason reason) {
  switch (reason) {
    case StopReason::kPasses:
      return "all passes done";
    case StopReason::kTime:
      return "time limit";
    case StopReason::kNoise:
      return "noise target met";
    case StopReason::kSignal:
      break;
  }
  return "stopped by a signal";
}

}  // namespace nephroid
