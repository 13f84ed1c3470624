#include "input/mitsuba/file_names.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "input/contained_file.h"

namespace nephroid::mitsuba {

std::string FileNames::find(const SceneFiles& files, const std::string& written,
                            const SourceLocation& where) const {
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');  // of scenes made on Windows
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
    const std::string candidate = (std::filesystem::path(*folder) / name).string();
    std::error_code ignored;
    const bool has_zero = candidate.find('\0') != std::string::npos;
    if (!has_zero && std::filesystem::exists(files.path_of(candidate), ignored))
      return contained_file(files, candidate, allow_outside_, where);
  }
  return contained_file(files, name, allow_outside_, where);
}

}  // namespace nephroid::mitsuba
