#include "integrator/path/forecast.h"

#include "core/counted.h"
#include "integrator/estimator/reach.h"
#include "integrator/path/path_options.h"
#include "integrator/path/path_pass.h"
#include "integrator/path/path_visitor.h"
#include "photon/forecast_map.h"
#include "photon/light_walk.h"
#include "transport/guided_direction.h"

namespace nephroid {

namespace {

constexpr uint64_t kForecastStream = 0x666f7265;    // "fore"
constexpr uint64_t kForecastLearning = 0x63617374;  // "cast"
// Photons are traced in rounds until there are enough records, or kMaxRounds are done.
constexpr int64_t kPhotonsOfRound = 1 << 16;
constexpr size_t kEnoughRecords = 1 << 15;
constexpr int kMaxRounds = 16;
constexpr int64_t kForecastChunk = 1024;

/// Records caustic photons: those whose events so far were all S, at least one. Photons that came
/// by way of other surfaces are left out: a walk in their direction would end on these surfaces.
class CausticRecordVisitor : public LightWalkVisitor {
 public:
  CausticRecordVisitor(const OwnedRoutes& owned, const Emission& emission,
                       std::vector<CausticRecord>& out)
      : LightWalkVisitor(owned, emission), out_(out) {}

  bool scatters_in(const Medium&) const { return false; }

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    const ClassMask rough = v.bsdf.finite_classes() & v.letters & ClassMask::kRough;
    if (after_specular_ && rough != ClassMask::kNone)
      out_.push_back({v.surface.p, walk.previous_p});
  }
  bool scatter(const Walk& walk, const WalkEvent& event) {
    after_specular_ = event.letter == EventClass::kSpecular;
    return LightWalkVisitor::scatter(walk, event) && after_specular_;
  }

 private:
  std::vector<CausticRecord>& out_;
  bool after_specular_ = false;
};

/// Path tracing guided by the forecast ([T3]).
class ForecastVisitor : public PathVisitorOf<ForecastVisitor> {
 public:
  ForecastVisitor(const Scene& scene, const OwnedRoutes& owned, const ForecastMap& map,
                  PartSums& light, const SpecularTree* tree)
      : PathVisitorOf(scene, owned, false, light, nullptr, tree), map_(map) {}

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    const ClassMask rough = v.bsdf.finite_classes() & v.useful_classes() & ClassMask::kRough;
    lobes_ = rough == ClassMask::kNone ? ForecastLobes() : map_.lobes_at(v.surface.p);
    PathVisitorOf::vertex(walk, v, sampler);
  }

  float density(const WalkVertex& v, const Vec3f& wi, EventClass c, ClassMask among,
                float bsdf_pdf_w) const {
    return mixture(v, among).pdf_w(wi, c, bsdf_pdf_w);
  }

  // A guided direction is chosen more often and carries less; roulette must not undo that.
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
  ForecastLobes lobes_;  ///< lobes at the current vertex
};

/// The map and its cost.
struct Forecasting {
  ForecastMap map;
  uint64_t photon_paths = 0, photon_paths_useful = 0, rays = 0;
  static void members(auto& self, auto& archive) {
    archive(self.map, self.photon_paths, self.photon_paths_useful, self.rays);
  }
};

class LearnedForecast final : public Learned {
 public:
  explicit LearnedForecast(Forecasting made) : made_(std::move(made)) {}
  const ForecastMap& map() const { return made_.map; }
  void write(ByteWriter& to) const override { to(made_); }
  void add_to(EstimatorStatistics& s) const override;

 private:
  Forecasting made_;
};

void LearnedForecast::add_to(EstimatorStatistics& s) const {
  s.rays += made_.rays;
  s.learning_rays += made_.rays;
  s.photon_paths += made_.photon_paths;
  s.photon_paths_useful += made_.photon_paths_useful;
  s.photons_stored += map().size();
  s.hold(map().bytes(), 0);
  const std::string of_all = " of " + counted(made_.photon_paths, "photon path") + " ";
  const std::string records = counted(map().size(), "record") + of_all;
  const std::string as_path = " caustics; they are path traced, as by the integrator path";
  if (map().foretells())
    s.notes.push_back(records + "forecast caustics; they are made once, not in every pass");
  else if (map().size() > 0)
    s.notes.push_back(records + in_number(map().size(), "is", "are") + " too few to forecast" +
                      as_path);
  else
    s.notes.push_back("none" + of_all + "forecast" + as_path);
}

