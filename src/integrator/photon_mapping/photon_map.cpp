#include "integrator/photon_mapping/photon_map.h"

#include <algorithm>

#include "core/counted.h"
#include "input/option_values.h"
#include "integrator/estimator/exposed_pixels.h"
#include "integrator/photons/gather.h"
#include "integrator/photons/missing_caustics.h"
#include "transport/path_points.h"

namespace nephroid {

/// The photons of all sets and the cost of tracing them.
struct TracedMap {
  PhotonGrid grid{{}};
  uint64_t seed = 0;  ///< seed of the map's random numbers
  double paths_of_set = 0;
  uint64_t paths = 0, useful_paths = 0, specular_paths = 0, rays = 0;
};

namespace {

class LearnedMap final : public Learned {
 public:
  LearnedMap(TracedMap map, std::string routes)
      : map_(std::move(map)), routes_(std::move(routes)) {}
  const TracedMap& map() const { return map_; }
  void write(ByteWriter& to) const override {
    to(map_.seed, map_.grid.photons(), map_.paths_of_set, map_.paths, map_.useful_paths,
       map_.specular_paths, map_.rays);
  }
  void add_to(EstimatorStatistics& s) const override;

 private:
  TracedMap map_;
  std::string routes_;  ///< names of the routes
};

void LearnedMap::add_to(EstimatorStatistics& s) const {
  s.rays += map_.rays;
  s.learning_rays += map_.rays;
  s.photon_paths += map_.paths;
  s.photon_paths_useful += map_.useful_paths;
  s.photon_paths_specular += map_.specular_paths;
  s.photons_stored += map_.grid.size();
  s.hold(map_.grid.bytes(), 0);
  if (map_.grid.size() > 0)
    s.notes.push_back(
        "the photon map of " + routes_ + " has " + counted(map_.grid.size(), "photon") + " of " +
        counted(map_.paths, "path") +
        "; it is made once, not in every pass (-D map-photons=N, -D memory-photons=N)");
}

constexpr uint64_t kPhotonMapStream = 0x706d6170;  // "pmap"
constexpr uint32_t kSets = 16;  // a power of two, to stratify wavelengths over sets
/// Default of the largest radius of an estimate, in footprints.
constexpr float kDefaultMaxRadius = 16.0f;

const EstimatorSetting kMapPhotonsSetting = {
    "map-photons",
    "N",
    "0",
    "paths",
    "Photon paths emitted for each map, once. 0 emits those of 16 passes; emission ends when "
    "memory-photons are stored.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<PhotonMapOptions>().map_photons = parse_integer("-D map-photons", text, 0);
    },
    [](const IntegratorOptions& options) {
      return std::to_string(options.own<PhotonMapOptions>().map_photons);
    }};

const EstimatorSetting kNearestSetting = {
    "nearest",
    "N",
    "100",
    "photons",
    "Photons per estimate. They are the nearest ones within -D radius; at least 2.",
    [](IntegratorOptions& options, const std::string& text) {
      options.edit<PhotonMapOptions>().nearest_photons = parse_int("-D nearest", text, 2);
    },
    [](const IntegratorOptions& options) {
      return std::to_string(options.own<PhotonMapOptions>().nearest_photons);
    }};

constexpr const EstimatorSetting* kPhotonMapSettings[] = {&kMapPhotonsSetting, &kNearestSetting};

}  // namespace

constinit const EstimatorDescriptor PhotonMap::kDescriptor = {
    .traits = {.name = "photonmap",
               .help = "a photon map that all passes read, by the nearest photons; passes add no "
                       "photons",
               .merges = true,
               .starts_at_lights = true,
               .one_route_each = true},
    .capabilities = {.consistent = false, .learned_is_light = true},
    .settings = kPhotonMapSettings,
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = Gathered::bytes_per_walk(need.parts)};
        },
    .exposed_pixels = [](const IntegratorOptions& options, const PixelFilter&,
                         int64_t) { return pixels_within(largest_radius(options)); },
    .outlier_warning =
        "show theirs after some passes, which read the same photons again and so confirm them",
    .make = make_estimator<PhotonMap>,
};

PhotonMap::PhotonMap(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)),
      options_(options),
      photons_can_count_(photons_can_count(owned_)),
      walks_per_pass_(static_cast<uint32_t>(std::max(1, options.camera_samples_per_pass))) {
  options_.radius = largest_radius(options_);
}

float PhotonMap::largest_radius(const IntegratorOptions& options) {
  return options.radius > 0 ? options.radius : kDefaultMaxRadius;
}

