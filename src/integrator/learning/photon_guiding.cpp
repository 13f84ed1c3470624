#include "integrator/learning/photon_guiding.h"

#include <fmt/format.h>

#include "integrator/learning/visible_points.h"
#include "integrator/presets/compiled_plan.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x6c6561726e;  // "learn"
constexpr uint32_t kRounds = 3;
/// Paths of a round; more in rounds after one that found little.
constexpr int64_t kPaths = 1 << 14, kMostPaths = 1 << 18;
constexpr size_t kLittle = 256;
constexpr size_t kFewCasters = 16;

/// Of those that photons have met and, while these are too few to tell how large a thing is, of
/// those that the camera has seen.
CasterGuide caster_guide(std::vector<UsefulStart> met, const CausticCasters& seen,
                         const Scene& scene) {
  if (met.size() < kFewCasters)
    for (const Vec3f& p : seen.points) {
      met.emplace_back();
      met.back().first_hit = p;
    }
  return {met, scene.sphere.radius};
}

PhotonGuide learn(uint64_t seed, const Scene& scene, const Film& film, const OwnedRoutes& owned,
                  const IntegratorOptions& options, bool aims_from_surfaces, uint64_t& rays) {
  if (!photons_can_count(owned)) return {};
  // Photons of learning are aimed from lights alone: how often they were of use is what
  // EmissionGuide asks for.
  PhotonGuide guide;
  CausticCasters seen;
  std::vector<UsefulStart> useful, met;
  int64_t paths = kPaths, all_paths = 0;
  for (uint32_t round = 0; round < kRounds; ++round) {
    IntegratorOptions of_round = options;
    of_round.photons_per_pass = paths;
    PhotonPass pass =
        start_photon_pass({hash_combine(seed, kStream), round}, scene, film, of_round);
    // What stands in the way of light, the camera can tell before any has met it.
    if (round == 0) {
      seen = caustic_casters(scene, film, pass, of_round);
      guide.starts = EmissionGuide(scene, seen.points);
      rays += seen.rays;
    }
    pass.trace.guide = &guide;
    const VisiblePoints visible = visible_points(scene, film, owned, pass, options);
    const UsefulStarts found =
        trace_useful_starts(scene, owned, pass.trace, 0, paths,
                            [&](const Photon& photon) { return visible.has_near(photon.p); });
    useful.insert(useful.end(), found.starts.begin(), found.starts.end());
    met.insert(met.end(), found.casters.begin(), found.casters.end());
    rays += visible.rays + found.rays;
    all_paths += paths;
    guide.starts = EmissionGuide(scene, useful, static_cast<double>(all_paths));
    if (useful.size() < kLittle) paths = std::min(4 * paths, kMostPaths);
  }
  if (aims_from_surfaces && owned.routes->needs_specular(owned.group))
    guide.casters = caster_guide(std::move(met), seen, scene);
  return guide;
}

}  // namespace

const PhotonGuide& LearnedPhotons::guide(uint64_t seed, const Scene& scene, const Film& film,
                                         const OwnedRoutes& owned, const IntegratorOptions& options,
                                         EstimatorStatistics& statistics) {
  if (!options.guides_photons) return kUnguidedPhotons;
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
    guide_ = learn(seed, scene, film, {routes, plan.symbols, kCaustics}, options, false,
                   statistics.rays);
  } else {
    guide_ = learn(seed, scene, film, owned, options, true, statistics.rays);
  }
  return *guide_;
}

void LearnedPhotons::add_notes(EstimatorStatistics& statistics) const {
  if (!guide_) return;
  const auto of = [](size_t places) { return places == 1 ? "" : "s"; };
  if (const size_t places = guide_->starts.places(); places > 0)
    statistics.notes.push_back(
        fmt::format("photons start towards {} place{} where earlier ones were of use; without aim, "
                    "{:.2g} % of them would have been",
                    places, of(places), 100 * guide_->starts.share_unaimed()));
  if (const size_t places = guide_->casters.places(); places > 0)
    statistics.notes.push_back(fmt::format(
        "photons that a rough surface scatters, and that only glass or a mirror can make "
        "a caustic of, go towards {} place{} where earlier ones met some",
        places, of(places)));
}

}  // namespace nephroid
