#include "integrator/learning/photon_guiding.h"

#include <fmt/format.h>

#include "core/counted.h"
#include "integrator/learning/guiding_options.h"
#include "integrator/learning/visible_points.h"
#include "route/plan.h"

namespace nephroid {

namespace {

constexpr uint64_t kGuidingStream = 0x6c6561726e;  // "learn"
constexpr uint32_t kRounds = 3;
/// Photon paths per round. A round that found little is followed by a larger one.
constexpr int64_t kPaths = 1 << 14, kMaxPaths = 1 << 18;
constexpr size_t kFewUsefulStarts = 256;
constexpr size_t kFewCasters = 16;

/// A guide to the casters that photons have met. If these are too few to tell a caster's size, the
/// casters seen by the camera count as well.
CasterGuide caster_guide(std::vector<UsefulStart> met, const CausticCasters& seen,
                         const Scene& scene) {
  if (met.size() < kFewCasters)
    for (const Vec3f& p : seen.points) {
      met.emplace_back();
      met.back().first_hit = p;
    }
  return {met, scene.sphere.radius};
}

}  // namespace

GuidedPhotons guide_photons(uint64_t seed, const Scene& scene, const FilmFormat& film,
                            const OwnedRoutes& owned, const IntegratorOptions& options,
                            bool guides_scattering, PassControl& control) {
  if (!options.own<GuidingOptions>().photons || !photons_can_count(owned)) return {};
  // Photons of learning are guided at emission alone: EmissionGuide asks how often they are useful.
  GuidedPhotons learned;
  PhotonGuide& guide = learned.guide;
  CausticCasters seen;
  std::vector<UsefulStart> useful, met;
  int64_t paths = kPaths, all_paths = 0;
  for (uint32_t round = 0; round < kRounds; ++round) {
    IntegratorOptions of_round = options;
    of_round.photons_per_pass = paths;
    PhotonPass pass = start_photon_pass({hash_combine(seed, kGuidingStream), round}, scene, film,
                                        of_round, control);
    // The camera finds casters before any photon has met one.
    if (round == 0) {
      seen = caustic_casters(scene, film, pass, of_round);
      guide.starts = EmissionGuide(scene, seen.points);
      learned.rays += seen.rays;
    }
    pass.trace.guide = &guide;
    const VisiblePoints visible = visible_points(scene, film, owned, pass, options);
    const UsefulStarts found =
        trace_useful_starts(scene, owned, pass.trace, 0, paths,
                            [&](const Photon& photon) { return visible.has_near(photon.p); });
    useful.insert(useful.end(), found.starts.begin(), found.starts.end());
    met.insert(met.end(), found.casters.begin(), found.casters.end());
    learned.rays += visible.rays + found.rays;
    all_paths += paths;
    guide.starts = EmissionGuide(scene, useful, static_cast<double>(all_paths));
    if (useful.size() < kFewUsefulStarts) paths = std::min(4 * paths, kMaxPaths);
  }
  if (guides_scattering && owned.routes->needs_specular(owned.group))
    guide.casters = caster_guide(std::move(met), seen, scene);
  return learned;
}

namespace {

// Stand-ins for estimators: they render nothing, and only photons of the first route are guided.
constexpr EstimatorTraits kMerging{.name = "photons", .merges = true, .starts_at_lights = true},
    kTheRest{.name = "path"};

}  // namespace

GuidedPhotons guide_photons_of(ClassMask casters, uint64_t seed, const Scene& scene,
                               const FilmFormat& film, const IntegratorOptions& options,
                               PassControl& control) {
  const char* route = "C.*[DG]S+[DG]?L";
  if (casters == ClassMask::kAll)
    route = "C.*[DG].+L";
  else if (contains(casters, EventClass::kGlossy))
    route = "C.*(D[GS]+D?|[DG]S+[DG]?)L";
  const CompiledPlan plan =
      compile_plan({{{"merged", route, &kMerging, {}}, {"rest", ".*", &kTheRest, {}}}, {}}, scene);
  constexpr size_t kMerged = 0;  // the group of the first route
  const auto routes = std::make_shared<const Routes>(plan.compilation.routes);
  return guide_photons(seed, scene, film, {routes, plan.symbols, kMerged}, options, false, control);
}

void LearnedPhotons::add_to(EstimatorStatistics& statistics) const {
  statistics.rays += photons_.rays;
  statistics.learning_rays += photons_.rays;
  photons_.add_notes(statistics);
}

void GuidedPhotons::add_notes(EstimatorStatistics& statistics) const {
  if (const size_t targets = guide.starts.places(); targets > 0)
    statistics.notes.push_back(
        "photon emission guided to " + counted(targets, "target") +
        fmt::format("; without guiding {:.2g} % of photon paths would be useful",
                    100 * guide.starts.share_unaimed()));
  if (const size_t targets = guide.casters.places(); targets > 0)
    statistics.notes.push_back("photons scattered by rough surfaces guided to " +
                               counted(targets, "caustic caster"));
}

}  // namespace nephroid
