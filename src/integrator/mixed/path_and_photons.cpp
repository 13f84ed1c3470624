#include "integrator/mixed/path_and_photons.h"

#include <algorithm>
#include <cmath>

#include "integrator/bidirectional/vertex_connection_merging.h"
#include "integrator/estimator/reach.h"
#include "integrator/learning/guiding_options.h"
#include "integrator/mixed/learned_mix.h"
#include "integrator/path/specular_tree.h"
#include "integrator/photons/merge_pass.h"
#include "integrator/photons/photon_pass.h"

namespace nephroid {

namespace {

constexpr const EstimatorSetting* kSettings[] = {&kGuideSetting, &kGuideWalksSetting};
constexpr uint64_t kTrialStream = 0x747269616c;        // "trial"
constexpr uint64_t kMeasureStream = 0x6d656173757265;  // "measure"
/// Passes of a trial, and camera paths of a pixel in each.
constexpr uint32_t kTrialPasses = 2, kTrialSamples = 2;
/// Merging all photons has to be better by this factor: two passes are a rough guess, and do not
/// see that camera paths alone, whose points fill the gaps of earlier ones, gain more from passes
/// to come, nor the bias of what is merged.
constexpr double kRequiredGain = 1.25;

/// Camera paths of each pixel of the lattice in the pass that is measured.
constexpr int kMeasuredSamples = 8;
constexpr double kMinPhotonBytes = 44 << 20, kPhotonBytesPerPixel = 44;
/// Those that are held at once by default, with room for chance.
constexpr double kMaxPhotons = 0.95 * (1 << 20);
/// With its place in the grid.
constexpr double kBytesOfPhoton = sizeof(Photon) + sizeof(Vec3f) + 24;

/// Photons of a pass for a film of so many pixels.
double max_photons(const FilmFormat& film) {
  const double bytes =
      std::max(kMinPhotonBytes, kPhotonBytesPerPixel * static_cast<double>(film.bounds().area()));
  return std::min(kMaxPhotons, bytes / kBytesOfPhoton);
}

int spacing_of(const FilmFormat& film) {
  return PixelSlices(film.bounds()).spacing(1);
}

/// Some paths for each pixel of every other tile.
SampleMap every_other_tile(const FilmFormat& film) {
  SampleMap map(film.bounds(), 1, spacing_of(film));
  for (size_t i = 0; i < map.counts().size(); ++i) {
    const size_t w = map.width();
    map.counts()[i] = (i / w + i % w) % 2 == 0 ? kTrialSamples : 0;
  }
  return map;
}

/// Techniques, and how good they are.
struct Candidate {
  PairTechniques techniques;
  Trial trial;
  Balance balance;
};

/// Runs trial passes and counts what they cost.
class Trials {
 public:
  Trials(uint64_t seed, const Scene& scene, const FilmFormat& film, const OwnedRoutes& owned,
         const IntegratorOptions& options, PassControl& control)
      : seed_(seed),
        scene_(scene),
        film_(film),
        owned_(owned),
        options_(options),
        control_(control),
        tiles_(every_other_tile(film)) {}

