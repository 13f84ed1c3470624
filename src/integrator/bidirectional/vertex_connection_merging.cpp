#include "integrator/bidirectional/vertex_connection_merging.h"

#include <algorithm>

namespace nephroid {

int64_t default_light_paths(int64_t pixels) {
  constexpr int64_t kMin = 1 << 12, kMax = 1 << 20;
  return std::clamp(pixels, kMin, kMax);
}

std::unique_ptr<PassFindings> VertexConnectionMerging::render_pass(const PassKey& key,
                                                                   const Learned*,
                                                                   const Scene& scene, Film& film) {
  PairPass pass{.key = key,
                .seed = hash_combine(key.seed, number_),
                .scene = scene,
                .owned = owned_,
                .options = options_,
                .technique = options_.technique};
  pass.techniques.light_paths = options_.photons_per_pass > 0
                                    ? options_.photons_per_pass
                                    : default_light_paths(film.bounds().area());
  pass.techniques.connects = connects_;
  const SampleMap one_path(film.bounds()), no_walks(film.bounds(), 0);
  render(pass, {.film = film, .samples = {one_path, no_walks}}, statistics_);
  return nullptr;
}

}  // namespace nephroid
