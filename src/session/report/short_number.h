// Short texts of large numbers. It must not know what they count.
#pragma once

#include <string>

namespace nephroid {

/// "1.23 M": three digits and an SI prefix.
std::string short_number(double value);
/// The same with its noun: "1 photon", "1.23 M photons". The plural has an "s".
std::string short_count(double count, const std::string& noun);
/// "1.23 MiB": three digits and a binary unit.
std::string short_bytes(double bytes);

}  // namespace nephroid
