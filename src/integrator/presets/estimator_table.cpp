#include "integrator/presets/estimator_table.h"

#include <algorithm>
#include <stdexcept>

#include "integrator/bidirectional/bidirectional.h"
#include "integrator/bidirectional/vertex_connection_merging.h"
#include "integrator/metropolis/multiplexed.h"
#include "integrator/metropolis/primary_space.h"
#include "integrator/mixed/path_and_photons.h"
#include "integrator/path/forecast.h"
#include "integrator/path/path.h"
#include "integrator/photon_mapping/light_tracing.h"
#include "integrator/photon_mapping/photon_map.h"
#include "integrator/photon_mapping/photon_mapping.h"
#include "integrator/photon_mapping/ppm.h"
#include "integrator/photon_mapping/sppm.h"
#include "integrator/photon_mapping/vertex_merging.h"
#include "integrator/virtual_lights/point_lights.h"

namespace nephroid {

EstimatorTable estimator_table() {
  static constexpr const EstimatorDescriptor* kTable[] = {
      &PathEstimator::kDescriptor,
      &PhotonMapping::kDescriptor,
      &Sppm::kDescriptor,
      &LightTracing::kDescriptor,
      &VertexMerging::kDescriptor,
      &Bidirectional::kDescriptor,
      &VertexConnectionMerging::kDescriptor,
      &BidirectionalPhotonMapping::kDescriptor,
      &PathAndPhotons::kDescriptor,
      &Multiplexed::kDescriptor,
      &PrimarySpace::kDescriptor,
      &PhotonMap::kDescriptor,
      &Ppm::kDescriptor,
      &PointLights::kDescriptor,
      &Forecast::kDescriptor,
  };
  return kTable;
}

TraitsTable estimator_traits() {
  static const std::vector<const EstimatorTraits*> traits = [] {
    std::vector<const EstimatorTraits*> all;
    for (const EstimatorDescriptor* row : estimator_table()) all.push_back(&row->traits);
    return all;
  }();
  return traits;
}

const EstimatorDescriptor& descriptor_of(const RouteGroup& group, EstimatorTable table) {
  const auto row = std::ranges::find_if(
      table, [&](const EstimatorDescriptor* d) { return &d->traits == group.estimator; });
  if (row == table.end())
    throw std::logic_error(std::string("estimator ") + group.estimator->name + " has no row");
  return **row;
}

}  // namespace nephroid
