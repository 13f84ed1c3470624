// Choices of the user about scene files: which camera and moment of a file, what a missing
// thickness of glass means, and the floor, light and exposure that no file has.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace nephroid {

/// Where the sun stands, in degrees.
struct SunDirection {
  double elevation = 0;  ///< above the horizon, 0 to 90
  double azimuth = 0;    ///< from north to east; north is -z where +y is up
  bool operator==(const SunDirection&) const = default;
};

struct ImportOptions {
  std::string camera;          ///< name or index of a camera; empty: the first
  std::string variant;         ///< name of a glTF material variant; empty: none
  double time = 0;             ///< moment of the animations at which the shutter opens, s
  double shutter = 0;          ///< time for which it is open, s; 0: nothing moves
  bool solid_glass = false;    ///< transmission without volume is solid, not thin
  bool allow_outside = false;  ///< files outside of the scene's folder may be read
  std::map<std::string, std::string> defines;  ///< values of $name in Mitsuba scenes

  // For scenes of any format (staging/staging.h).
  bool floor = false;               ///< a matte floor is added under the lowest point
  std::string environment;          ///< image of the surroundings; empty: none
  std::optional<SunDirection> sun;  ///< sun and clear sky
  /// Stops by which the picture is brighter. Empty: chosen for the lights of glTF and OBJ files, 0
  /// for other scenes.
  std::optional<double> exposure;

  bool operator==(const ImportOptions&) const = default;
};

/// The options that are not the defaults, as words "key=value" with blanks between them: they are
/// part of a render's identity. Blanks within values are "%20".
std::string import_options_text(const ImportOptions& options);

}  // namespace nephroid
