// Uses madvise() if the system has it. Elsewhere it does nothing, which only costs time.
#include "core/zeroed_array.h"

#include <sys/mman.h>

#include <cstdint>

namespace nephroid {

void prefer_pages(Pages pages, void* memory, size_t bytes) {
#if defined(MADV_HUGEPAGE) && defined(MADV_NOHUGEPAGE)
  constexpr uintptr_t kHugePage = uintptr_t{2} << 20;
  const auto begin = reinterpret_cast<uintptr_t>(memory);
  const uintptr_t first = (begin + kHugePage - 1) / kHugePage * kHugePage;
  const uintptr_t last = (begin + bytes) / kHugePage * kHugePage;
  if (first >= last) return;
  madvise(reinterpret_cast<void*>(first), last - first,
          pages == Pages::kHuge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#else
  (void)pages;
  (void)memory;
  (void)bytes;
#endif
}

}  // namespace nephroid