  /// What a few passes that are thrown away tell of these techniques.
  Candidate run(const PairTechniques& techniques, const EmissionGuide& emission) {
    const PairTrial trial{.paths = tiles_, .counts_records = options_.own<GuidingOptions>().walks};
    const size_t stride =
        PassRecords::stride(PixelSlices(film_.bounds()).first_pixels(), trial.records_per_path);
    EstimatorStatistics counts;
    size_t records = 0;
    Spread spread{SampleVariance(film_.bounds(), spacing_of(film_)), {}};
    for (uint32_t i = 0; i < kTrialPasses; ++i) {
      SampleVariance of_pass(film_.bounds(), spacing_of(film_));
      // Both have the same wavelengths and moment, which are no noise of photons.
      const PassKey key{hash_combine(seed_, kTrialStream), 0};
      records += try_out(
          {.key = key,
           .seed = hash_combine(key.seed, kPathAndPhotonsNumber, i),
           .scene = scene_,
           .owned = owned_,
           .options = options_,
           .techniques = techniques,
           .radius_pixels = static_cast<float>(spacing_of(film_)) * radius_of_pass(options_, 0, 0),
           .photons_for_one = photons_for_one(),
           .emission = emission,
           .light_paths_vary = true,
           .independent_samples = true,
           .control = control_},
          film_, trial, of_pass, counts);
      spread.all.add(of_pass);
      const SampleVariance::ByTile tiles = of_pass.by_tile();
      spread.within.resize(tiles.variance.size());
      for (size_t t = 0; t < tiles.variance.size(); ++t)
        spread.within[t] += tiles.variance[t] * tiles.brightness[t] / kTrialPasses;
    }
    costs_.rays += counts.rays;
    costs_.hold(counts.photon_bytes, counts.pixel_bytes);
    const Trial found = trial_of(spread, counts, techniques, static_cast<double>(records * stride));
    Balance balance(found);
    balance.max_photons = max_photons(film_);
    balance.scale = static_cast<double>(film_.bounds().area()) /
                    static_cast<double>(PixelSlices(film_.bounds()).first_pixels());
    // What photons vary by goes with the area in which they are merged.
    balance.variance_of_light /= photons_for_one();
    return {techniques, found, balance};
  }

  const EstimatorStatistics& costs() const { return costs_; }

 private:
  /// Photons that are merged in the film for one in a trial, whose radius is that of a small
  /// picture.
  float photons_for_one() const {
    return options_.radius > 0 ? 1.0f : sqr(radius_growth(film_.picture_pixels()));
  }
  struct Spread {
    SampleVariance all;          ///< of all passes
    std::vector<double> within;  ///< [tile] variance of samples that share their photons
  };
  /// [A6]
  Trial trial_of(const Spread& spread, const EstimatorStatistics& counts,
                 const PairTechniques& techniques, double records) const {
    constexpr double kSame = static_cast<double>(kTrialSamples - 1) /
                             static_cast<double>(kTrialSamples * kTrialPasses - 1);
    const SampleVariance::ByTile found = spread.all.by_tile();
    std::vector<double> all, within;
    double light = 0, raw_all = 0, raw_within = 0;
    for (size_t i = 0; i < found.variance.size(); ++i) {
      if (tiles_.counts()[i] == 0) continue;
      const double brightness = found.brightness[i];
      all.push_back(found.variance[i]);
      within.push_back(brightness > 0 ? spread.within[i] / brightness : 0);
      light += found.light[i];
      raw_all += found.variance[i] * brightness;
      raw_within += spread.within[i];
    }
    const double tiles = static_cast<double>(std::max<size_t>(1, all.size()));
    const double samples = static_cast<double>(counts.camera_paths);
    const double passes = samples / static_cast<double>(PixelSlices(film_.bounds()).first_pixels());
    const double camera_rays =
        static_cast<double>(counts.rays - counts.light_rays - counts.again_rays) / passes;
    const double merges =
        kCostOfMerge * photons_for_one() * static_cast<double>(counts.photons_merged) / passes;
    const double variance = winsorized_mean(std::move(all)),
                 variance_of_camera = winsorized_mean(std::move(within));
    // Neighbours share photons, too.
    const double sharing =
        kTrialSamples * std::max(1.0, kPi * sqr(double{first_radius(options_, 0)}));
    const double error_squared =
        (raw_within + std::max(0.0, raw_all - raw_within) / (1 - kSame) * sharing) / tiles /
        samples;
    return {.variance_of_camera = variance_of_camera,
            .variance_of_light = std::max(0.0, variance - variance_of_camera) / (1 - kSame),
            .cost_of_camera = camera_rays,
            .cost_of_light = static_cast<double>(counts.light_rays) / kTrialPasses + merges,
            .light_paths = static_cast<double>(techniques.light_paths),
            .light = light / tiles,
            .error = std::sqrt(error_squared),
            .samples = samples,
            .records = records / samples,
            .photons = counts.photon_paths > 0 ? static_cast<double>(counts.photons_stored) /
                                                     static_cast<double>(counts.photon_paths)
                                               : 0};
  }

