#include "integrator/mixed/learned_mix.h"

#include <fmt/format.h>

namespace nephroid {

void LearnedMix::add_to(EstimatorStatistics& s) const {
  s.rays += plan_.rays + plan_.photons.rays;
  s.learning_rays += plan_.rays + plan_.photons.rays;
  s.hold(plan_.photon_bytes, plan_.pixel_bytes);
  const PairTechniques& techniques = plan_.techniques;
  if (techniques.casters == ClassMask::kNone)
    s.notes.push_back(
        "photons render all light, not only caustics: trial passes had less error that way");
  if (techniques.gathers_in_media)
    s.notes.push_back("photons render all indirect light, in media as well");
  else if (techniques.casters == ClassMask::kAll)
    s.notes.push_back(
        "photons render all indirect light, not only caustics: trial passes had less error that "
        "way");
  if (techniques.roulette_threshold == kPatientRouletteThreshold)
    s.notes.push_back(
        "Russian roulette begins at 1/8 of a camera path's initial throughput: trial passes had "
        "less error that way");
  if (techniques.casters == (ClassMask::kSpecular | ClassMask::kGlossy))
    s.notes.push_back(
        "photons render caustics of glossy materials, too: trial passes had less error that way");
  plan_.photons.add_notes(s);
  if (plan_.directions.guides())
    s.notes.push_back(fmt::format("camera paths guided at {:.3g} % of the rough surfaces they met",
                                  100 * plan_.directions.guided()));
  if (plan_.is_even) return;
  const auto note = [&s](const SampleMap& map, const char* one, const char* many) {
    const std::string mean = fmt::format("{:.3g} {} per pixel and pass", map.mean(),
                                         map.most() == 1 && map.fewest() == 1 ? one : many);
    s.notes.push_back(map.fewest() == map.most()
                          ? mean
                          : fmt::format("{} on average, {} to {} depending on the tile", mean,
                                        map.fewest(), map.most()));
  };
  note(plan_.samples.paths, "camera path", "camera paths");
  if (techniques.separates_chains && plan_.samples.chains.most() > 0)
    note(plan_.samples.chains, "walk to lights seen through smooth glass and mirrors",
         "walks to lights seen through smooth glass and mirrors");
}

}  // namespace nephroid
