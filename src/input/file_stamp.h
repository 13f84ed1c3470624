// Tells whether a file has changed since it was read, without reading it again. It must not know
// what is in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace nephroid {

/// Time of the last change and size. Files that are missing are equal to each other.
struct FileStamp {
  std::optional<std::filesystem::file_time_type> changed;  ///< empty: there is no such file
  uintmax_t bytes = 0;

  bool operator==(const FileStamp&) const = default;
};

/// Stamps by path.
using FileStamps = std::map<std::string, FileStamp>;

FileStamp stamp_of(const std::string& path);

}  // namespace nephroid
