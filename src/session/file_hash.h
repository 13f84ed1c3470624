// A number that stands for the content of a file, to tell whether two pictures show the same scene.
#pragma once

#include <cstdint>
#include <string>

namespace nephroid {

/// 64-bit FNV-1a of the file's bytes; of none for a pipe, which can be read only once. Throws
/// IoError if the file cannot be read.
uint64_t hash_file(const std::string& path);

}  // namespace nephroid
