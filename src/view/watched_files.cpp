#include "view/watched_files.h"

#include <algorithm>

namespace nephroid {

bool have_changed(const FileStamps& as_read) {
  return std::ranges::any_of(as_read, [](const auto& entry) {
    const FileStamp now = stamp_of(entry.first);
    return now.changed && now != entry.second;
  });
}

}  // namespace nephroid
