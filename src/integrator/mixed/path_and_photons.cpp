#include "integrator/mixed/path_and_photons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrator/bidirectional/vertex_connection_merging.h"
#include "integrator/path/specular_tree.h"
#include "integrator/photons/photon_pass.h"

namespace nephroid {

namespace {

constexpr uint64_t kTrialStream = 0x747269616c;  // "trial"
constexpr uint32_t kTrialPasses = 2;
constexpr int64_t kMostPathsOfTrial = 1 << 17;
/// Light paths of a trial with few of them are this part of those with many.
constexpr int64_t kFewer = 8;
/// Connecting has to be better by this factor: two passes are a rough guess, and do not see that
/// camera paths alone, whose points fill the gaps of earlier ones, gain more from passes to come.
constexpr double kClearly = 1.6;

/// One path for each pixel of every other tile.
SampleMap every_other_tile(const PixelBounds& b) {
  SampleMap map(b);
  for (size_t i = 0; i < map.counts().size(); ++i) {
    const size_t w = static_cast<size_t>(map.width());
    map.counts()[i] = (i / w + i % w) % 2 == 0;
  }
  return map;
}

}  // namespace

PathAndPhotons::PathAndPhotons(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {
  // Where the number of light paths is chosen here, a pass leaves about kMostPhotons; what is more
  // comes in batches.
  constexpr double kRoom = 1.1;
  if (options_.photons_per_pass == 0)
    options_.memory_photons =
        std::min(options_.memory_photons, static_cast<int64_t>(kRoom * Balance::kMostPhotons));
}

Trial PathAndPhotons::try_out(PairPass how, uint64_t seed, const Scene& scene, const Film& film) {
  const SampleMap half = every_other_tile(film.bounds());
  SampleSpread spread(film.bounds());
  how.samples = &half;
  how.spread = &spread;
  how.spreads_splats = true;
  how.glints = nullptr;
  std::vector<RadianceRecord> records;
  const size_t stride =
      PassRecords::stride(static_cast<size_t>(film.bounds().area()), how.records_of_path);
  if (options_.guides_walks && !how.connects) how.records = &records;
  EstimatorStatistics counts;
  for (uint32_t i = 0; i < kTrialPasses; ++i)
    how.try_out({hash_combine(seed, kTrialStream), i}, scene, film, owned_, options_, counts);
  statistics_.rays += counts.rays;
  statistics_.hold(counts.photon_bytes, counts.pixel_bytes);
  const SampleSpread::ByTile found = spread.by_tile();
  std::vector<double> tiles;
  double light = 0, variance = 0;
  for (size_t i = 0; i < found.variance.size(); ++i) {
    if (half.counts()[i] == 0) continue;
    tiles.push_back(found.variance[i]);
    light += found.light[i];
    variance += found.variance[i] * found.light[i];
  }
  const double count = static_cast<double>(std::max<size_t>(1, tiles.size()));
  const double samples = static_cast<double>(counts.camera_paths);
  const double of_camera =
      static_cast<double>(counts.rays - counts.light_rays - counts.again_rays) / samples *
      static_cast<double>(film.bounds().area());
  return {.variance = steady_mean(std::move(tiles)),
          .cost_of_camera = of_camera,
          .cost_of_light = static_cast<double>(counts.light_rays) / kTrialPasses,
          .light_paths = static_cast<double>(how.light_paths),
          .light = light / count,
          .error = std::sqrt(variance / count / samples),
          .samples = samples,
          .records = static_cast<double>(records.size() * stride) / samples,
          .photons = counts.photon_paths > 0 ? static_cast<double>(counts.photons_stored) /
                                                   static_cast<double>(counts.photon_paths)
                                             : 0};
}

void PathAndPhotons::learn(uint64_t seed, const Scene& scene, const Film& film) {
  const uint64_t rays_before = statistics_.rays;
  const int asked = options_.camera_samples_per_pass;
  const int head = asked > 0 ? asked : kHead;
  learned_.emplace(seed, SampleMap(film.bounds(), static_cast<uint16_t>(head)));
  Learned& learned = *learned_;
  PairPass& pass = learned.pass;
  pass.leaves_glints = SpecularTree(scene, owned_, options_.max_depth).finds_something();
  pass.connects = false;
  pass.caustics_only = true;
  pass.window = kCameraWindow;
  pass.guide = &learned_photons_.guide(seed, scene, film, owned_, options_, statistics_).starts;
  pass.light_paths = has_specular_events(owned_)
                         ? std::clamp<int64_t>(film.bounds().area(), 1 << 14, kMostPathsOfTrial)
                         : 0;
  Trial many = try_out(pass, seed, scene, film);
  Balance balance(many);
  if (pass.light_paths > 0) {
    PairPass fewer = pass;
    fewer.light_paths = pass.light_paths / kFewer;
    balance = Balance(many, try_out(fewer, seed, scene, film));
  }
  // [A5]
  PairPass patient = pass;
  patient.window = kPatientWindow;
  const Trial longer = try_out(patient, seed, scene, film);
  if (const Balance other = balance.with_camera_paths_of(longer);
      other.expense() < balance.expense()) {
    pass = patient;
    balance = other;
    many = longer;
  }
  if (pass.light_paths > 0) learned.balance = balance;
  pass.records_of_path = std::clamp(1.1 * many.records, 0.25, double{PassRecords::kMostOfPath});
  PairPass connecting;
  connecting.leaves_glints = pass.leaves_glints;
  connecting.light_paths = std::min(default_light_paths(film.bounds().area()), kMostPathsOfTrial);
  Trial connected = try_out(connecting, seed, scene, film);
  balance.variance_of_camera += many.least_of_unseen(connected);
  connected.variance += connected.least_of_unseen(many);
  if (kClearly * connected.expense() < balance.expense()) {
    pass = connecting;
    pass.light_paths =
        std::min(default_light_paths(film.bounds().area()),
                 static_cast<int64_t>(Balance::kMostPhotons / std::max(connected.photons, 0.1)));
    learned.balance.reset();
  }
  if (options_.photons_per_pass > 0) {
    pass.light_paths = options_.photons_per_pass;
    learned.balance.reset();
  }
  pass.adds_features = true;
  learned.is_even = asked > 0;
  if (learned.is_even) learned.shares = Shares{learned.head, learned.head};
  statistics_.learning_rays += statistics_.rays - rays_before;
}

void PathAndPhotons::look_back(const Scene& scene, const Film& film) {
  Learned& learned = *learned_;
  if (learned.radiance) return;
  if (!learned.is_seen && (!learned.is_even || options_.guides_walks)) {
    EstimatorStatistics counts;
    first_pass(film).try_out({learned.seed, 0}, scene, film, owned_, options_, counts);
    statistics_.rays += counts.rays;
    statistics_.learning_rays += counts.rays;
  }
  const size_t of_records = learned.records.capacity() * sizeof(RadianceRecord);
  learned.radiance.emplace(std::move(learned.records));
  // To sort the records takes half as much again.
  statistics_.hold(of_records + of_records / 2 + learned.radiance->bytes(), 0);
  learned.records = {};
  if (!learned.spread) return;
  const Learned::Spread& spread = *learned.spread;
  const double most =
      learned.balance ? std::clamp(learned.balance->most_camera_paths(), 1.0, SampleMap::kMostMean)
                      : SampleMap::kMostMean;
  if (learned.pass.leaves_glints)
    // Where the film clamps, what a tile converges to depends on who finds its bright light.
    learned.shares =
        share_out(film.bounds(),
                  {spread.paths.by_tile(&spread.glints), spread.glints.by_tile(&spread.paths),
                   spread.choice.by_tile(&spread.paths)},
                  film.settings().max_component < kInfinity, most);
  else
    learned.shares = share_out(film.bounds(), {spread.paths.by_tile(), {}, {}}, false, most);
  learned.spread.reset();
}

int64_t PathAndPhotons::light_paths(double camera_paths) const {
  return learned_->balance ? learned_->balance->light_paths(camera_paths)
                           : learned_->pass.light_paths;
}

PairPass PathAndPhotons::first_pass(const Film& film) {
  Learned& learned = *learned_;
  PairPass pass = learned.pass;
  pass.samples = &learned.head;
  pass.light_paths = light_paths(pass.samples->mean());
  if (pass.leaves_glints) pass.glints = &learned.head;
  if (learned.radiance) return pass;
  learned.is_seen = true;
  learned.records.clear();
  if (options_.guides_walks) {
    // More would double what it holds.
    const double paths = learned.head.mean() * static_cast<double>(film.bounds().area());
    learned.records.reserve(
        std::min(PassRecords::kMost, static_cast<size_t>(paths * 1.1 * pass.records_of_path) + 64));
    pass.records = &learned.records;
  }
  if (learned.is_even) return pass;
  Learned::Spread& spread = learned.spread.emplace(film.bounds());
  pass.spread = &spread.paths;
  if (pass.leaves_glints) {
    pass.glint_spread = &spread.glints;
    pass.choice_spread = &spread.choice;
  }
  return pass;
}

void PathAndPhotons::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  if (!learned_ || learned_->seed != key.seed) learn(key.seed, scene, film);
  if (key.pass == 0) {
    first_pass(film).render(key, scene, film, owned_, options_, statistics_);
    return;
  }
  look_back(scene, film);
  PairPass pass = learned_->pass;
  const Shares& shared = *learned_->shares;
  pass.samples = &shared.paths;
  if (pass.leaves_glints) pass.glints = &shared.glints;
  pass.head = learned_->head.at(0, 0);
  if (learned_->radiance->guides()) pass.radiance = &*learned_->radiance;
  pass.light_paths = light_paths(pass.samples->mean());
  pass.render(key, scene, film, owned_, options_, statistics_);
}

EstimatorStatistics PathAndPhotons::statistics() const {
  EstimatorStatistics s = statistics_;
  if (!learned_) return s;
  const PairPass& pass = learned_->pass;
  if (pass.connects)
    s.notes.push_back(
        "trial passes were better with light paths connected and merged everywhere than with "
        "caustic photons alone");
  else
    explain_missing_caustics(owned_, s);
  if (pass.window == kPatientWindow)
    s.notes.push_back(
        "camera paths go on while they carry an eighth of what they started with: trial passes "
        "were "
        "better for it");
  if (!pass.guide->empty()) learned_photons_.add_notes(s);
  if (learned_->radiance && learned_->radiance->guides())
    s.notes.push_back(
        fmt::format("camera walks had directions to follow from the first pass at {:.3g} % of the "
                    "rough surfaces that they met",
                    100 * learned_->radiance->guided()));
  if (!learned_->shares || learned_->is_even) return s;
  const auto note = [&s](const SampleMap& map, const char* what) {
    s.notes.push_back(fmt::format("{:.3g} {} a pixel and pass, {} to {} by tile", map.mean(), what,
                                  map.fewest(), map.most()));
  };
  note(learned_->shares->paths, "camera paths");
  if (pass.leaves_glints && learned_->shares->glints.most() > 0)
    note(learned_->shares->glints, "walks for lights behind smooth glass and mirrors");
  return s;
}

}  // namespace nephroid
