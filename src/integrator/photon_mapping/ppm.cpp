#include "integrator/photon_mapping/ppm.h"

#include <algorithm>

#include "core/counted.h"
#include "input/option_values.h"
#include "scene/scene.h"
#include "transport/path_points.h"

namespace nephroid {

namespace {

constexpr int kMinHitPoints = 4, kMaxHitPoints = 16;

const EstimatorSetting kHitPointsSetting = {
    "hit-points",
    "N",
    "0",
    "hit points",
    "Hit points of a pixel, which stay from pass to pass. More of them take memory and make edges "
    "smoother; 0 takes the scene's samples per pixel, at least 4 and at most 16.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<PpmOptions>().hit_points = parse_int("-D hit-points", text, 0);
    },
    [](const IntegratorOptions& options) {
      return std::to_string(options.own<PpmOptions>().hit_points);
    }};

constexpr const EstimatorSetting* kPpmSettings[] = {&kHitPointsSetting};

}  // namespace

constinit const EstimatorDescriptor Ppm::kDescriptor = {
    .traits = {.name = "ppm",
               .help = "progressive photon mapping with hit points that stay",
               .merges = true,
               .starts_at_lights = true},
    // Light outside the hit points of a pixel is never found.
    .capabilities = {.independent_passes = false, .per_pixel_state = true, .consistent = false},
    .settings = kPpmSettings,
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          const auto points = static_cast<size_t>(hit_points(need.options, need.samples_per_pixel));
          return PixelBytes{.kept = points * bytes_kept(need.parts),
                            .of_pass = points * bytes_of_pass(need.parts)};
        },
    .exposed_pixels = pixels_of_first_radius,
    .outlier_warning = kNoEstimatesToHold,
    .make = make_estimator<Ppm>,
};

int Ppm::hit_points(const IntegratorOptions& options, int samples_per_pixel) {
  const int asked = options.own<PpmOptions>().hit_points;
  return asked > 0 ? asked : std::clamp(samples_per_pixel, kMinHitPoints, kMaxHitPoints);
}

int Ppm::regions_per_pixel(const Scene& scene) const {
  return hit_points(options_, scene.samples_per_pixel);
}

std::span<const SobolPoint> Ppm::points(const PhotonPass&, const Scene& scene) {
  while (points_.size() < static_cast<size_t>(regions_per_pixel(scene)))
    points_.push_back(eye_point(static_cast<uint32_t>(points_.size())));
  return points_;
}

EstimatorStatistics Ppm::statistics() const {
  EstimatorStatistics s = Sppm::statistics();
  if (!points_.empty())
    s.notes.push_back(counted(points_.size(), "hit point") +
                      " per pixel, kept from pass to pass; a pass needs " +
                      std::to_string((s.pixel_bytes + 1023) / 1024) + " KiB (-D hit-points=N)");
  return s;
}

}  // namespace nephroid
