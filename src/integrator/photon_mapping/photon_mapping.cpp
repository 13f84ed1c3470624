#include "integrator/photon_mapping/photon_mapping.h"

#include "integrator/photons/merge_pass.h"

namespace nephroid {

PhotonMapping::PhotonMapping(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options), photons_can_count_(photons_can_count(owned_)) {}

void PhotonMapping::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const int group = static_cast<int>(owned_.group);
  film.add_estimates(group, 1);
  if (!photons_can_count_) return;
  const PhotonGuide& guide = learned_.guide(key.seed, scene, film, owned_, options_, statistics_);
  const MergePass pass = merge_pass(key, scene, film, owned_, options_, guide,
                                    radius_of_pass(options_, key.pass), {}, statistics_);
  const PixelBounds& b = film.bounds();
  const size_t parts = film.parts_of(group).size();
  const Rgb* estimate = pass.values.data();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x, estimate += parts) film.add(group, x, y, {estimate, parts});
  film.add_bias(group, pass.bias);
  found_ += pass.found;
}

EstimatorStatistics PhotonMapping::statistics() const {
  EstimatorStatistics s = statistics_;
  learned_.add_notes(s);
  explain_darkness(owned_, found_, s);
  return s;
}

}  // namespace nephroid
