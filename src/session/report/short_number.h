// Short texts of large numbers. It must not know what they count.
#pragma once

#include <string>

namespace nephroid {

/// "1.23 M": three digits and an SI prefix.
std::string short_number(double value);
/// "1.23 MiB": three digits and a binary unit.
std::string short_bytes(double bytes);

}  // namespace nephroid