/// Traces the photons of one round and appends their records.
void trace_round(const PassKey& key, int64_t photons, const Scene& scene, const OwnedRoutes& owned,
                 int max_depth, std::vector<CausticRecord>& records, Forecasting& made,
                 PassControl& control) {
  const int64_t first = static_cast<int64_t>(key.pass) * photons;
  const float specular_alpha = specular_alpha_of_pass(scene.specular_band, {key.seed, 0});
  struct Chunk {
    std::vector<CausticRecord> records;
    uint64_t rays = 0, useful = 0;
  };
  const LightPathSequence sequence{key.seed};
  const LightPathLaunch launch{
      .scene = scene, .specular_alpha = specular_alpha, .max_events = max_depth};
  const auto trace_chunk = [&](Chunk& chunk, int64_t begin, int64_t end) {
    for (int64_t j = first + begin; j < first + end; ++j)
      sequence.at(j, [&](PathSampler& sampler) {
        const LightPathMoment moment = sample_moment(scene, sampler);
        const size_t before = chunk.records.size();
        launch_light_path(
            launch, moment.lambda, scene.camera->motion_time(moment.u_time), sampler,
            kLightPathStartDimensions,
            [&](const Emission& emission) {
              return CausticRecordVisitor(owned, emission, chunk.records);
            },
            [&](const CausticRecordVisitor&, const Walk& walk) { chunk.rays += walk.rays; });
        chunk.useful += chunk.records.size() > before;
      });
  };
  ordered_reduce<Chunk>(control, photons, kForecastChunk, trace_chunk, [&](Chunk&& chunk) {
    records.insert(records.end(), chunk.records.begin(), chunk.records.end());
    made.rays += chunk.rays;
    made.photon_paths_useful += chunk.useful;
  });
  made.photon_paths += photons;
}

constexpr const EstimatorSetting* kForecastSettings[] = {&kSpecularTreesSetting};

}  // namespace

constinit const EstimatorDescriptor Forecast::kDescriptor = {
    .traits = {.name = "forecast",
               .help = "path tracing that looks where photons foretold that a caustic comes from",
               .why_never_sampled = out_of_reach_of_eye_walks},
    .settings = kForecastSettings,
    .keeps_photons = true,
    .make = make_estimator<Forecast>,
};

Forecast::Forecast(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

std::shared_ptr<const Learned> Forecast::learn(const Scene& scene, const FilmFormat&, uint64_t seed,
                                               PassControl& control) const {
  Forecasting made;
  std::vector<CausticRecord> records;
  const bool asked = options_.photons_per_pass > 0;
  const int64_t photons = asked ? options_.photons_per_pass : kPhotonsOfRound;
  for (int k = 0; k < (asked ? 1 : kMaxRounds) && records.size() < kEnoughRecords; ++k)
    trace_round({hash_combine(seed, kForecastLearning), static_cast<uint32_t>(k)}, photons, scene,
                owned_, options_.max_depth, records, made, control);
  made.map = ForecastMap(std::move(records));
  return std::make_shared<LearnedForecast>(std::move(made));
}

std::shared_ptr<const Learned> Forecast::read_learned(ByteReader& from, const FilmFormat&) const {
  Forecasting made;
  from(made);
  return std::make_shared<LearnedForecast>(std::move(made));
}

void Forecast::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                           Film& film, PassControl& control) {
  const ForecastMap& map = static_cast<const LearnedForecast*>(learned)->map();
  const PathPass pass{
      key,    scene, film, owned_, std::max(1, options_.camera_samples_per_pass), kForecastStream,
      control};
  const SpecularTree tree(scene, owned_, options_.max_depth);
  const bool sees_trees = options_.own<PathOptions>().specular_trees;
  statistics_.rays += trace_paths(pass, [&](int, int, CameraPath& path, const SensorWeights&,
                                            PathSampler& sampler, PartSums& light) {
    ForecastVisitor visitor(scene, owned_, map, light, sees_trees ? &tree : nullptr);
    if (path.camera_weight > 0)
      random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler, visitor);
    return path.walk.rays + visitor.more_rays();
  });
  statistics_.camera_paths += static_cast<uint64_t>(film.bounds().area()) * pass.samples;
}

EstimatorStatistics Forecast::statistics() const {
  EstimatorStatistics s = statistics_;
  s.photons_stay = true;
  return s;
}

}  // namespace nephroid