std::shared_ptr<const Learned> PhotonMap::learn(const Scene& scene, const FilmFormat& film,
                                                uint64_t seed, PassControl& control) const {
  if (!photons_can_count_) return nullptr;
  const uint64_t map_seed = seed_of_map(seed);
  std::vector<PhotonTraceSettings> sets;
  for (uint32_t s = 0; s < kSets; ++s) {
    sets.push_back(start_photon_pass({map_seed, s}, scene, film, options_, control).trace);
    if (const int64_t asked = options_.own<PhotonMapOptions>().map_photons; asked > 0)
      sets.back().photons_per_pass = (asked - 1) / kSets + 1;
  }
  PhotonMapTrace traced = trace_map(scene, owned_, sets, options_.memory_photons);
  const PhotonTrace& t = traced.trace;
  TracedMap map{.seed = map_seed,
                .paths_of_set = static_cast<double>(traced.paths_of_set),
                .paths = t.paths,
                .useful_paths = t.useful_paths,
                .specular_paths = t.specular_paths,
                .rays = t.rays};
  map.grid = PhotonGrid(std::move(traced.trace.photons));
  return std::make_shared<LearnedMap>(std::move(map), names_of_routes(owned_));
}

std::shared_ptr<const Learned> PhotonMap::read_learned(ByteReader& from, const FilmFormat&) const {
  TracedMap map;
  std::vector<Photon> photons;
  from(map.seed, photons, map.paths_of_set, map.paths, map.useful_paths, map.specular_paths,
       map.rays);
  map.grid = PhotonGrid(std::move(photons));
  return std::make_shared<LearnedMap>(std::move(map), names_of_routes(owned_));
}

uint64_t PhotonMap::seed_of_map(uint64_t seed) const {
  return hash_combine(seed, kPhotonMapStream, owned_.group);
}

void PhotonMap::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                            Film& film, PassControl& control) {
  const int group = static_cast<int>(owned_.group);
  if (!photons_can_count_) {
    film.add_estimates(group, walks_per_pass_);
    return;
  }
  const TracedMap& map = static_cast<const LearnedMap*>(learned)->map();
  // Walks have the wavelengths, time and roughness threshold of the set that they read.
  const PassKey set{map.seed, key.pass % kSets};
  PhotonPass pass = start_photon_pass(set, scene, film.format(), options_, control);
  std::vector<RadiusRange> rows(film.bounds().height());
  for (uint32_t k = 0; k < walks_per_pass_; ++k) {
    // Each set has a sequence of its own. From a sequence for all passes it would take every 16th
    // point, and these lie in one strip of each pixel.
    const uint64_t index = uint64_t{key.pass / kSets} * walks_per_pass_ + k;
    pass.point = eye_point(static_cast<uint32_t>(index));
    // Light that is on the film cannot be removed, so only the first walks may be stopped.
    if (k > 0) pass.trace.control = &unwatched;
    read(map, set, hash_combine(seed_of_map(key.seed), kPhotonMapStream, set.pass, index >> 32),
         pass, scene, film, rows);
  }
  film.add_estimates(group, walks_per_pass_);
  RadiusRange all;
  for (const RadiusRange& row : rows) {
    all.smallest = std::min(all.smallest, row.smallest);
    all.largest = std::max(all.largest, row.largest);
  }
  statistics_.radius_min_pixels = all.largest > 0 ? all.smallest : 0;
  statistics_.radius_max_pixels = all.largest;
}

void PhotonMap::read(const TracedMap& map, const PassKey& set, uint64_t walk_seed,
                     const PhotonPass& pass, const Scene& scene, Film& film,
                     std::span<RadiusRange> rows) {
  const int group = static_cast<int>(owned_.group);
  const PixelBounds& b = film.bounds();
  const size_t width = b.width();
  const size_t parts = film.parts_of(group).size();
  Gathered gathered(b.area(), parts);
  statistics_.hold(map.grid.bytes(),
                   gathered.filter_weights.size() * Gathered::bytes_per_walk(parts));
  const size_t nearest_photons = options_.own<PhotonMapOptions>().nearest_photons;
  gather(scene, b, owned_, options_.max_depth, pass, {{&pass.point, 1}, walk_seed}, gathered,
         [&](size_t pixel, const CameraPath&, const Walk& walk, MergePoint at,
             PartSums& sums) -> uint64_t {
           const float footprint = pass.footprint.width(walk.length);
           if (!(footprint > 0.0f)) return 0;
           thread_local std::vector<PhotonGrid::Neighbour> scratch;
           at.throughput = at.throughput * static_cast<float>(1.0 / map.paths_of_set);
           const NearestPhotons nearest{nearest_photons, options_.radius * footprint,
                                        static_cast<int>(set.pass)};
           const NearestMerge merged =
               merge_nearest(map.grid, owned_, at, options_.max_depth, nearest, scratch, sums);
           RadiusRange& row = rows[pixel / width];
           row.smallest = std::min(row.smallest, merged.radius / footprint);
           row.largest = std::max(row.largest, merged.radius / footprint);
           return merged.found;
         });
  finish_estimates(gathered, film.settings().max_component);
  for (size_t i = 0; i < gathered.filter_weights.size(); ++i)
    film.add(group, b.x0 + static_cast<int>(i % width), b.y0 + static_cast<int>(i / width),
             gathered.of_walk(i));
  found_ += gathered.found;
  statistics_.rays += gathered.rays;
  statistics_.camera_paths += gathered.filter_weights.size();
}

EstimatorStatistics PhotonMap::statistics() const {
  EstimatorStatistics s = statistics_;
  s.photons_stay = true;
  explain_darkness(owned_, found_, s);
  return s;
}

}  // namespace nephroid
