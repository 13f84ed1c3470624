// The version of the program and the instruction set it runs with, for --version and the metadata
// of pictures.
#pragma once

#include <string>

namespace nephroid {

/// Equal to the version in the project() line of CMakeLists.txt (a test compares them).
inline constexpr const char* kVersion = "0.1.0";

/// The machine's widest instruction set that libraries dispatch on, and the one that the program
/// was compiled for: "avx2, compiled for avx2". Pictures are bit-identical only if this is the
/// same.
std::string instruction_set();

}  // namespace nephroid
