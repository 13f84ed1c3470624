#include "integrator/bidirectional/vertex_connection_merging.h"

#include <algorithm>

#include "integrator/bidirectional/pair_recording.h"
#include "integrator/estimator/reach.h"
#include "integrator/path/path_options.h"
#include "integrator/photons/merge_radius.h"

namespace nephroid {

namespace {

constexpr const EstimatorSetting* kVcmSettings[] = {&kTechniqueSetting, &kSpecularTreesSetting};

template <bool kConnects>
PixelBytes bytes_of(const PixelMemoryInput& need) {
  return {.of_pass = pair_pass_bytes_per_pixel(need.parts, 1, need.clamps, kConnects)};
}

}  // namespace

constinit const EstimatorDescriptor VertexConnectionMerging::kDescriptor = {
    .traits = {.name = "vcm",
               .help = "vertex connection and merging: bdpt, and photons merged at all vertices",
               .starts_at_lights = true,
               .why_never_sampled = out_of_reach_of_both},
    .settings = kVcmSettings,
    .merges_with_radius = true,
    .keeps_photons = true,
    .bytes_per_pixel = bytes_of<true>,
    .exposed_pixels = pixels_of_merging_and_splats,
    .make = make_estimator<VertexConnectionMerging>,
};

constinit const EstimatorDescriptor BidirectionalPhotonMapping::kDescriptor = {
    .traits = {.name = "bpm",
               .help = "bidirectional photon mapping: vcm without connections of two walks",
               .starts_at_lights = true,
               .why_never_sampled = out_of_reach_of_merging},
    .settings = kVcmSettings,
    .merges_with_radius = true,
    .keeps_photons = true,
    .bytes_per_pixel = bytes_of<false>,
    .exposed_pixels = pixels_of_merging,
    .make = make_estimator<BidirectionalPhotonMapping>,
};

int64_t default_light_paths(int64_t pixels) {
  constexpr int64_t kMinPaths = 1 << 12, kMaxPaths = 1 << 20;
  return std::clamp(pixels, kMinPaths, kMaxPaths);
}

PairPass VertexConnectionMerging::pass_of(const PassKey& key, const Scene& scene,
                                          const FilmFormat& film, PassControl& control) const {
  PairPass pass{.key = key,
                .seed = hash_combine(key.seed, number_),
                .scene = scene,
                .owned = owned_,
                .options = options_,
                .technique = options_.own<TechniqueChoice>(),
                .control = control};
  pass.techniques.light_paths = options_.photons_per_pass > 0
                                    ? options_.photons_per_pass
                                    : default_light_paths(film.bounds().area());
  pass.techniques.connects = connects_;
  pass.radius_pixels = radius_of_pass(options_, film.picture_pixels(), key.pass);
  return pass;
}

void VertexConnectionMerging::render_pass(const PassKey& key, const Learned*, const Scene& scene,
                                          Film& film, PassControl& control) {
  statistics_.tells_lamps = true;
  const SampleMap one_path(film.bounds()), no_walks(film.bounds(), 0);
  render(pass_of(key, scene, film.format(), control),
         {.film = film, .samples = {one_path, no_walks}}, statistics_);
}

void VertexConnectionMerging::record_pixel(const PixelPass& pixel, const Learned*,
                                           PathTally& tally) const {
  PairPass pass = pass_of(pixel.key, pixel.scene, pixel.film, unwatched);
  pass.radius_pixels = radius_of_pass(options_, pixel.film.picture_pixels(), pixel.radius_pass);
  nephroid::record_pixel(pass, pixel, kNoRadiance, false, tally);
}

}  // namespace nephroid
