#include "integrator/mixed/path_and_photons.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "integrator/bidirectional/pair_recording.h"
#include "integrator/bidirectional/vertex_connection_merging.h"
#include "integrator/estimator/exposed_pixels.h"
#include "integrator/estimator/reach.h"
#include "integrator/learning/guiding_options.h"
#include "integrator/mixed/learned_mix.h"
#include "integrator/mixed/trials.h"
#include "integrator/path/specular_tree.h"
#include "integrator/photons/merge_radius.h"
#include "integrator/photons/missing_caustics.h"
#include "integrator/photons/photon_pass.h"

namespace nephroid {

namespace {

constexpr const EstimatorSetting* kMixedSettings[] = {&kGuideSetting, &kGuideWalksSetting};
constexpr uint64_t kMeasureStream = 0x6d656173757265;  // "measure"
/// Required gain of merging more photons. Two passes are a rough estimate: they see neither the
/// bias of merging nor the gain of camera paths from stratification over later passes.
constexpr double kRequiredGain = 1.25;
/// Required gain of merging direct light as well. Its edges (shadows, patterns of lamps) are the
/// sharpest of all, so that after minutes their bias would be the largest error.
constexpr double kRequiredGainOfDirectLight = 4;
/// Photons straight from lights are tried if the others are not worse than caustic photons by this.
constexpr double kWorthATrial = 1.5;
/// Share of useful photon paths from which on guiding their emission costs more than it gains.
constexpr double kEnoughUseful = 0.125;

/// Camera paths per pixel of the lattice in the measured pass.
constexpr int kMeasuredSamples = 8;
int spacing_of(const FilmFormat& film) {
  return PixelSlices(film.bounds()).spacing(1);
}

TileStatistics tile_statistics(const PairFindings::Variance& v, bool separates_chains) {
  if (!separates_chains) return {v.paths.by_tile(), {}, {}};
  return {v.paths.by_tile(&v.chains.walks), v.chains.walks.by_tile(&v.paths),
          v.chains.choice.by_tile(&v.paths)};
}

/// True if paths of the group may have events in a medium of the scene.
bool scatters_in_media(const OwnedRoutes& owned, const Scene& scene) {
  return has_events(owned, EventClass::kVolume) &&
         std::ranges::any_of(scene.media,
                             [](const MediumPtr& m) { return !m->is_purely_absorbing(); });
}

/// True if only photons can find the caustics that a medium shows: those of lights that no walk can
/// hit.
bool needs_photons_in_media(const OwnedRoutes& owned, const Scene& scene) {
  return scatters_in_media(owned, scene) && has_events(owned, EventClass::kSpecular) &&
         std::ranges::any_of(scene.lights, [](const LightPtr& l) { return l->is_delta(); });
}

}  // namespace

constinit const EstimatorDescriptor PathAndPhotons::kDescriptor = {
    .traits = {.name = "path+photons",
               .help = "path tracing, and photons of caustics, each weighed against the other",
               .starts_at_lights = true,
               .why_never_sampled = out_of_reach_of_merging_in_media},
    .settings = kMixedSettings,
    .merges_with_radius = true,
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = bytes_per_pixel(need.parts, need.clamps,
                                                       need.options.camera_samples_per_pass)};
        },
    .exposed_pixels =
        [](const IntegratorOptions& options, const PixelFilter&, int64_t pixels) {
          return pixels_within(first_radius_of_film(PairTechniques{}, options, pixels));
        },
    .make = make_estimator<PathAndPhotons>,
};

PathAndPhotons::PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {
  statistics_.tells_lamps = true;
}

