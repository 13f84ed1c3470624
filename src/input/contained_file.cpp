#include "input/contained_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace nephroid {
namespace {

namespace fs = std::filesystem;

bool lies_below(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end() || (in_folder->empty() && std::next(in_folder) == folder.end());
}

}  // namespace

std::string contained_file(const SceneFiles& files, const std::string& name, bool allow_outside,
                           const SourceLocation& named_by) {
  if (name.find('\0') != std::string::npos)
    throw SceneError(named_by, "a file name has a zero byte in it, expected a name");
  if (allow_outside) return name;
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(files.directory(), error);
  const fs::path path =
      error ? fs::path() : fs::weakly_canonical(fs::absolute(files.path_of(name)), error);
  if (error || !lies_below(path, folder))
    throw SceneError(named_by, "\"" + name +
                                   "\" lies outside of the scene's folder, expected a "
                                   "file in it (--allow-outside permits others)");
  return name;
}

}  // namespace nephroid
