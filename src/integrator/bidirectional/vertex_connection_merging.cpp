#include "integrator/bidirectional/vertex_connection_merging.h"

#include <algorithm>

namespace nephroid {

int64_t default_light_paths(int64_t pixels) {
  constexpr int64_t kMin = 1 << 12, kMax = 1 << 20;
  return std::clamp(pixels, kMin, kMax);
}

VertexConnectionMerging::VertexConnectionMerging(OwnedRoutes owned,
                                                 const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

void VertexConnectionMerging::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  PairPass pass;
  pass.light_paths = options_.photons_per_pass > 0 ? options_.photons_per_pass
                                                   : default_light_paths(film.bounds().area());
  pass.connects = owned_.routes->groups()[owned_.group].estimator == EstimatorKind::kVcm;
  pass.render(key, scene, film, owned_, options_, statistics_);
}

}  // namespace nephroid
