// Bodies and headers of requests to the view; see targets.h.
#include <cmath>

#include "core/errors.h"
#include "fuzz/targets.h"
#include "view/access.h"
#include "view/view_requests.h"

namespace nephroid::fuzz {
namespace {

/// Checks the guarantees for users of a change.
void check(const CameraChange& change) {
  for (const auto& point : {change.eye, change.target, change.up})
    if (point && !(std::isfinite(point->x) && std::isfinite(point->y) && std::isfinite(point->z)))
      __builtin_trap();
  if (change.fov && !(*change.fov > 0 && *change.fov < 180)) __builtin_trap();
}

void check(const RenderChange& change) {
  if (change.resolution && (change.resolution->first < 1 || change.resolution->second < 1))
    __builtin_trap();
  if (change.crop && !((*change.crop)[0] < (*change.crop)[1])) __builtin_trap();
}

}  // namespace

void view_request(const std::string& bytes) {
  try {
    check(parse_camera_change(bytes));
  } catch (const UsageError&) {
  }
  try {
    check(parse_render_change(bytes));
  } catch (const UsageError&) {
  }
  try {
    const PixelRequest pixel = parse_pixel_request(bytes);
    if (pixel.x < 0 || pixel.y < 0) __builtin_trap();
  } catch (const UsageError&) {
  }
  try {
    MixLayers layers;
    layers.routes = {"caustic"};
    layers.by_light = {{"key", "", "key"}};
    for (const MixGain& gain : parse_mix(bytes, layers).lights)
      if (!(gain.gain.r >= 0) || !gain.gain.is_finite()) __builtin_trap();
  } catch (const UsageError&) {
  }
  static Access access("127.0.0.1", 80);
  // Nobody guesses the cookie.
  if (access.accepts_cookie(bytes) || access.take_token(bytes)) __builtin_trap();
  access.accepts_host(bytes);
  if (Access::accepts_origin(bytes, "localhost") && bytes != "http://localhost") __builtin_trap();
}

}  // namespace nephroid::fuzz
