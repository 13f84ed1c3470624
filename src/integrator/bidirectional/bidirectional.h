// `bdpt`, bidirectional path tracing: each camera path has a light path of its own, and the two are
// connected in all ways. Light paths are also splatted onto the film.
// Papers: Lafortune & Willems 1993; Veach & Guibas 1994; Veach 1997, chapter 10.
#pragma once

#include "film/splats.h"
#include "integrator/estimator/estimator.h"
#include "route/scene_symbols.h"

namespace nephroid {

class Bidirectional final : public Estimator {
 public:
  Bidirectional(OwnedRoutes owned, const IntegratorOptions& options);
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return statistics_; }

  /// Memory of a pass per pixel.
  static constexpr size_t bytes_per_pixel(size_t parts) {
    return SplatBuffer::bytes_per_pixel(parts) + parts * sizeof(Rgb);
  }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  EstimatorStatistics statistics_;
};

}  // namespace nephroid
