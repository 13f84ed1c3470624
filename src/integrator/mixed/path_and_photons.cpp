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
constexpr uint64_t kTrialStream = 0x747269616c;  // "trial"
constexpr uint32_t kTrialPasses = 2;
constexpr int64_t kMaxTrialPaths = 1 << 17;
/// Light paths of a trial with few of them are this part of those with many.
constexpr int64_t kFewer = 8;
/// Connecting has to be better by this factor: two passes are a rough guess, and do not see that
/// camera paths alone, whose points fill the gaps of earlier ones, gain more from passes to come.
constexpr double kRequiredGain = 1.6;

/// One path for each pixel of every other tile.
SampleMap every_other_tile(const PixelBounds& b) {
  SampleMap map(b);
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
        tiles_(every_other_tile(film.bounds())) {}

  /// What a few passes that are thrown away tell of these techniques.
  Trial run(const PairTechniques& techniques, const EmissionGuide& emission) {
    SampleVariance variance(film_.bounds());
    const PairTrial trial{
        .paths = tiles_,
        .counts_records = options_.own<GuidingOptions>().walks && !techniques.connects};
    const size_t stride =
        PassRecords::stride(static_cast<size_t>(film_.bounds().area()), trial.records_per_path);
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
        static_cast<double>(film_.bounds().area());
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
    return allocate_samples(film.bounds(), {v.paths.by_tile(), {}, {}}, false, most);
  // Where the film clamps, what a tile converges to depends on who finds its bright light.
  return allocate_samples(film.bounds(),
                          {v.paths.by_tile(&v.chains.walks), v.chains.walks.by_tile(&v.paths),
                           v.chains.choice.by_tile(&v.paths)},
                          film.settings().max_component < kInfinity, most);
}

const LearnedMix& as_mix(const Learned* learned) {
  return *static_cast<const LearnedMix*>(learned);
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
          return PixelBytes{.of_pass = bytes_per_pixel(need.parts, need.clamps)};
        },
    .exposed_pixels = pixels_of_merging_and_splats,
    .make = make_estimator<PathAndPhotons>,
};

PathAndPhotons::PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {
  // Where the number of light paths is chosen here, a pass leaves about kMaxPhotons; what is more
  // comes in batches.
  constexpr double kMemorySlack = 1.1;
  if (options_.photons_per_pass == 0)
    options_.memory_photons = std::min(options_.memory_photons,
                                       static_cast<int64_t>(kMemorySlack * Balance::kMaxPhotons));
}

