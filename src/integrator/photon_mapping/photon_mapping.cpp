#include "integrator/photon_mapping/photon_mapping.h"

#include "integrator/learning/guiding_options.h"
#include "integrator/learning/photon_guiding.h"
#include "integrator/photons/merge_pass.h"
#include "integrator/photons/merge_radius.h"
#include "integrator/photons/missing_caustics.h"

namespace nephroid {

namespace {

constexpr const EstimatorSetting* kSettings[] = {&kGuideSetting};

}  // namespace

constinit const EstimatorDescriptor PhotonMapping::kDescriptor = {
    .traits = {.name = "photons",
               .help = "photons merged with a radius that shrinks from pass to pass",
               .merges = true,
               .starts_at_lights = true},
    .settings = kSettings,
    .merges_with_radius = true,
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = MergePass::bytes_per_pixel(need.parts)};
        },
    .exposed_pixels = pixels_of_merging,
    .make = make_estimator<PhotonMapping>,
};

PhotonMapping::PhotonMapping(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options), photons_can_count_(photons_can_count(owned_)) {}

std::shared_ptr<const Learned> PhotonMapping::learn(const Scene& scene, const FilmFormat& film,
                                                    uint64_t seed, PassControl& control) const {
  return std::make_shared<LearnedPhotons>(
      guide_photons(seed, scene, film, owned_, options_, true, control));
}

std::shared_ptr<const Learned> PhotonMapping::read_learned(ByteReader& from,
                                                           const FilmFormat&) const {
  GuidedPhotons photons;
  from(photons);
  expect_sound(photons.guide.starts.fits(owned_.symbols->lights()));
  return std::make_shared<LearnedPhotons>(std::move(photons));
}

void PhotonMapping::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                                Film& film, PassControl& control) {
  const int group = static_cast<int>(owned_.group);
  if (!photons_can_count_) {
    film.add_estimates(group, 1);
    return;
  }
  const PhotonGuide& guide = static_cast<const LearnedPhotons*>(learned)->guide();
  const MergePass pass = merge_pass(
      key, scene, film, owned_, options_, guide,
      radius_of_pass(options_, film.format().picture_pixels(), key.pass), {}, statistics_, control);
  const PixelBounds& b = film.bounds();
  const size_t parts = film.parts_of(group).size();
  const Rgb* estimate = pass.values.data();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x, estimate += parts) film.add(group, x, y, {estimate, parts});
  film.add_bias(group, pass.bias);
  film.add_estimates(group, 1);
  found_ += pass.found;
}

EstimatorStatistics PhotonMapping::statistics() const {
  EstimatorStatistics s = statistics_;
  explain_darkness(owned_, found_, s);
  return s;
}

}  // namespace nephroid
