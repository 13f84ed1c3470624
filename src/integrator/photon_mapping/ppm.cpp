#include "integrator/photon_mapping/ppm.h"

#include <algorithm>

#include "scene/scene.h"
#include "transport/path_points.h"

namespace nephroid {

namespace {

constexpr int kFewest = 4, kMost = 16;

}  // namespace

int Ppm::hit_points(const IntegratorOptions& options, int samples_per_pixel) {
  return options.hit_points > 0 ? options.hit_points
                                : std::clamp(samples_per_pixel, kFewest, kMost);
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
    s.notes.push_back(std::to_string(points_.size()) +
                      " hit points per pixel stay from pass to pass; passes with them take " +
                      std::to_string((s.pixel_bytes + 1023) / 1024) + " KiB (-D hit-points=N)");
  return s;
}

}  // namespace nephroid
