// Symbols in the notation of the expressions.
#pragma once

#include <span>
#include <string>

#include "route/symbols.h"

namespace nephroid {

/// "D", or with side and label "<TD'glass'>" if `full`.
std::string event_text(EventSymbol e, std::span<const std::string> labels, bool full);

/// "L" or "M", or with kind and label "<O.'lamp'>" if `full`.
std::string light_text(LightSymbol l, std::span<const std::string> labels, bool full);

}  // namespace nephroid
