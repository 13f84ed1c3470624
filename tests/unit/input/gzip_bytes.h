// Packs bytes as a gzip file, to test unpacking.
#pragma once

#include <string>

namespace nephroid::testing {

std::string gzip(const std::string& bytes);

}  // namespace nephroid::testing
