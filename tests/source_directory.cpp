#include "source_directory.h"

namespace nephroid::testing_support {

// The one object that depends on where the tree is: all others are the same in every clone.
std::string source_directory() {
  return NEPHROID_SOURCE_DIR;
}

}  // namespace nephroid::testing_support
