#include "integrator/mixed/learned_mix.h"

#include <fmt/format.h>

namespace nephroid {

void LearnedMix::add_to(EstimatorStatistics& s) const {
  s.rays += plan_.rays + plan_.photons.rays;
  s.learning_rays += plan_.rays + plan_.photons.rays;
  s.hold(plan_.photon_bytes, plan_.pixel_bytes);
  const PairTechniques& techniques = plan_.techniques;
  if (techniques.merges_all_light())
    s.notes.push_back(
        "trial passes were better with photons of all light than with those of caustics alone");
  if (techniques.roulette_threshold == kPatientRouletteThreshold)
    s.notes.push_back(
        "Russian roulette begins at an eighth of what a camera path started with: trial passes "
        "were better for it");
  if (contains(techniques.casters, EventClass::kGlossy))
    s.notes.push_back(
        "trial passes were better with photons of the caustics of glossy materials, too");
  if (!techniques.merges_all_light()) plan_.photons.add_notes(s);
  if (plan_.directions.guides())
    s.notes.push_back(
        fmt::format("camera paths guided at {:.3g} % of the rough surfaces that "
                    "they met",
                    100 * plan_.directions.guided()));
  if (plan_.is_even) return;
  const auto note = [&s](const SampleMap& map, const char* what) {
    s.notes.push_back(fmt::format("{:.3g} {} a pixel and pass, {} to {} by tile", map.mean(), what,
                                  map.fewest(), map.most()));
  };
  note(plan_.samples.paths, "camera paths");
  if (techniques.separates_chains && plan_.samples.chains.most() > 0)
    note(plan_.samples.chains, "walks for lights behind smooth glass and mirrors");
}

}  // namespace nephroid
