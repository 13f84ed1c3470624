// A folder with a scene to render, and expectations on the program's status, messages and files.
// The scene's own lines start at line 7.
#pragma once

#include <string>
#include <vector>

#include "regression/program.h"
#include "unit/input/temporary_directory.h"

namespace nephroid::testing_support {

/// Documented exit statuses of the program.
inline constexpr int kUsage = 2, kScene = 3, kInputOutput = 4;

/// Lines 1 to 4: film (8 x 8 pixels, "picture.exr"), sampler, look-at and camera.
extern const std::string kOptions;
/// Lines 1 to 6: the options, WorldBegin and a light.
extern const std::string kHead;
/// A line with a triangle that the camera sees.
extern const std::string kTriangle;

class SceneFolder {
 public:
  /// The whole text of scene.pbrt.
  explicit SceneFolder(const std::string& scene = kHead + kTriangle) { write("scene.pbrt", scene); }

  std::string path(const std::string& name) const { return directory_.path(name); }
  void write(const std::string& name, const std::string& bytes) { directory_.write(name, bytes); }

  /// nephroid render scene.pbrt, with more arguments.
  ProgramRun render(std::vector<std::string> more = {}) const;

  /// Expects that rendering ends with this status and a message that begins with `message`, and
  /// that it neither creates nor removes a file.
  void expect_error(int status, const std::string& message,
                    std::vector<std::string> more = {}) const;
  /// Expects a picture, all of these warnings and no other new file.
  void expect_picture(const std::vector<std::string>& warnings,
                      std::vector<std::string> more = {}) const;

 private:
  testing::TemporaryDirectory directory_;
};

/// Expects that kHead followed by these lines is refused as a bad scene, with a message that begins
/// with "scene.pbrt:" and `message`.
void expect_scene_error(const std::string& lines, const std::string& message);

/// The same without starting the program, for many variants of one fault: only reads and builds the
/// scene. `options` replaces the first four lines.
void expect_refused(const std::string& lines, const std::string& message,
                    const std::string& options = kOptions);

}  // namespace nephroid::testing_support
