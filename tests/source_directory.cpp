#include "source_directory.h"

namespace nephroid::testing_support {

// In a file of its own, so that few objects depend on where the tree is.
std::string source_directory() {
  return NEPHROID_SOURCE_DIR;
}

}  // namespace nephroid::testing_support
