// Choices of the user about scene files that are not pbrt-v4: which camera, which moment, what a
// missing thickness of glass means.
#pragma once

#include <map>
#include <string>

namespace nephroid {

struct ImportOptions {
  std::string camera;          ///< name or index of a camera; empty: the first
  std::string variant;         ///< name of a glTF material variant; empty: none
  double time = 0;             ///< moment of the animations at which the shutter opens, s
  double shutter = 0;          ///< time for which it is open, s; 0: nothing moves
  bool solid_glass = false;    ///< transmission without volume is solid, not thin
  bool allow_outside = false;  ///< files outside of the scene's folder may be read
  std::map<std::string, std::string> defines;  ///< values of $name in Mitsuba scenes
};

}  // namespace nephroid
