#include "view/thread_priority.h"

#include <sys/resource.h>

namespace nephroid {
namespace {

/// A third of the weight of a browser's thread in Linux's scheduler.
constexpr int kNiceness = 5;

}  // namespace

void give_way_to_others() {
  // 0 is the calling thread in Linux. It may be as nice already as it can be.
  const int now = ::getpriority(PRIO_PROCESS, 0);
  ::setpriority(PRIO_PROCESS, 0, now + kNiceness);
}

}  // namespace nephroid
