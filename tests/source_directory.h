// Finds the files of the source tree for tests that read scenes and documents.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace nephroid::testing_support {

/// The absolute path of the source tree of this build, without a trailing slash.
std::string source_directory();

/// A file of the source tree; empty if it cannot be read.
inline std::string read_source_file(const std::string& name) {
  std::ifstream in(source_directory() + "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace nephroid::testing_support