std::shared_ptr<const Learned> PathAndPhotons::learn(const Scene& scene, const FilmFormat& film,
                                                     uint64_t seed, PassControl& control) const {
  const int64_t pixels = film.bounds().area();
  const int asked = options_.camera_samples_per_pass;
  MixPlan plan;
  plan.first_samples =
      SampleMap(film.bounds(), static_cast<uint16_t>(asked > 0 ? asked : kFirstPassSamples));
  plan.is_even = asked > 0;
  plan.lacks_specular = !has_specular_events(owned_);
  plan.photons = guide_caustic_photons(seed, scene, film, options_, control);
  const EmissionGuide& emission = plan.photons.guide.starts;
  PairTechniques& chosen = plan.techniques;
  chosen = {
      .light_paths = plan.lacks_specular ? 0 : std::clamp<int64_t>(pixels, 1 << 14, kMaxTrialPaths),
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
  if (chosen.light_paths > 0) plan.balance = balance;
  plan.records_per_path = std::clamp(1.1 * many.records, 0.25, double{PassRecords::kMaxPerPath});
  const PairTechniques connecting{
      .light_paths = std::min(default_light_paths(pixels), kMaxTrialPaths),
      .separates_chains = chosen.separates_chains};
  Trial connected = trials.run(connecting, kUnguided);
  balance.variance_of_camera += many.min_variance_of_unseen(connected);
  connected.variance += connected.min_variance_of_unseen(many);
  if (kRequiredGain * connected.inverse_efficiency() < balance.inverse_efficiency()) {
    chosen = connecting;
    chosen.light_paths =
        std::min(default_light_paths(pixels),
                 static_cast<int64_t>(Balance::kMaxPhotons / std::max(connected.photons, 0.1)));
    plan.balance.reset();
    plan.records_per_path = PassRecords::kMaxPerPath;
  }
  if (options_.photons_per_pass > 0) {
    chosen.light_paths = options_.photons_per_pass;
    plan.balance.reset();
  }
  plan.rays = trials.costs().rays;
  plan.photon_bytes = trials.costs().photon_bytes;
  plan.pixel_bytes = trials.costs().pixel_bytes;
  return std::make_shared<const LearnedMix>(std::move(plan));
}

PairPass PathAndPhotons::pass_of(const PassKey& key, const Scene& scene, const LearnedMix& learned,
                                 PassControl& control) const {
  const MixPlan& plan = learned.plan();
  const SampleMap& paths = key.pass > 0 ? learned.refinement()->samples.paths : plan.first_samples;
  PairPass pass{.key = key,
                .seed = hash_combine(key.seed, kPathAndPhotonsNumber),
                .scene = scene,
                .owned = owned_,
                .options = options_,
                .techniques = plan.techniques,
                .emission = plan.techniques.connects ? kUnguided : plan.photons.guide.starts,
                .light_paths_vary = true,
                .control = control};
  pass.techniques.light_paths = plan.light_paths(paths.mean());
  return pass;
}

PairLearning PathAndPhotons::learning_of(const LearnedMix& learned) const {
  return {.measures_variance = !learned.plan().is_even,
          .keeps_records = options_.own<GuidingOptions>().walks,
          .records_per_path = learned.plan().records_per_path};
}

std::shared_ptr<const Learned> PathAndPhotons::learn_from_first_pass(
    std::shared_ptr<const Learned> before, std::unique_ptr<PassFindings> found, const Scene& scene,
    const FilmFormat& film, uint64_t seed, PassControl& control) const {
  const LearnedMix& mix = as_mix(before.get());
  MixPlan plan = mix.plan();
  const PairLearning learning = learning_of(mix);
  const bool learns = learning.measures_variance || learning.keeps_records;
  if (!found && learns) {
    EstimatorStatistics counts;
    found = measure(pass_of({seed, 0}, scene, mix, control), film,
                    {plan.first_samples, plan.first_samples}, learning, counts);
    plan.rays += counts.rays;
  }
  MixRefinement refinement{{plan.first_samples, plan.first_samples}, {}};
  if (auto* of_pass = static_cast<PairFindings*>(found.get())) {
    EstimatorStatistics memory;
    memory.hold(plan.photon_bytes, plan.pixel_bytes);
    const size_t record_bytes = of_pass->records.capacity() * sizeof(RadianceRecord);
    refinement.directions = RadianceGuide(std::move(of_pass->records));
    // To sort the records takes half as much again.
    memory.hold(record_bytes + record_bytes / 2 + refinement.directions.bytes(), 0);
    plan.photon_bytes = memory.photon_bytes;
    plan.pixel_bytes = memory.pixel_bytes;
    if (of_pass->variance) refinement.samples = allocation(*of_pass->variance, plan, film);
  }
  return std::make_shared<const LearnedMix>(std::move(plan), std::move(refinement));
}

std::shared_ptr<const Learned> PathAndPhotons::read_learned(ByteReader& from,
                                                            const FilmFormat&) const {
  MixPlan plan;
  std::optional<MixRefinement> refinement;
  from(plan, refinement);
  return std::make_shared<const LearnedMix>(std::move(plan), std::move(refinement));
}

std::unique_ptr<PassFindings> PathAndPhotons::render_pass(const PassKey& key,
                                                          const Learned* learned,
                                                          const Scene& scene, Film& film,
                                                          PassControl& control) {
  const LearnedMix& mix = as_mix(learned);
  const MixPlan& plan = mix.plan();
  const PairPass pass = pass_of(key, scene, mix, control);
  if (key.pass == 0) {
    const PairRender to{
        .film = film, .samples = {plan.first_samples, plan.first_samples}, .adds_features = true};
    const PairLearning learning = learning_of(mix);
    if (learning.measures_variance || learning.keeps_records)
      return render(pass, to, learning, statistics_);
    render(pass, to, statistics_);
    return nullptr;
  }
  const MixRefinement& refined = *mix.refinement();
  render(pass,
         {.film = film,
          .samples = {refined.samples.paths, refined.samples.chains,
                      static_cast<uint32_t>(plan.first_samples.at(0, 0))},
          .adds_features = true,
          .directions = refined.directions},
         statistics_);
  return nullptr;
}

}  // namespace nephroid
