#include "integrator/mixed/trials.h"

#include <algorithm>
#include <cmath>

#include "integrator/bidirectional/vertex_connection_merging.h"
#include "integrator/learning/guiding_options.h"
#include "integrator/photons/merge_radius.h"

namespace nephroid {

namespace {

constexpr uint64_t kTrialStream = 0x747269616c;  // "trial"
/// Passes per trial, and camera paths per pixel and pass.
constexpr uint32_t kTrialPasses = 2, kTrialSamples = 2;
static_assert(PixelSlices::kMaxFirstPixels * kTrialSamples * PassRecords::kMaxPerPath <=
                  PassRecords::kMax,
              "each path of a trial must leave records");

/// A pass is planned to keep at most this share of the default of memory_photons, because the
/// number varies. The user's own limit does not count: it must not change the picture.
constexpr double kShareOfMemory = 0.95;

/// First merge radius for photons of all light over that for caustic photons.
constexpr float kRadiusOfAllLight = 4.0f / 3;

float widening(const PairTechniques& techniques, const IntegratorOptions& options) {
  return techniques.merges_all_light() && !(options.radius > 0) ? kRadiusOfAllLight : 1.0f;
}

/// kTrialSamples per pixel in every other tile, none elsewhere.
SampleMap every_other_tile(const FilmFormat& film) {
  SampleMap map(film.bounds(), 1, PixelSlices(film.bounds()).spacing(1));
  for (size_t i = 0; i < map.counts().size(); ++i) {
    const size_t w = map.width();
    map.counts()[i] = (i / w + i % w) % 2 == 0 ? kTrialSamples : 0;
  }
  return map;
}

}  // namespace

float first_radius_of_film(const PairTechniques& techniques, const IntegratorOptions& options,
                           int64_t pixels) {
  return first_radius(options, pixels) * widening(techniques, options);
}

TrialNoise split_noise(std::span<const SampleVariance> passes, const SampleMap& tiles,
                       int samples) {
  // Share of sample pairs that have photons in common.
  const double sharing =
      (samples - 1) / (static_cast<double>(samples) * static_cast<double>(passes.size()) - 1);
  SampleVariance sum = passes.front();
  for (const SampleVariance& pass : passes.subspan(1)) sum.add(pass);
  const SampleVariance::ByTile of_all = sum.by_tile();
  std::vector<double> within(of_all.variance.size());
  for (const SampleVariance& pass : passes) {
    const SampleVariance::ByTile of_pass = pass.by_tile();
    for (size_t t = 0; t < within.size(); ++t)
      within[t] += of_pass.variance[t] * of_pass.brightness[t] / static_cast<double>(passes.size());
  }
  TrialNoise noise;
  std::vector<double> relative_all, relative_within, relative_photons;
  double raw_all = 0, raw_within = 0, raw_photons = 0;
  for (size_t t = 0; t < within.size(); ++t) {
    if (tiles.counts()[t] == 0) continue;
    const double brightness = of_all.brightness[t];
    relative_all.push_back(of_all.variance[t]);
    relative_within.push_back(brightness > 0 ? within[t] / brightness : 0);
    relative_photons.push_back(of_all.photons[t]);
    raw_all += of_all.variance[t] * brightness;
    raw_within += within[t];
    raw_photons += of_all.photons[t] * brightness;
    noise.light += of_all.light[t];
  }
  // The difference is right in the mean, but a few bright camera paths can hide the photons in it.
  // Independent photons bound it from above. Stratified ones have at least half of that.
  const auto photons = [sharing](double all, double camera, double independent) {
    return std::clamp((all - camera) / (1 - sharing), 0.5 * independent, independent);
  };
  const double count = static_cast<double>(std::max<size_t>(1, relative_all.size()));
  noise.light /= count;
  noise.variance_of_camera = raw_within / count;
  noise.variance_of_photons = photons(raw_all, raw_within, raw_photons) / count;
  noise.of_camera = winsorized_mean(std::move(relative_within));
  noise.of_photons = photons(winsorized_mean(std::move(relative_all)), noise.of_camera,
                             winsorized_mean(std::move(relative_photons)));
  return noise;
}

Trials::Trials(uint64_t seed, const Scene& scene, const FilmFormat& film, const OwnedRoutes& owned,
               const IntegratorOptions& options, PassControl& control)
    : seed_(seed),
      scene_(scene),
      film_(film),
      owned_(owned),
      options_(options),
      control_(control),
      spacing_(PixelSlices(film.bounds()).spacing(1)),
      pixels_(static_cast<double>(PixelSlices(film.bounds()).first_pixels())),
      tiles_(every_other_tile(film)) {}

Candidate Trials::run(const PairTechniques& techniques, const EmissionGuide& emission) {
  const PairTrial trial{.paths = tiles_, .counts_records = options_.own<GuidingOptions>().walks};
  EstimatorStatistics counts;
  size_t records = 0;
  // Passes differ by their random numbers alone: noise of wavelengths and time must not count.
  const PassKey key{hash_combine(seed_, kTrialStream), 0};
  std::vector<SampleVariance> passes(kTrialPasses, SampleVariance(film_.bounds(), spacing_));
  for (uint32_t i = 0; i < kTrialPasses; ++i)
    records +=
        run_trial({.key = key,
                   .seed = hash_combine(key.seed, kPathAndPhotonsNumber, i),
                   .scene = scene_,
                   .owned = owned_,
                   .options = options_,
                   .techniques = techniques,
                   // Makes the lattice as noisy as the film with as many light paths per pixel.
                   .radius_pixels = static_cast<float>(spacing_) * radius_of_pass(options_, 0, 0),
                   .photons_for_one = photons_for_one(techniques),
                   .emission = emission,
                   .light_paths_vary = true,
                   .independent_samples = true,
                   .corrects_edges = false,
                   .control = control_},
                  film_, trial, passes[i], counts);
  costs_.rays += counts.rays;
  costs_.hold(counts.photon_bytes, counts.pixel_bytes);
  const Trial found = trial_of(split_noise(passes, tiles_, kTrialSamples), counts, techniques,
                               static_cast<double>(records));
  Balance balance(found);
  balance.max_photons = kShareOfMemory * static_cast<double>(IntegratorOptions{}.memory_photons);
  balance.scale = static_cast<double>(film_.bounds().area()) / pixels_;
  // The variance due to photons is inversely proportional to the merge area.
  balance.variance_of_light /= photons_for_one(techniques);
  // More photons also reduce the variance of camera paths, which one trial does not show.
  if (techniques.merges_all_light())
    balance.min_light_paths = static_cast<double>(film_.bounds().area());
  return {techniques, found, balance};
}

/// Photons that a pass of the film merges for each one of a trial, whose radius is that of a small
/// picture.
float Trials::photons_for_one(const PairTechniques& techniques) const {
  return options_.radius > 0
             ? 1.0f
             : sqr(radius_growth(film_.picture_pixels()) * widening(techniques, options_));
}

Trial Trials::trial_of(const TrialNoise& noise, const EstimatorStatistics& counts,
                       const PairTechniques& techniques, double records) const {
  const double samples = static_cast<double>(counts.camera_paths);
  const double paths_per_pixel = samples / pixels_;
  const double camera_rays =
      static_cast<double>(counts.rays - counts.light_rays - counts.batch_rays);
  const double merges =
      kCostOfMerge * photons_for_one(techniques) * static_cast<double>(counts.photons_merged);
  // Samples of a pass share photons with each other and with neighbouring pixels.
  const double sharing =
      kTrialSamples * std::max(1.0, kPi * sqr(double{first_radius(options_, 0)}));
  return {.variance_of_camera = noise.of_camera,
          .variance_of_light = noise.of_photons,
          .cost_of_camera = camera_rays / paths_per_pixel,
          .cost_of_light =
              static_cast<double>(counts.light_rays) / kTrialPasses + merges / paths_per_pixel,
          .light_paths = static_cast<double>(techniques.light_paths),
          .light = noise.light,
          .error =
              std::sqrt((noise.variance_of_camera + noise.variance_of_photons * sharing) / samples),
          .samples = samples,
          .records = records / samples,
          .photons = counts.photon_paths > 0 ? static_cast<double>(counts.photons_stored) /
                                                   static_cast<double>(counts.photon_paths)
                                             : 0,
          .cost_of_merging = merges / paths_per_pixel,
          .pixels = pixels_};
}

}  // namespace nephroid
