// Tells when files change. It must not know what is in them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nephroid {

class WatchedFiles {
 public:
  /// True if one of the files has another time of change than in the last call. Files that were not
  /// watched before, or that do not exist, do not count.
  bool have_changed(const std::vector<std::string>& files);

 private:
  std::map<std::string, std::filesystem::file_time_type> times_;
};

}  // namespace nephroid
