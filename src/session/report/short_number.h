// Large numbers for people to read. It must not know what they count.
#pragma once

#include <string>

namespace nephroid {

/// "1.23 M": three digits and the letter of the thousands.
std::string short_number(double value);
/// "1.23 MiB": three digits and the unit by powers of 1024.
std::string short_bytes(double bytes);

}  // namespace nephroid
