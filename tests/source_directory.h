// Where the project's files are, for the tests that read its scenes and documents.
#pragma once

#include <string>

namespace nephroid::testing_support {

/// The absolute path of the source tree that these tests were built from, without a slash at its
/// end.
std::string source_directory();

}  // namespace nephroid::testing_support
