// What the page asks for, as JSON, and the changes of a live render that it stands for. It must not
// know how they are carried out.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/math.h"
#include "image/mix.h"
#include "session/camera_edit.h"
#include "session/light_layers.h"

namespace nephroid {

/// Changes of a pose; what is empty stays.
struct CameraChange {
  std::optional<Vec3d> eye, target, up;
  std::optional<double> fov, lens_radius, focal_distance;
  std::optional<std::array<double, 2>> shutter;
  bool is_moving = false;  ///< coarse pictures, since more changes follow

  CameraPose applied_to(CameraPose pose) const;
};

enum class RenderAction { kNone, kPause, kResume, kRestart };

/// Changes of a render; what is empty stays. Any but pause and resume begins anew.
struct RenderChange {
  RenderAction action = RenderAction::kNone;
  std::optional<std::string> integrator;
  std::optional<std::string> routes;  ///< preset; empty text: those of the integrator
  std::optional<LayerChoice> layers;
  std::optional<uint64_t> seed;
  std::optional<double> time, noise;  ///< 0: no limit
  std::optional<std::pair<int, int>> resolution;
  std::optional<std::array<double, 4>> crop;  ///< x0, x1, y0, y1 in [0,1]

  bool has_settings() const;
  bool begins_anew() const { return action == RenderAction::kRestart || has_settings(); }
};

/// A pixel of the full picture.
struct PixelRequest {
  int x = 0, y = 0;
};

/// Read the body of a request. Throw UsageError: what is wrong, and what was expected.
CameraChange parse_camera_change(std::string_view body);
RenderChange parse_render_change(std::string_view body);
PixelRequest parse_pixel_request(std::string_view body);
/// Gains of layers: {"key":2,"caustic":[1,0.9,0.8]}. The names are those of layers that can be
/// mixed.
Mix parse_mix(std::string_view text, const MixLayers& layers);

/// "routes", "lights" or "both".
const char* layer_choice_name(LayerChoice choice);

}  // namespace nephroid
