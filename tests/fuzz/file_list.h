// Several files in the bytes of one input. It must not know formats.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

namespace nephroid::fuzz {

/// Splits the bytes at lines "#file NAME". The part before the first one is the file `first`.
inline std::map<std::string, std::string> files_of(const std::string& bytes,
                                                   const std::string& first) {
  constexpr std::string_view kMark = "#file ";
  std::map<std::string, std::string> files;
  std::string* current = &files[first];
  for (size_t start = 0; start < bytes.size();) {
    const size_t end = std::min(bytes.find('\n', start), bytes.size() - 1) + 1;
    const std::string line = bytes.substr(start, end - start);
    if (line.rfind(kMark, 0) == 0)
      current = &files[line.substr(kMark.size(), line.find_last_not_of("\r\n") + 1 - kMark.size())];
    else
      *current += line;
    start = end;
  }
  return files;
}

}  // namespace nephroid::fuzz
