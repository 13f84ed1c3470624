// Large numbers for people to read. It must not know what they count.
#pragma once

#include <string>

namespace nephroid {

/// "1.23 M", three digits and the letter of the thousands; a space is last where there is none.
std::string short_number(double value);

}  // namespace nephroid
