// Vertex connection and merging: everything that bidirectional path tracing does, and eye paths are
// merged with the vertices of all light paths of the pass as well. `bpm`, bidirectional photon
// mapping, is the same with nothing connected but lights.
// Papers: Georgiev et al. 2012; Hachisuka, Pantaleoni & Jensen 2012; Vorba 2011.
#pragma once

#include "integrator/bidirectional/pair_pass.h"

namespace nephroid {

/// Light paths of a pass: one for each pixel, within bounds; they are shared or spare outside.
int64_t default_light_paths(int64_t pixels);

/// Numbers of the estimators of pairs in their seeds: those of one plan are independent of each
/// other.
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

 protected:
  VertexConnectionMerging(OwnedRoutes owned, const IntegratorOptions& options, bool connects,
                          uint64_t number)
      : owned_(std::move(owned)), options_(options), connects_(connects), number_(number) {}

 private:
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