  const uint64_t seed_;
  const Scene& scene_;
  const FilmFormat& film_;
  const OwnedRoutes& owned_;
  const IntegratorOptions& options_;
  PassControl& control_;
  const SampleMap tiles_;
  EstimatorStatistics costs_;
};

SampleAllocation allocation(const PairFindings::Variance& v, const MixPlan& plan,
                            const FilmFormat& film) {
  const double most = plan.balance
                          ? std::clamp(plan.balance->max_camera_paths(), 1.0, SampleMap::kMaxMean)
                          : SampleMap::kMaxMean;
  if (!plan.techniques.separates_chains)
    return allocate_samples(film.bounds(), spacing_of(film), {v.paths.by_tile(), {}, {}}, most);
  return allocate_samples(film.bounds(), spacing_of(film),
                          {v.paths.by_tile(&v.chains.walks), v.chains.walks.by_tile(&v.paths),
                           v.chains.choice.by_tile(&v.paths)},
                          most);
}

}  // namespace

constinit const EstimatorDescriptor PathAndPhotons::kDescriptor = {
    .traits = {.name = "path+photons",
               .help = "path tracing, and photons merged where their light came by way of an S",
               .starts_at_lights = true,
               .why_never_sampled = out_of_reach_of_merging},
    .settings = kSettings,
    .merges_with_radius = true,
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = bytes_per_pixel(need.parts, need.clamps,
                                                       need.options.camera_samples_per_pass)};
        },
    .exposed_pixels = pixels_of_merging,
    .make = make_estimator<PathAndPhotons>,
};

PathAndPhotons::PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

