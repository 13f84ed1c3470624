#include "integrator/path/forecast.h"

#include "integrator/path/path_pass.h"
#include "integrator/path/path_visitor.h"
#include "photon/light_walk.h"
#include "transport/guided_direction.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x666f7265;    // "fore"
constexpr uint64_t kLearning = 0x63617374;  // "cast"
// Photons are traced in rounds until there are enough sights, or no more is to be hoped for.
constexpr int64_t kPhotonsOfRound = 1 << 16;
constexpr size_t kEnoughSights = 1 << 15;
constexpr int kMostRounds = 16;
constexpr int64_t kChunk = 1024;

/// Notes where light lands that came from a light through nothing but what is specular. What came
/// by way of other surfaces is left out: a walk in its direction would end on these, not on a
/// light.
class SightVisitor : public LightWalkVisitor {
 public:
  SightVisitor(const OwnedRoutes& owned, const Emission& emission, std::vector<CausticSight>& out)
      : LightWalkVisitor(owned, emission), out_(out) {}

  bool scatters_in(const Medium&) const { return false; }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    const ClassMask rough = v.bsdf.finite_classes() & useful(v) & ClassMask::kRough;
    if (after_specular_ && rough != ClassMask::kNone)
      out_.push_back({v.surface.p, walk.previous_p});
  }
  bool scatter(const Walk& walk, const WalkEvent& event) {
    after_specular_ = event.letter == EventClass::kSpecular;
    return LightWalkVisitor::scatter(walk, event) && after_specular_;
  }

 private:
  std::vector<CausticSight>& out_;
  bool after_specular_ = false;
};

/// Path tracing whose directions follow the forecast.
class ForecastVisitor : public PathVisitorOf<ForecastVisitor> {
 public:
  ForecastVisitor(const Scene& scene, const OwnedRoutes& owned, const ForecastMap& map,
                  PartSums& light, const SpecularTree* tree)
      : PathVisitorOf(scene, owned, false, light, nullptr, tree), map_(map) {}

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    const ClassMask rough = v.bsdf.finite_classes() & v.classes_of(useful(v)) & ClassMask::kRough;
    lobes_ = rough == ClassMask::kNone ? ForecastLobes() : map_.lobes_at(v.surface.p);
    PathVisitorOf::vertex(walk, v, sampler);
  }

  float density(const WalkVertex& v, const Vec3f& wi, EventClass c, ClassMask among,
                float bsdf_pdf_w) const {
    return mixture(v, among).pdf_w(wi, c, bsdf_pdf_w);
  }

  // A direction that is chosen more often carries less for it; roulette must not undo that.
  std::optional<BsdfSample> sample_direction(Walk& walk, const WalkVertex& v, float uc,
                                             const Vec2f& u, ClassMask among) const {
    float gain = 1;
    const std::optional<BsdfSample> s = mixture(v, among).sample(uc, u, gain);
    if (s) walk.eta_scale *= gain;
    return s;
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    lobes_ = ForecastLobes();
    return PathVisitorOf::scatter(walk, event);
  }

 private:
  GuidedDirection<ForecastLobes> mixture(const WalkVertex& v, ClassMask among) const {
    return {v.bsdf, v.surface.shading, v.wo, TransportMode::kRadiance, among, lobes_};
  }

  const ForecastMap& map_;
  ForecastLobes lobes_;  ///< of the vertex at hand
};

}  // namespace

Forecast::Forecast(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

void Forecast::learn(uint64_t seed, const Scene& scene) {
  std::vector<CausticSight> sights;
  const uint64_t before = statistics_.photon_paths;
  const bool asked = options_.photons_per_pass > 0;
  const int64_t photons = asked ? options_.photons_per_pass : kPhotonsOfRound;
  for (int k = 0; k < (asked ? 1 : kMostRounds) && sights.size() < kEnoughSights; ++k)
    trace_photons({hash_combine(seed, kLearning), static_cast<uint32_t>(k)}, photons, scene,
                  sights);
  paths_of_map_ = statistics_.photon_paths - before;
  map_ = ForecastMap(std::move(sights));
  statistics_.photons_stored = map_.size();
  statistics_.hold(map_.bytes(), 0);
  learned_from_ = seed;
}

void Forecast::trace_photons(const PassKey& key, int64_t photons, const Scene& scene,
                             std::vector<CausticSight>& sights) {
  const int64_t first = static_cast<int64_t>(key.pass) * photons;
  const float specular_alpha = specular_alpha_of_pass(scene.specular_band, {key.seed, 0});
  struct Chunk {
    std::vector<CausticSight> sights;
    uint64_t rays = 0, useful = 0;
  };
  std::vector<Chunk> chunks(static_cast<size_t>(chunk_count(photons, kChunk)));
  parallel_chunks(photons, kChunk, [&](int64_t c, int64_t begin, int64_t end) {
    Chunk& chunk = chunks[static_cast<size_t>(c)];
    for (int64_t j = first + begin; j < first + end; ++j) {
      const SobolPoint point(static_cast<uint32_t>(j), kLightPathPointDimensions);
      PathSampler sampler(point, hash_combine(key.seed, j >> 32));
      const auto start = start_light_path(scene, sampler);
      if (!start) continue;
      Walk walk =
          walk_from(start->emission, start->lambda, specular_alpha, kLightPathStartDimensions);
      SightVisitor visitor(owned_, start->emission, chunk.sights);
      const size_t before = chunk.sights.size();
      random_walk(scene, TransportMode::kImportance, options_.max_depth, walk, sampler, visitor);
      chunk.rays += walk.rays;
      chunk.useful += chunk.sights.size() > before;
    }
  });
  for (const Chunk& chunk : chunks) {
    sights.insert(sights.end(), chunk.sights.begin(), chunk.sights.end());
    statistics_.rays += chunk.rays;
    statistics_.photon_paths_useful += chunk.useful;
  }
  statistics_.photon_paths += static_cast<uint64_t>(photons);
}

void Forecast::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  if (learned_from_ != key.seed) learn(key.seed, scene);
  const PathPass pass{key,    scene, film, owned_, std::max(1, options_.camera_samples_per_pass),
                      kStream};
  const SpecularTree tree(scene, owned_, options_.max_depth);
  statistics_.rays += trace_paths(pass, [&](int, int, CameraPath& path, const SensorWeights&,
                                            PathSampler& sampler, PartSums& light) {
    ForecastVisitor visitor(scene, owned_, map_, light, options_.specular_trees ? &tree : nullptr);
    if (path.camera_weight > 0)
      random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler, visitor);
    return path.walk.rays + visitor.more_rays();
  });
  statistics_.camera_paths +=
      static_cast<uint64_t>(film.bounds().area()) * static_cast<uint64_t>(pass.samples);
}

EstimatorStatistics Forecast::statistics() const {
  EstimatorStatistics s = statistics_;
  s.photons_stay = true;
  if (s.photon_paths == 0) return s;
  const std::string of_all = " of " + std::to_string(paths_of_map_) + " photon paths ";
  const std::string sights = std::to_string(map_.size()) + " sights" + of_all;
  const std::string as_path = " a caustic: its paths are traced as by path";
  if (map_.foretells())
    s.notes.push_back(sights + "foretell caustics; passes add none");
  else if (map_.size() > 0)
    s.notes.push_back(sights + "are too few to foretell" + as_path);
  else
    s.notes.push_back("none" + of_all + "foretold" + as_path);
  return s;
}

}  // namespace nephroid
