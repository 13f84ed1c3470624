// Figures as text. It must not know what they measure.
#pragma once

#include <string>

namespace nephroid {

/// Three significant digits, or all before the point: "0.0123", "12345", "4.5e-07". An em dash if
/// the value is not finite.
std::string number_text(double value);

/// "12.3 ms", "4.56 s", "7.89 min", "1.23 h".
std::string seconds_in_words(double seconds);

}  // namespace nephroid
