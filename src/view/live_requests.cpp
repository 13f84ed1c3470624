#include "view/live_requests.h"

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

/// Without a stop rule a view renders until it is closed.
constexpr uint32_t kEndlessPasses = 1u << 30;

}  // namespace

RenderRequest full_request(const RenderRequest& request) {
  RenderRequest result = request;
  RenderOptions& options = result.options;
  result.resume_from = options.output;
  options.output.clear();
  if (!options.last_pass && !(options.time_limit > 0) && !(options.noise_target > 0))
    options.last_pass = kEndlessPasses;
  return result;
}

RenderRequest preview_request(const RenderRequest& request, const FilmDescription& full,
                              double edge) {
  RenderRequest preview = full_request(request);
  const double scale = std::min(1.0, edge / std::max(full.width, full.height));
  preview.overrides.width = std::max(1, static_cast<int>(std::lround(full.width * scale)));
  preview.overrides.height = std::max(1, static_cast<int>(std::lround(full.height * scale)));
  // The crop of the full picture, whichever way it was given.
  preview.overrides.has_crop = true;
  const int crop[4] = {full.crop_x0, full.crop_x1, full.crop_y0, full.crop_y1};
  for (int i = 0; i < 4; ++i) {
    const int full_edge = i < 2 ? full.width : full.height;
    const int edge_now = i < 2 ? preview.overrides.width : preview.overrides.height;
    const double at = 1.0 * crop[i] / full_edge * edge_now;
    // Rounded outwards, so at least one pixel is left.
    const double pixel = i % 2 == 0 ? std::floor(at) : std::ceil(at);
    preview.overrides.crop[i] = static_cast<float>(pixel / edge_now);
  }
  preview.routes = {};
  preview.routes.integrator = "path";
  preview.reject_outliers = false;
  preview.options.show_error = false;
  preview.options.learns_lights = false;
  preview.options.time_limit = preview.options.noise_target = 0;
  preview.options.last_pass = kEndlessPasses;
  return preview;
}

}  // namespace nephroid
