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
constexpr uint32_t kTrialPasses = 2;
constexpr int64_t kMaxMeasuredPaths = 1 << 15;
/// Light paths of a trial with few of them are this part of those with many.
constexpr int64_t kFewer = 8;
/// Connecting has to be better by this factor: two passes are a rough guess, and do not see that
/// camera paths alone, whose points fill the gaps of earlier ones, gain more from passes to come.
constexpr double kRequiredGain = 1.6;

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

/// The radius with the least error for the photons of some seconds has a size in the world, so that
/// it has the more pixels the more of them the picture has; edges are as sharp as its pixels. From
/// water-caustic at 128 and 512 pixels, pool and coffee-cup. Times the radius that is best for a
/// thumbnail; 1 where the user says a radius, and where everything is merged, not caustics alone.
float radius_scale(const IntegratorOptions& options, bool caustics_only, int64_t pixels) {
  const double over_thumbnail = static_cast<double>(pixels) / PixelSlices::kMaxFirstPixels;
  if (options.radius > 0 || !caustics_only) return 1;
  return static_cast<float>(std::pow(std::max(1.0, over_thumbnail), 0.3));
}

/// Pixels of the picture of which the film may be a crop.
int64_t full_size(const FilmFormat& film) {
  return int64_t{film.settings().width} * film.settings().height;
}

int spacing_of(const FilmFormat& film) {
  return PixelSlices(film.bounds()).spacing(1);
}

