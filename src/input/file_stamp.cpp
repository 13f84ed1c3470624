#include "input/file_stamp.h"

#include <system_error>

namespace nephroid {

FileStamp stamp_of(const std::string& path) {
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(path, error);
  if (error) return {};
  const uintmax_t bytes = std::filesystem::file_size(path, error);
  return {changed, error ? 0 : bytes};
}

}  // namespace nephroid
