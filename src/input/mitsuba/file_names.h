// The files that a scene names: in the folders of its <path> elements, then in its own folder. It
// must not know what they contain.
#pragma once

#include <string>
#include <vector>

#include "core/errors.h"
#include "input/scene_files.h"

namespace nephroid::mitsuba {

class FileNames {
 public:
  explicit FileNames(bool allow_outside) : allow_outside_(allow_outside) {}

  bool allow_outside() const { return allow_outside_; }

  /// Files are looked up in `folder` before all others, as in Mitsuba.
  void add_folder(const std::string& folder) { folders_.push_back(folder); }
  /// The file's name for SceneFiles. Throws SceneError at `where` if it lies outside of the scene's
  /// folder, unless that is allowed.
  std::string find(const SceneFiles& files, const std::string& name,
                   const SourceLocation& where) const;

 private:
  bool allow_outside_;
  std::vector<std::string> folders_;
};

}  // namespace nephroid::mitsuba
