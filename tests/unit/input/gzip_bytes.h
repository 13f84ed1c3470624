// Packs bytes as a gzip file, to test that they are unpacked again.
// Used by the tests of this folder only.
#pragma once

#include <string>

namespace nephroid::testing {

std::string gzip(const std::string& bytes);

}  // namespace nephroid::testing
