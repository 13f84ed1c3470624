// What this program is: its version and the instruction set that it runs with, for --version and
// for the metadata of pictures.
#pragma once

#include <string>

namespace nephroid {

/// As in the project() line of CMakeLists.txt (a test compares them).
inline constexpr const char* kVersion = "0.1.0";

/// The widest instruction set of this machine that libraries dispatch on, and the one that the
/// program was compiled for, for instance "avx2, compiled for avx2". Pictures have the same bits
/// only where this is the same.
std::string instruction_set();

}  // namespace nephroid
