#include "integrator/metropolis/metropolis_pass.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/counted.h"
#include "core/parallel.h"
#include "scene/scene.h"

namespace nephroid {

namespace {

constexpr float kPilotPathsPerPixel = 16;
constexpr float kMinPilotPaths = 1 << 11, kMaxPilotPaths = 1 << 16;
// Defaults, measured: docs/adr/0018-chains-restart.md.
constexpr double kMutationsPerPixel = 16;
constexpr int64_t kMinMutations = 1024;
constexpr int64_t kChainLength = 8192;
constexpr int64_t kMinChains = 16;
/// Bootstrap paths over mutations.
constexpr double kBootstrapShare = 0.25;

}  // namespace

ChainSettings MetropolisPasses::settings_for(int64_t pixels) const {
  const double per_pixel = options_.mutations > 0 ? double{options_.mutations} : kMutationsPerPixel;
  const int64_t mutations =
      std::max(kMinMutations, static_cast<int64_t>(per_pixel * static_cast<double>(pixels)));
  ChainSettings settings;
  settings.large_step = options_.large_step;
  settings.mutations = options_.chain_length > 0 ? std::min(options_.chain_length, mutations)
                                                 : std::min(kChainLength, mutations / kMinChains);
  settings.chains = chunk_count(mutations, settings.mutations);
  settings.bootstrap = static_cast<int64_t>(
      kBootstrapShare * static_cast<double>(settings.chains * settings.mutations));
  return settings;
}

std::shared_ptr<const LearnedPilot> LearnedPilot::learn(uint64_t seed, const FilmArea& area,
                                                        size_t kinds, const PathFunctionMaker& make,
                                                        PassControl& control) {
  const float paths = std::clamp(kPilotPathsPerPixel * area.area(), kMinPilotPaths, kMaxPilotPaths);
  return std::make_shared<const LearnedPilot>(
      look_around(seed, static_cast<int64_t>(paths), area, kinds, make, control));
}

std::shared_ptr<const LearnedPilot> LearnedPilot::read(ByteReader& from, size_t kinds) {
  ChainPilot pilot;
  from(pilot);
  expect_sound(pilot.kinds.size() == kinds);
  return std::make_shared<const LearnedPilot>(std::move(pilot));
}

void MetropolisPasses::render(const PassKey& key, const Scene& scene, int group,
                              const ChainPilot& pilot, const PathFunctionMaker& make, Film& film,
                              PassControl& control) {
  SplatBuffer buffer(film, group, *scene.filter);
  pixel_bytes_ = film.bounds().area() * SplatBuffer::bytes_per_pixel(film.parts_of(group).size());
  render_chains(key, settings_for(film.bounds().area()), pilot, make, buffer, counts_, control);
  buffer.finish(1.0);
  film.add_estimates(group, 1);
}

EstimatorStatistics MetropolisPasses::statistics() const {
  EstimatorStatistics s;
  s.rays = counts_.rays;
  s.camera_paths = counts_.paths;
  s.splats = counts_.splats;
  s.hold(0, pixel_bytes_);
  if (counts_.bootstrap == 0) return s;
  if (counts_.bootstrap_lit == 0) {
    s.notes.push_back("none of " + counted(counts_.bootstrap, "bootstrap path") +
                      " found any light");
    return s;
  }
  const auto percent = [](uint64_t part, uint64_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  s.notes.push_back(fmt::format(
      "Metropolis: {:.1f} % of {} bootstrap paths carry light; acceptance rate {:.1f} % "
      "for small steps, {:.1f} % for large steps, which are {:.1f} % of all steps",
      percent(counts_.bootstrap_lit, counts_.bootstrap), counts_.bootstrap,
      percent(counts_.small_accepted, counts_.small),
      percent(counts_.large_accepted, counts_.large),
      percent(counts_.large, counts_.large + counts_.small)));
  return s;
}

}  // namespace nephroid
