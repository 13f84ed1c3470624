// Why a render has ended.
#pragma once

namespace nephroid {

enum class StopReason { kPasses, kTime, kNoise, kSignal };

/// "all passes done", "time limit", ...
const char* stop_reason_text(StopReason reason);

}  // namespace nephroid