PathAndPhotons::Choice PathAndPhotons::best_of(
    Trials& trials, const Scene& scene, const FilmFormat& film,
    const std::function<GuidedPhotons(ClassMask)>& photons_of) const {
  PairTechniques techniques{
      .light_paths = std::max<int64_t>(PixelSlices(film.bounds()).first_pixels(), 1 << 14),
      .connects = false,
      // If the film clamps, the limit of a sample must hold for all of its light.
      .separates_chains = film.settings().max_component == kInfinity &&
                          SpecularTree(scene, owned_, options_.max_depth).finds_something(),
      .roulette_threshold = kCameraRouletteThreshold};
  const auto try_photons = [&](ClassMask casters, GuidedPhotons photons) {
    techniques.casters = casters;
    Choice choice{trials.run(techniques, photons.guide.starts), std::move(photons)};
    return choice;
  };
  GuidedPhotons guided = photons_of(ClassMask::kAll);
  // Camera paths ask for the density of each start, which takes some time.
  techniques.gathers_in_media = scatters_in_media(owned_, scene);
  // The guide knows what lights visible surfaces, not what lights fog.
  if (techniques.gathers_in_media || guided.guide.starts.share_unaimed() > kEnoughUseful)
    guided.guide = {};
  Choice all = try_photons(ClassMask::kAll, guided);
  techniques.gathers_in_media = false;
  const auto for_all_light = [](Choice choice) {
    choice.candidate.balance.let_photons_lower_variance_of_camera(choice.candidate.trial);
    // Separate walks for specular chains would cost more than these short camera paths.
    PairTechniques& own = choice.candidate.techniques;
    own.follows_chains = std::exchange(own.separates_chains, false);
    return choice;
  };
  if (needs_photons_in_media(owned_, scene)) return for_all_light(std::move(all));
  const auto inverse_efficiency = [most_light = all.candidate.trial](Candidate of) {
    // Photons of all light find all that caustic photons find, though they lose light at edges.
    of.balance.variance_of_camera += of.trial.min_variance_of_unseen(most_light);
    return of.balance.inverse_efficiency();
  };
  // Keeps `other` instead of `best` if it is better by `gain`; the rays of both have been traced.
  const auto keep_better = [&](Choice& best, Choice other, double gain) {
    const uint64_t rays = best.photons.rays + other.photons.rays;
    if (gain * inverse_efficiency(other.candidate) < inverse_efficiency(best.candidate))
      best = std::move(other);
    best.photons.rays = rays;
  };
  const int64_t light_paths = techniques.light_paths;
  if (!has_events(owned_, EventClass::kSpecular)) techniques.light_paths = 0;
  Choice best = try_photons(ClassMask::kSpecular, photons_of(ClassMask::kSpecular));
  techniques.light_paths = light_paths;
  const ClassMask with_glossy = ClassMask::kSpecular | ClassMask::kGlossy;
  // A part of the photons cannot leave camera paths less noise than all photons do.
  if (has_events(owned_, EventClass::kGlossy) &&
      kRequiredGain * all.candidate.balance.variance_of_camera <
          best.candidate.balance.variance_of_camera +
              best.candidate.trial.min_variance_of_unseen(all.candidate.trial))
    keep_better(best, try_photons(with_glossy, photons_of(with_glossy)), kRequiredGain);
  if (has_events(owned_, EventClass::kHair)) {
    // Merging all light would blur the fine shadows of hair.
    best.photons.rays += all.photons.rays;
  } else {
    guided.rays = 0;
    if (inverse_efficiency(all.candidate) < kWorthATrial * inverse_efficiency(best.candidate))
      keep_better(all, try_photons(ClassMask::kNone, std::move(guided)),
                  kRequiredGainOfDirectLight);
    keep_better(best, std::move(all), kRequiredGain);
  }
  if (best.candidate.techniques.merges_all_light()) return for_all_light(std::move(best));
  // [A5]
  techniques = best.candidate.techniques;
  techniques.roulette_threshold = kPatientRouletteThreshold;
  const Candidate patient = trials.run(techniques, best.photons.guide.starts);
  if (inverse_efficiency(patient) < inverse_efficiency(best.candidate)) best.candidate = patient;
  return best;
}

std::shared_ptr<const Learned> PathAndPhotons::learn(const Scene& scene, const FilmFormat& film,
                                                     uint64_t seed, PassControl& control) const {
  const int64_t pixels = PixelSlices(film.bounds()).first_pixels();
  const int asked = options_.camera_samples_per_pass;
  MixPlan plan;
  Trials trials(seed, scene, film, owned_, options_, control);
  Choice choice = best_of(trials, scene, film, [&](ClassMask casters) {
    return guide_photons_of(casters, seed, scene, film, options_, control);
  });
  plan.photons = std::move(choice.photons);
  const Candidate& best = choice.candidate;
  PairTechniques& chosen = plan.techniques;
  chosen = best.techniques;
  // Without photons there is nothing to balance, with the user's number nothing to choose.
  const bool balances = chosen.light_paths > 0 && !(options_.photons_per_pass > 0);
  if (options_.photons_per_pass > 0)
    chosen.light_paths = options_.photons_per_pass;
  else if (balances)
    chosen.light_paths = best.balance.light_paths(std::max(asked, 1));
  // With photons of all light, a second camera path gains little or nothing (ADR 31).
  plan.is_even = asked > 0 || chosen.merges_all_light();
  const double records_per_path =
      std::clamp(1.1 * best.trial.records, 0.25, double{PassRecords::kMaxPerPath});
  EstimatorStatistics costs = trials.costs();
  SampleMap measured(film.bounds(), kMeasuredSamples, spacing_of(film));
  plan.samples = {SampleMap(film.bounds(), static_cast<uint16_t>(std::max(asked, 1))),
                  SampleMap(film.bounds(), static_cast<uint16_t>(std::max(asked, 1)))};
  const PairLearning learning{
      .measures_variance = !plan.is_even,
      .keeps_records = !chosen.merges_all_light() && options_.own<GuidingOptions>().walks,
      .records_per_path = records_per_path};
  if (learning.measures_variance || learning.keeps_records) {
    const PassKey key{hash_combine(seed, kMeasureStream), 0};
    PairPass pass = pass_of(key, scene, film, plan, control);
    // As many light paths per pixel of the lattice as the film has per pixel.
    const double scale = static_cast<double>(film.bounds().area()) / static_cast<double>(pixels);
    int64_t& light_paths = pass.techniques.light_paths;
    light_paths = static_cast<int64_t>(std::ceil(static_cast<double>(light_paths) / scale));
    pass.radius_pixels *= static_cast<float>(spacing_of(film));
    pass.corrects_edges = false;
    PairFindings found = measure(pass, film, {measured, measured}, learning, costs);
    if (found.variance) {
      const TileStatistics tiles = tile_statistics(*found.variance, chosen.separates_chains);
      MeanLimits limits = limits_of_film(film.bounds().area());
      if (balances) limits.paths = std::clamp(best.balance.max_camera_paths(), 1.0, limits.paths);
      plan.samples = allocate_samples(film.bounds(), spacing_of(film), tiles, limits);
      if (balances)
        chosen.light_paths = best.balance.light_paths(
            PassNoise(tiles, plan.samples, scale * static_cast<double>(light_paths)));
    }
    const size_t record_bytes = found.records.capacity() * sizeof(RadianceRecord);
    plan.directions = RadianceGuide(std::move(found.records));
    // Sorting the records takes half their memory in addition.
    costs.hold(record_bytes + record_bytes / 2 + plan.directions.bytes(), 0);
  }
  plan.rays = costs.rays;
  plan.photon_bytes = costs.photon_bytes;
  plan.pixel_bytes = costs.pixel_bytes;
  return std::make_shared<const LearnedMix>(std::move(plan));
}

