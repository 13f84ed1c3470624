#include "integrator/learned_emission.h"

#include "integrator/compiled_plan.h"
#include "integrator/first_sight.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x6c6561726e;  // "learn"
constexpr uint32_t kRounds = 3;
/// Paths of a round; more in rounds after one that found little.
constexpr int64_t kPaths = 1 << 14, kMostPaths = 1 << 18;
constexpr size_t kLittle = 256;

EmissionGuide learn(uint64_t seed, const Scene& scene, const Film& film, const OwnedRoutes& owned,
                    const IntegratorOptions& options, uint64_t& rays) {
  if (!photons_can_count(owned)) return {};
  EmissionGuide guide;
  std::vector<UsefulStart> useful;
  int64_t paths = kPaths, all_paths = 0;
  for (uint32_t round = 0; round < kRounds; ++round) {
    IntegratorOptions of_round = options;
    of_round.photons_per_pass = paths;
    PhotonPass pass =
        start_photon_pass({hash_combine(seed, kStream), round}, scene, film, of_round);
    // What stands in the way of light, the camera can tell before any has met it.
    if (round == 0) {
      const CausticCasters casters = caustic_casters(scene, film, pass, of_round);
      guide = EmissionGuide(scene, casters.points);
      rays += casters.rays;
    }
    pass.trace.guide = &guide;
    const VisiblePoints visible = visible_points(scene, film, owned, pass, options);
    const UsefulStarts found =
        trace_useful_starts(scene, owned, pass.trace, 0, paths,
                            [&](const Photon& photon) { return visible.has_near(photon.p); });
    useful.insert(useful.end(), found.starts.begin(), found.starts.end());
    rays += visible.rays + found.rays;
    all_paths += paths;
    guide = EmissionGuide(scene, useful, static_cast<double>(all_paths));
    if (useful.size() < kLittle) paths = std::min(4 * paths, kMostPaths);
  }
  return guide;
}

}  // namespace

const EmissionGuide& LearnedEmission::guide(uint64_t seed, const Scene& scene, const Film& film,
                                            const OwnedRoutes& owned,
                                            const IntegratorOptions& options,
                                            EstimatorStatistics& statistics) {
  if (!options.guides_emission) return kUnguided;
  if (guide_ && seed_ == seed) return *guide_;
  seed_ = seed;
  const EstimatorKind kind = owned.routes->groups()[owned.group].estimator;
  if (kind == EstimatorKind::kPathAndPhotons) {
    // Photons are of use to it where those of a route of caustics would be.
    const CompiledPlan plan =
        compile_plan({{{"caustic", "C.*[DG]S+[DG]?L", EstimatorKind::kPhotons, {}},
                       {"rest", ".*", EstimatorKind::kPath, {}}},
                      {}},
                     scene);
    constexpr size_t kCaustics = 0;  // the group of the first route
    const auto routes = std::make_shared<const Routes>(plan.compilation.routes);
    guide_ = learn(seed, scene, film, {routes, plan.symbols, kCaustics}, options, statistics.rays);
  } else {
    guide_ = learn(seed, scene, film, owned, options, statistics.rays);
  }
  return *guide_;
}

}  // namespace nephroid
