// A directory of its own for files that are gone in a moment.
#pragma once

#include <string>

namespace nephroid {

class TemporaryDirectory {
 public:
  /// Throws IoError.
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  /// The path of a file in it.
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace nephroid