std::shared_ptr<const Learned> PathAndPhotons::learn(const Scene& scene, const FilmFormat& film,
                                                     uint64_t seed, PassControl& control) const {
  // The lattice stands for a film: with wider merges it has as much noise as the film with as many
  // light paths for each pixel.
  const int64_t pixels = PixelSlices(film.bounds()).first_pixels();
  const int asked = options_.camera_samples_per_pass;
  MixPlan plan;
  plan.is_even = asked > 0;
  plan.lacks_specular = !has_events(owned_, EventClass::kSpecular);
  plan.photons = guide_caustic_photons(seed, scene, film, options_, control);
  // Where the film clamps, a limit of its samples holds for all of their light.
  const bool separates_chains = film.settings().max_component == kInfinity &&
                                SpecularTree(scene, owned_, options_.max_depth).finds_something();
  Trials trials(seed, scene, film, owned_, options_, control);
  const int64_t light_paths = std::max<int64_t>(pixels, 1 << 14);
  Candidate caustics = trials.run({.light_paths = plan.lacks_specular ? 0 : light_paths,
                                   .connects = false,
                                   .caustics_only = true,
                                   .separates_chains = separates_chains,
                                   .roulette_threshold = kCameraRouletteThreshold},
                                  plan.photons.guide.starts);
  // [A5]
  PairTechniques patient = caustics.techniques;
  patient.roulette_threshold = kPatientRouletteThreshold;
  if (Candidate longer = trials.run(patient, plan.photons.guide.starts);
      longer.balance.inverse_efficiency() < caustics.balance.inverse_efficiency())
    caustics = longer;
  Candidate all = trials.run({.light_paths = light_paths,
                              .connects = false,
                              .separates_chains = separates_chains,
                              .roulette_threshold = kCameraRouletteThreshold},
                             kUnguided);
  // Photons of all light see all that the others do, but lose light at edges.
  caustics.balance.variance_of_camera += caustics.trial.min_variance_of_unseen(all.trial);
  // What lies under hair is too finely shadowed to be blurred.
  const bool merges_all =
      !has_events(owned_, EventClass::kHair) &&
      kRequiredGain * all.balance.inverse_efficiency() < caustics.balance.inverse_efficiency();
  const Candidate& best = merges_all ? all : caustics;
  PairTechniques& chosen = plan.techniques;
  chosen = best.techniques;
  if (chosen.light_paths > 0) plan.balance = best.balance;
  const double records_per_path =
      std::clamp(1.1 * best.trial.records, 0.25, double{PassRecords::kMaxPerPath});
  if (options_.photons_per_pass > 0) {
    chosen.light_paths = options_.photons_per_pass;
    plan.balance.reset();
  }
  EstimatorStatistics costs = trials.costs();
  SampleMap measured(film.bounds(), kMeasuredSamples, spacing_of(film));
  plan.samples = {SampleMap(film.bounds(), static_cast<uint16_t>(std::max(asked, 1))),
                  SampleMap(film.bounds(), static_cast<uint16_t>(std::max(asked, 1)))};
  const PairLearning learning{.measures_variance = !plan.is_even,
                              .keeps_records = options_.own<GuidingOptions>().walks,
                              .records_per_path = records_per_path};
  if (learning.measures_variance || learning.keeps_records) {
    const PassKey key{hash_combine(seed, kMeasureStream), 0};
    PairPass pass = pass_of(key, scene, film, plan, control);
    // As many for each pixel of the lattice as the film has for its own.
    pass.techniques.light_paths = static_cast<int64_t>(
        std::ceil(static_cast<double>(pass.techniques.light_paths) * static_cast<double>(pixels) /
                  static_cast<double>(film.bounds().area())));
    pass.radius_pixels *= static_cast<float>(spacing_of(film));
    PairFindings found = measure(pass, film, {measured, measured}, learning, costs);
    if (found.variance) plan.samples = allocation(*found.variance, plan, film);
    const size_t record_bytes = found.records.capacity() * sizeof(RadianceRecord);
    plan.directions = RadianceGuide(std::move(found.records));
    // To sort the records takes half as much again.
    costs.hold(record_bytes + record_bytes / 2 + plan.directions.bytes(), 0);
  }
  plan.rays = costs.rays;
  plan.photon_bytes = costs.photon_bytes;
  plan.pixel_bytes = costs.pixel_bytes;
  return std::make_shared<const LearnedMix>(std::move(plan));
}

PairPass PathAndPhotons::pass_of(const PassKey& key, const Scene& scene, const FilmFormat& film,
                                 const MixPlan& plan, PassControl& control) const {
  PairPass pass{.key = key,
                .seed = hash_combine(key.seed, kPathAndPhotonsNumber),
                .scene = scene,
                .owned = owned_,
                .options = options_,
                .techniques = plan.techniques,
                .radius_pixels = radius_of_pass(options_, film.picture_pixels(), key.pass),
                .emission = plan.techniques.caustics_only ? plan.photons.guide.starts : kUnguided,
                .light_paths_vary = true,
                .control = control};
  pass.techniques.light_paths = plan.light_paths();
  return pass;
}

std::shared_ptr<const Learned> PathAndPhotons::read_learned(ByteReader& from,
                                                            const FilmFormat&) const {
  MixPlan plan;
  from(plan);
  return std::make_shared<const LearnedMix>(std::move(plan));
}

void PathAndPhotons::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                                 Film& film, PassControl& control) {
  const MixPlan& plan = static_cast<const LearnedMix*>(learned)->plan();
  render(pass_of(key, scene, film.format(), plan, control),
         {.film = film,
          .samples = {plan.samples.paths, plan.samples.chains},
          .adds_features = true,
          .directions = plan.directions},
         statistics_);
}

}  // namespace nephroid
