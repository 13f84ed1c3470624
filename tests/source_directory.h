// Where the project's files are, for the tests that read its scenes and documents.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace nephroid::testing_support {

/// The absolute path of the source tree that these tests were built from, without a slash at its
/// end.
std::string source_directory();

/// A file of the source tree; empty if it cannot be read.
inline std::string read_source_file(const std::string& name) {
  std::ifstream in(source_directory() + "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace nephroid::testing_support
