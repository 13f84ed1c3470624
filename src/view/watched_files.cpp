#include "view/watched_files.h"

namespace nephroid {

bool WatchedFiles::have_changed(const std::vector<std::string>& files) {
  bool changed = false;
  std::map<std::string, std::filesystem::file_time_type> times;
  for (const std::string& file : files) {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    const auto known = times_.find(file);
    if (error) {
      // An editor may just be replacing it.
      if (known != times_.end()) times.insert(*known);
      continue;
    }
    changed = changed || (known != times_.end() && known->second != time);
    times[file] = time;
  }
  times_ = std::move(times);
  return changed;
}

}  // namespace nephroid
