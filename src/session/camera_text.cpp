#include "session/camera_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "input/convert/pbrt_text.h"
#include "scene/camera/camera_frame.h"

namespace nephroid {
namespace {

constexpr double kNoise = 1e-12;  ///< rounding errors of double arithmetic, relative to its values

std::string number_text(double value) {
  return fmt::format("{:.9g}", value + 0.0);
}

/// Rounding errors of numbers of size `scale` become zeros.
double without_noise(double value, double scale) {
  return std::abs(value) <= kNoise * scale ? 0.0 : value;
}

std::string vector_text(const Vec3d& v, double scale) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += " " + number_text(without_noise(v[i], scale));
  return text;
}

/// A distance of the target at which its nine digits give nine of the direction: the power of ten
/// above the eye's coordinates.
double target_distance(const Vec3d& eye) {
  const double largest = std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)});
  return largest > 0 ? std::pow(10, std::ceil(std::log10(largest))) : 1;
}

std::string look_at_text(const CameraFrame& frame) {
  const double distance = target_distance(frame.eye);
  const Vec3d target = frame.eye + frame.forward * distance;
  return "LookAt" + vector_text(frame.eye, distance) + " " + vector_text(target, distance) + " " +
         vector_text(plain_up(frame), 1) + "\n";
}

/// The directive before the LookAt; empty for the identity.
std::string residual_text(const Mat44d& residual) {
  double scale = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) scale = std::max(scale, std::abs(residual[i][j]));
  std::string numbers, diagonal;
  bool is_diagonal = true;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double value = without_noise(residual[i][j], j < 3 && i < 3 ? scale : 1);
      numbers += " " + number_text(value);
      if (i == j && i < 3) diagonal += " " + number_text(value);
      is_diagonal = is_diagonal && (i == j || value == 0);
    }
  if (!is_diagonal) return "Transform [" + numbers + " ]\n";
  return diagonal == " 1 1 1" ? "" : "Scale" + diagonal + "\n";
}

std::string view_text(const Mat44d& world_to_camera) {
  const CameraFrame frame = camera_frame(world_to_camera);
  return residual_text(frame.residual) + look_at_text(frame);
}

std::string view_text(const SceneDescription& description) {
  if (!description.camera) return view_text(Mat44d());
  const TransformDescription& matrices = description.camera->world_to_camera;
  if (!matrices.is_animated()) return view_text(matrices.start);
  return fmt::format("TransformTimes {} {}\n", description.transform_start_time,
                     description.transform_end_time) +
         "ActiveTransform StartTime\n" + view_text(matrices.start) + "ActiveTransform EndTime\n" +
         view_text(matrices.end) + "ActiveTransform All\n";
}

/// `Name "type" parameters` on one line.
std::string directive_text(const std::string& name, const DirectiveDescription& directive) {
  std::string text = name + " " + quoted_text(directive.type);
  for (const Parameter& parameter : directive.parameters.list)
    text += " " + parameter_text(parameter);
  return text + "\n";
}

std::string camera_line(const SceneDescription& description) {
  return description.camera ? directive_text("Camera", *description.camera)
                            : "Camera \"perspective\"\n";
}

/// The text with each line as a comment.
std::string as_comment(const std::string& text) {
  std::string result = "# ";
  for (size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == '\n' && i + 1 < text.size()) result += "# ";
  }
  return result;
}

std::string film_text(const SceneDescription& description) {
  if (!description.film) return "";
  const std::string film = directive_text("Film", *description.film);
  if (description.color_space == "srgb") return film;
  return "ColorSpace " + quoted_text(description.color_space) + "\n" + film +
         "ColorSpace \"srgb\"\n";
}

/// The camera in its medium; the graphics state is the initial one afterwards.
std::string exact_camera_text(const SceneDescription& description) {
  if (!description.camera) return camera_line(description);
  const CameraDescription& camera = *description.camera;
  std::string text =
      transform_text(camera.world_to_camera) + camera_line(description) + "Identity\n";
  if (camera.medium.empty()) return text;
  return "MediumInterface \"\" " + quoted_text(camera.medium) + "\n" + text +
         "MediumInterface \"\" \"\"\n";
}

}  // namespace

std::string camera_text(const SceneDescription& description) {
  return view_text(description) + camera_line(description);
}

std::string scene_text_with_camera(const SceneDescription& description,
                                   const std::string& included) {
  return "# Another camera for the scene that is included at the end. Keep both in one directory.\n"
         "# Of Nephroid, not of pbrt-v4: with \"keepcamera\" the first Camera and Film count.\n"
         "Option \"bool keepcamera\" true\n\n" +
         film_text(description) + "\n# The camera with nine digits:\n" +
         as_comment(view_text(description)) + exact_camera_text(description) + "\nInclude " +
         quoted_text(included) + "\n";
}

}  // namespace nephroid