float PathAndPhotons::radius_of(const MixPlan& plan, const FilmFormat& film, uint32_t pass) const {
  const float radius = first_radius_of_film(plan.techniques, options_, film.picture_pixels()) *
                       shrinkage(options_, pass);
  // A number that the user sets is the same in a crop, which must not change the radius.
  if (!plan.techniques.merges_all_light() || options_.photons_per_pass > 0) return radius;
  return radius * shrinkage_by_photons(options_, static_cast<double>(plan.techniques.light_paths) /
                                                     static_cast<double>(film.bounds().area()));
}

PairPass PathAndPhotons::pass_of(const PassKey& key, const Scene& scene, const FilmFormat& film,
                                 const MixPlan& plan, PassControl& control) const {
  PairPass pass{.key = key,
                .seed = hash_combine(key.seed, kPathAndPhotonsNumber),
                .scene = scene,
                .owned = owned_,
                .options = options_,
                .techniques = plan.techniques,
                .radius_pixels = radius_of(plan, film, key.pass),
                .emission = plan.photons.guide.starts,
                .light_paths_vary = true,
                .control = control};
  return pass;
}

std::shared_ptr<const Learned> PathAndPhotons::read_learned(ByteReader& from,
                                                            const FilmFormat& film) const {
  MixPlan plan;
  from(plan);
  const int64_t photons = options_.photons_per_pass, light_paths = plan.techniques.light_paths;
  expect_sound(photons > 0 ? light_paths == photons
                           : static_cast<double>(light_paths) <= kMaxLightPaths);
  const int asked = options_.camera_samples_per_pass;
  const auto fits = [&](const SampleMap& map, int min, int max) {
    return map.is_sound(film.bounds(), spacing_of(film), min, std::max(max, asked));
  };
  expect_sound(fits(plan.samples.paths, 1, SampleMap::kMax) &&
               fits(plan.samples.chains, 0, SampleMap::kMaxChainWalks));
  expect_sound(plan.photons.guide.starts.fits(owned_.symbols->lights()));
  return std::make_shared<const LearnedMix>(std::move(plan));
}

void PathAndPhotons::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                                 Film& film, PassControl& control) {
  const MixPlan& plan = static_cast<const LearnedMix*>(learned)->plan();
  leaves_glossy_ = plan.techniques.casters == ClassMask::kSpecular;
  render(pass_of(key, scene, film.format(), plan, control),
         {.film = film,
          .samples = {plan.samples.paths, plan.samples.chains},
          .adds_features = true,
          .directions = plan.directions},
         statistics_);
}

void PathAndPhotons::record_pixel(const PixelPass& pixel, const Learned* learned,
                                  PathTally& tally) const {
  const MixPlan& plan = static_cast<const LearnedMix*>(learned)->plan();
  const FilmFormat& film = pixel.film;
  PairPass pass = pass_of(pixel.key, pixel.scene, film, plan, unwatched);
  pass.radius_pixels = radius_of(plan, film, pixel.radius_pass);
  const PixelBounds& b = film.bounds();
  const bool separates_chains = plan.techniques.separates_chains &&
                                plan.samples.chains.at(pixel.x - b.x0, pixel.y - b.y0) > 0;
  nephroid::record_pixel(pass, pixel, plan.directions, separates_chains, tally);
}

EstimatorStatistics PathAndPhotons::statistics() const {
  EstimatorStatistics s = statistics_;
  explain_missing_caustics(owned_, s);
  explain_glossy_caustics(owned_, leaves_glossy_, s);
  return s;
}

}  // namespace nephroid
