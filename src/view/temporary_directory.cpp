#include "view/temporary_directory.h"

#include <stdlib.h>

#include <filesystem>

#include "core/errors.h"

namespace nephroid {
namespace fs = std::filesystem;

TemporaryDirectory::TemporaryDirectory() {
  std::error_code error;
  const std::string random_letters(6, 'X');  // replaced by mkdtemp
  path_ = (fs::temp_directory_path(error) / ("nephroid-view-" + random_letters)).string();
  if (error || ::mkdtemp(path_.data()) == nullptr)
    throw IoError(path_ + ": cannot make a directory for a file of the view");
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace nephroid
