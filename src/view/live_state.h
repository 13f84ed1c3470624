// What a live view is doing, for the page. It must not know threads or the server.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "film/film_format.h"
#include "session/camera_edit.h"
#include "session/light_layers.h"
#include "session/render_session.h"

namespace nephroid {

enum class LiveStatus { kLoading, kRendering, kPaused, kDone, kFailed };

/// The kind of a layer: the page lets the user mix routes or lights.
enum class LayerKind { kPicture, kRoute, kLight, kAov, kFeature };

struct LiveLayer {
  std::string name;
  LayerKind kind = LayerKind::kPicture;
  std::string channels;  ///< a letter for each channel
};

/// The settings that the page can change.
struct LiveSettings {
  std::string integrator;
  std::string routes;  ///< preset or file; empty: those of the integrator
  LayerChoice layers = LayerChoice::kRoutes;
  uint64_t seed = 0;
  double time_limit = 0, noise_target = 0;  ///< 0: none
  int width = 0, height = 0;                ///< full picture
  double crop[4] = {0, 1, 0, 1};            ///< x0, x1, y0, y1
};

struct LiveState {
  std::string name;      ///< of the scene or picture
  bool is_scene = true;  ///< false: a picture, nothing renders
  LiveStatus status = LiveStatus::kLoading;
  std::string message;                     ///< why it failed, or why it is done
  ExitStatus failure = ExitStatus::kDone;  ///< why it failed, as an exit status
  std::vector<std::string> warnings, notes, report;
  uint64_t generation = 0;    ///< counts edits
  uint64_t version = 0;       ///< counts pictures
  int width = 0, height = 0;  ///< full picture
  PixelBounds window;
  bool is_preview = false;
  RenderProgress progress;
  LiveSettings settings;
  std::vector<LiveLayer> layers;
  std::string why_mix_is_inexact;  ///< empty if layers add up exactly
  CameraPose camera;
  std::string camera_type;
  bool is_mirrored = false;  ///< the camera's own space is mirrored: right is left
};

}  // namespace nephroid
