#include "view/temporary_directory.h"

#include <stdlib.h>

#include <filesystem>

#include "core/errors.h"

namespace nephroid {
namespace fs = std::filesystem;

TemporaryDirectory::TemporaryDirectory() {
  std::error_code error;
  // Six letters X, which mkdtemp replaces.
  path_ = (fs::temp_directory_path(error) / "nephroid-view-XXXXXX").string();
  if (error || ::mkdtemp(path_.data()) == nullptr)
    throw IoError(path_ + ": cannot make a directory for a file of the view");
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace nephroid
