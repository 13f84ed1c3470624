// Parses numbers as users and exporters write them: "-0", "1.", ".5", "1e-3", "+5". Independent of
// the locale. It must not know what a number is for.
#pragma once

#include <optional>
#include <string_view>

namespace nephroid {

/// Parses the whole of `text` as a number; empty if it is not one. The result may be infinite
/// (overflow or "inf") or NaN ("nan").
std::optional<double> parse_number(std::string_view text);

/// Parses the whole of `text` as a decimal integer; empty if it is not one, or on overflow.
std::optional<long long> parse_integer(std::string_view text);

}  // namespace nephroid
