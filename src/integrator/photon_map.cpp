#include "integrator/photon_map.h"

#include <algorithm>

#include "integrator/gather.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x706d6170;  // "pmap"
constexpr uint32_t kSets = 16;            // a power of two, over which wavelengths are stratified
/// Largest radius of an estimate, in footprints, if the user gave none.
constexpr float kDefaultMaxRadius = 16.0f;

/// Smallest and largest radius of a row's estimates in footprints.
struct RadiusRange {
  float smallest = kInfinity, largest = 0;
  void add(float radius) {
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
};

}  // namespace

PhotonMap::PhotonMap(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)),
      options_(options),
      photons_can_count_(photons_can_count(owned_)),
      walks_per_pass_(static_cast<uint32_t>(std::max(1, options.camera_samples_per_pass))) {
  if (!(options_.radius > 0)) options_.radius = kDefaultMaxRadius;
}

const PhotonMap::Map& PhotonMap::map_of(uint64_t seed, const Scene& scene, const Film& film) {
  if (map_ && map_->seed == seed) return *map_;
  std::vector<PhotonTraceSettings> sets;
  for (uint32_t s = 0; s < kSets; ++s) {
    sets.push_back(start_photon_pass({seed, s}, scene, film, options_).trace);
    if (options_.map_photons > 0)
      sets.back().photons_per_pass = (options_.map_photons - 1) / kSets + 1;
  }
  PhotonMapTrace traced = trace_map(scene, owned_, sets, options_.memory_photons);
  count_photons(traced.trace, statistics_);
  statistics_.bytes_kept = traced.trace.photons.size() * sizeof(Photon);
  map_ = Map{seed, std::make_unique<PhotonGrid>(std::move(traced.trace.photons)),
             static_cast<double>(traced.paths_of_set)};
  return *map_;
}

void PhotonMap::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const int group = static_cast<int>(owned_.group);
  film.add_estimates(group, walks_per_pass_);
  if (!photons_can_count_) return;
  // Each map has random numbers of its own.
  const uint64_t seed = hash_combine(key.seed, kStream, owned_.group);
  const Map& map = map_of(seed, scene, film);
  const PhotonPass pass = start_photon_pass({seed, key.pass % kSets}, scene, film, options_);
  std::vector<SobolPoint> points;
  for (uint32_t k = 0; k < walks_per_pass_; ++k)
    points.emplace_back(key.pass * walks_per_pass_ + k);

  const PixelBounds& b = film.bounds();
  const size_t parts = film.parts_of(group).size();
  Gathered gathered(static_cast<size_t>(b.area()) * walks_per_pass_, parts);
  const size_t walks_per_row = static_cast<size_t>(b.width()) * walks_per_pass_;
  std::vector<RadiusRange> rows(static_cast<size_t>(b.height()));
  gather(scene, b, owned_, options_.max_depth, pass, {points, seed}, gathered,
         [&](size_t number, const CameraPath&, const Walk& walk, MergePoint at,
             PartSums& sums) -> uint64_t {
           const float width = pass.footprint.width(walk.length);
           if (!(width > 0.0f)) return 0;
           thread_local std::vector<PhotonGrid::Neighbour> scratch;
           at.throughput = at.throughput * static_cast<float>(1.0 / map.paths_of_set);
           const NearestPhotons nearest{static_cast<size_t>(options_.nearest_photons),
                                        options_.radius * width,
                                        static_cast<int>(key.pass % kSets)};
           const NearestMerge merged =
               merge_nearest(*map.grid, owned_, at, options_.max_depth, nearest, scratch, sums);
           rows[number / walks_per_row].add(merged.radius / width);
           return merged.found;
         });
  finish_estimates(gathered, film.settings().max_component);
  for (size_t walk = 0; walk < gathered.filter_weights.size(); ++walk) {
    const int pixel = static_cast<int>(walk / walks_per_pass_);
    film.add(group, b.x0 + pixel % b.width(), b.y0 + pixel / b.width(), gathered.of_walk(walk));
  }
  RadiusRange all;
  for (const RadiusRange& row : rows)
    if (row.largest > 0) {
      all.add(row.smallest);
      all.add(row.largest);
    }
  found_ += gathered.found;
  statistics_.rays += gathered.rays;
  statistics_.camera_paths += gathered.filter_weights.size();
  statistics_.radius_min_pixels = all.largest > 0 ? all.smallest : 0;
  statistics_.radius_max_pixels = all.largest;
}

EstimatorStatistics PhotonMap::statistics() const {
  EstimatorStatistics s = statistics_;
  explain_darkness(owned_, found_, s);
  if (s.photons_stored > 0)
    s.notes.push_back("the map of " + names_of_routes(owned_) + " has " +
                      std::to_string(s.photons_stored) + " photons of " +
                      std::to_string(s.photon_paths) +
                      " paths; passes add none (-D map-photons=N, "
                      "-D memory-photons=N)");
  return s;
}

}  // namespace nephroid
