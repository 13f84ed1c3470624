#include "integrator/bidirectional/pair_recording.h"

#include <algorithm>

#include "integrator/bidirectional/pair_sampler.h"

namespace nephroid {

namespace {

/// Reduces the light paths to at most `limit`. The weights stay those of all of them.
void reduce_light_paths(PairPass& pass, int64_t limit) {
  int64_t& paths = pass.techniques.light_paths;
  const int64_t fewer = std::min(paths, limit);
  if (fewer > 0) pass.photons_for_one *= static_cast<float>(paths) / static_cast<float>(fewer);
  paths = fewer;
}

/// Records the pixel's walks for specular chains.
void record_chains(const PairSampler& sampler, PathTally& tally) {
  const SpecularChainPass chains{.scene = sampler.in.scene,
                                 .film = sampler.format,
                                 .owned = sampler.in.owned,
                                 .tree = sampler.tree,
                                 .walks = *sampler.camera.chains,
                                 .seed = sampler.in.seed,
                                 .specular_alpha = sampler.settings.specular_alpha};
  SpecularChainPass::Walker walker(chains);
  walker.recorder = &tally;
  std::vector<Rgb> values(sampler.parts);
  chains.look(0, 0, chains.points([&](int n) { return sampler.first_index(n); }), values, walker);
}

}  // namespace

void record_pixel(PairPass pass, const PixelPass& pixel, const RadianceGuide& directions,
                  bool separates_chains, PathTally& tally) {
  reduce_light_paths(pass, pixel.light_paths);
  const FilmFormat format = pixel.format_of_pixel();
  const uint16_t samples = static_cast<uint16_t>(pixel.camera_paths);
  const SampleMap paths(format.bounds(), samples);
  const SampleMap chains(format.bounds(), separates_chains ? samples : uint16_t{0});
  const CameraSide camera{paths, &chains, directions};
  PairSampler sampler(pass, format, camera, nullptr, nullptr, PassRecords::kMaxPerPath);
  LightBatches batches({.light_paths = pass.techniques.light_paths,
                        .memory_photons = 1,  // one group of paths tells the distance
                        .seed = pass.seed,
                        .number_varies = pass.light_paths_vary},
                       sampler.photons, sampler.settings);
  if (pass.techniques.gathers_in_media) {
    EstimatorStatistics unused;
    batches.next([](std::span<const Splat>) {}, unused);
    sampler.merging.media_distance = batches.media_distance();
  }
  std::vector<CameraSplat> seen;
  PhotonHistories photons(
      pass.techniques.light_paths,
      [&](int64_t j, std::vector<Photon>& into) { batches.trace_path(j, seen, into); },
      [&](int64_t j) { return batches.record_path(j); },
      [&](const Vec3f& p) { return sampler.merging.radius_in_media_at(p); });
  sampler.merging.merge(photons.maps());
  tally.use(photons);
  PairRow row;
  PairSampler::Worker worker(sampler, row);
  worker.recorder = &tally;
  std::vector<Rgb> values(sampler.parts);
  float bias = 0;
  for (int k = 0; k < samples; ++k)
    sampler.trace(pixel.x, pixel.y, samples, k, worker, {values, bias});
  if (separates_chains) record_chains(sampler, tally);
}

}  // namespace nephroid
