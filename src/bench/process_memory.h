// The program's own peak of memory, as the system counts it.
// Who calls it: render.cpp. It must not know what the memory is for.
#pragma once

#include <cstdint>

namespace nephroid {

/// Starts a new peak, where the system can do that; else the peak stays that of the whole process.
void restart_memory_peak();

/// Bytes of physical memory held at most since the last restart; 0 if the system does not tell.
uint64_t memory_peak();

}  // namespace nephroid
