// `vcm`, vertex connection and merging: bidirectional path tracing whose eye paths also merge the
// photons of all light paths of the pass. `bpm`, bidirectional photon mapping: `vcm` that connects
// eye vertices to lights only.
// Papers: Georgiev et al. 2012; Hachisuka, Pantaleoni & Jensen 2012; Vorba 2011.
#pragma once

#include "integrator/bidirectional/pair_pass.h"

namespace nephroid {

/// Default number of light paths of a pass: one per pixel, within bounds.
int64_t default_light_paths(int64_t pixels);

/// Numbers that go into the seeds of the estimators of path pairs, so that those of one plan are
/// independent.
inline constexpr uint64_t kVcmNumber = 6, kBpmNumber = 7, kPathAndPhotonsNumber = 8;

class VertexConnectionMerging : public Estimator {
 public:
  VertexConnectionMerging(OwnedRoutes owned, const IntegratorOptions& options)
      : VertexConnectionMerging(std::move(owned), options, true, kVcmNumber) {}
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  void render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return statistics_; }
  /// The light of one pixel cannot be recorded if light paths are connected to the camera.
  bool records_pixels() const override { return !connects_; }
  void record_pixel(const PixelPass& pixel, const Learned*, PathTally& tally) const override;

 protected:
  VertexConnectionMerging(OwnedRoutes owned, const IntegratorOptions& options, bool connects,
                          uint64_t number)
      : owned_(std::move(owned)), options_(options), connects_(connects), number_(number) {}

 private:
  PairPass pass_of(const PassKey& key, const Scene& scene, const FilmFormat& film,
                   PassControl& control) const;

  OwnedRoutes owned_;
  IntegratorOptions options_;
  bool connects_;
  uint64_t number_;
  EstimatorStatistics statistics_;
};

class BidirectionalPhotonMapping final : public VertexConnectionMerging {
 public:
  BidirectionalPhotonMapping(OwnedRoutes owned, const IntegratorOptions& options)
      : VertexConnectionMerging(std::move(owned), options, false, kBpmNumber) {}
  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
};

}  // namespace nephroid
