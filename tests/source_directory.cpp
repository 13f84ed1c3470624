#include "source_directory.h"

namespace nephroid::testing_support {

// In its own file, so that few objects depend on the path.
std::string source_directory() {
  return NEPHROID_SOURCE_DIR;
}

}  // namespace nephroid::testing_support
