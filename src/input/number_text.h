// Numbers as users and exporters write them: "-0", "1.", ".5", "1e-3", "+5".
// No locale changes them. It must not know what a number is for.
#pragma once

#include <optional>
#include <string_view>

namespace nephroid {

/// The number that the whole of `text` spells, or nothing if it does not spell one. May be infinite
/// (overflow or "inf") or NaN ("nan"): the caller decides what that means.
std::optional<double> parse_number(std::string_view text);

/// The integer that the whole of `text` spells in decimal digits, or nothing (also on overflow).
std::optional<long long> parse_integer(std::string_view text);

}  // namespace nephroid
