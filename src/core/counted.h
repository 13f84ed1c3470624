// Counts with their nouns, for messages: "1 pass", "2 passes". It must not know what is counted.
#pragma once

#include <cstdint>
#include <string>

namespace nephroid {

/// `one` if the count is 1, else `many`; an empty `many` is `one` with an "s".
std::string in_number(uint64_t count, const std::string& one, const std::string& many = {});

/// The count and its noun in that number: "1 photon", "2 photons".
std::string counted(uint64_t count, const std::string& one, const std::string& many = {});

}  // namespace nephroid