/// One path for each pixel of every other tile.
SampleMap every_other_tile(const FilmFormat& film) {
  SampleMap map(film.bounds(), 1, spacing_of(film));
  for (size_t i = 0; i < map.counts().size(); ++i) {
    const size_t w = map.width();
    map.counts()[i] = (i / w + i % w) % 2 == 0;
  }
  return map;
}

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
  Trial run(const PairTechniques& techniques, const EmissionGuide& emission) {
    SampleVariance variance(film_.bounds(), spacing_of(film_));
    const PairTrial trial{
        .paths = tiles_,
        .counts_records = options_.own<GuidingOptions>().walks && !techniques.connects};
    const size_t stride =
        PassRecords::stride(PixelSlices(film_.bounds()).first_pixels(), trial.records_per_path);
    EstimatorStatistics counts;
    size_t records = 0;
    for (uint32_t i = 0; i < kTrialPasses; ++i) {
      const PassKey key{hash_combine(seed_, kTrialStream), i};
      records += try_out({.key = key,
                          .seed = hash_combine(key.seed, kPathAndPhotonsNumber),
                          .scene = scene_,
                          .owned = owned_,
                          .options = options_,
                          .techniques = techniques,
                          .emission = emission,
                          .light_paths_vary = true,
                          .spacing = spacing_of(film_),
                          .control = control_},
                         film_, trial, variance, counts);
    }
    costs_.rays += counts.rays;
    costs_.hold(counts.photon_bytes, counts.pixel_bytes);
    return judge(variance.by_tile(), counts, techniques, static_cast<double>(records * stride));
  }

  const EstimatorStatistics& costs() const { return costs_; }

 private:
  Trial judge(const SampleVariance::ByTile& found, const EstimatorStatistics& counts,
              const PairTechniques& techniques, double records) const {
    std::vector<double> tiles;
    double light = 0, variance = 0;
    for (size_t i = 0; i < found.variance.size(); ++i) {
      if (tiles_.counts()[i] == 0) continue;
      tiles.push_back(found.variance[i]);
      light += found.light[i];
      variance += found.variance[i] * found.light[i];
    }
    const double count = static_cast<double>(std::max<size_t>(1, tiles.size()));
    const double samples = static_cast<double>(counts.camera_paths);
    const double camera_rays =
        static_cast<double>(counts.rays - counts.light_rays - counts.again_rays) / samples *
        static_cast<double>(PixelSlices(film_.bounds()).first_pixels());
    return {.variance = winsorized_mean(std::move(tiles)),
            .cost_of_camera = camera_rays,
            .cost_of_light = static_cast<double>(counts.light_rays) / kTrialPasses,
            .light_paths = static_cast<double>(techniques.light_paths),
            .light = light / count,
            .error = std::sqrt(variance / count / samples),
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
    return allocate_samples(film.bounds(), spacing_of(film), {v.paths.by_tile(), {}, {}}, false,
                            most);
  // Where the film clamps, what a tile converges to depends on who finds its bright light.
  return allocate_samples(film.bounds(), spacing_of(film),
                          {v.paths.by_tile(&v.chains.walks), v.chains.walks.by_tile(&v.paths),
                           v.chains.choice.by_tile(&v.paths)},
                          film.settings().max_component < kInfinity, most);
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
    .exposed_pixels =
        [](const IntegratorOptions& options, const PixelFilter& filter, int64_t pixels) {
          IntegratorOptions wide = options;
          wide.radius = first_radius(options) * radius_scale(options, true, pixels);
          return pixels_of_merging_and_splats(wide, filter, pixels);
        },
    .make = make_estimator<PathAndPhotons>,
};

PathAndPhotons::PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

std::shared_ptr<const Learned> PathAndPhotons::learn(const Scene& scene, const FilmFormat& film,
                                                     uint64_t seed, PassControl& control) const {
  // The lattice stands for a film: with wider merges it has as much noise as the film with as many
  // light paths for each pixel.
  const int64_t pixels = PixelSlices(film.bounds()).first_pixels();
  const double scale = static_cast<double>(film.bounds().area()) / static_cast<double>(pixels);
  const int asked = options_.camera_samples_per_pass;
  MixPlan plan;
  plan.is_even = asked > 0;
  plan.lacks_specular = !has_specular_events(owned_);
  plan.photons = guide_caustic_photons(seed, scene, film, options_, control);
  const EmissionGuide& emission = plan.photons.guide.starts;
  PairTechniques& chosen = plan.techniques;
  chosen = {.light_paths = plan.lacks_specular ? 0 : std::max<int64_t>(pixels, 1 << 14),
            .connects = false,
            .caustics_only = true,
            .separates_chains = SpecularTree(scene, owned_, options_.max_depth).finds_something(),
            .roulette_threshold = kCameraRouletteThreshold};
  Trials trials(seed, scene, film, owned_, options_, control);
  Trial many = trials.run(chosen, emission);
  Balance balance(many);
  if (chosen.light_paths > 0) {
    PairTechniques fewer = chosen;
    fewer.light_paths = chosen.light_paths / kFewer;
    balance = Balance(many, trials.run(fewer, emission));
  }
  // [A5]
  PairTechniques patient = chosen;
  patient.roulette_threshold = kPatientRouletteThreshold;
  const Trial longer = trials.run(patient, emission);
  if (const Balance other = balance.with_camera_paths_of(longer);
      other.inverse_efficiency() < balance.inverse_efficiency()) {
    chosen = patient;
    balance = other;
    many = longer;
  }
  balance.max_photons = max_photons(film);
  balance.scale = scale;
  // What photons vary by goes with the area in which they are merged.
  balance.variance_of_light /= double{sqr(radius_scale(options_, true, full_size(film)))};
  if (chosen.light_paths > 0) plan.balance = balance;
  double records_per_path = std::clamp(1.1 * many.records, 0.25, double{PassRecords::kMaxPerPath});
  const PairTechniques connecting{.light_paths = default_light_paths(pixels),
                                  .separates_chains = chosen.separates_chains};
  Trial connected = trials.run(connecting, kUnguided);
  balance.variance_of_camera += many.min_variance_of_unseen(connected);
  connected.variance += connected.min_variance_of_unseen(many);
  if (kRequiredGain * connected.inverse_efficiency() < balance.inverse_efficiency()) {
    chosen = connecting;
    chosen.light_paths =
        std::min(default_light_paths(film.bounds().area()),
                 static_cast<int64_t>(max_photons(film) / std::max(connected.photons, 0.1)));
    plan.balance.reset();
    records_per_path = PassRecords::kMaxPerPath;
  }
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
    pass.techniques.light_paths = std::min<int64_t>(pass.techniques.light_paths, kMaxMeasuredPaths);
    pass.spacing = spacing_of(film);
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
  PairPass pass{
      .key = key,
      .seed = hash_combine(key.seed, kPathAndPhotonsNumber),
      .scene = scene,
      .owned = owned_,
      .options = options_,
      .techniques = plan.techniques,
      .emission = plan.techniques.connects ? kUnguided : plan.photons.guide.starts,
      .light_paths_vary = true,
      .radius_scale = radius_scale(options_, plan.techniques.caustics_only, full_size(film)),
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
