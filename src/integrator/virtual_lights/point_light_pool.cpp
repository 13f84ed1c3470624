#include "integrator/virtual_lights/point_light_pool.h"

#include <algorithm>
#include <iterator>

#include "core/parallel.h"
#include "photon/light_walk.h"

namespace nephroid {

namespace {

constexpr uint64_t kPointLightPoolStream = 0x76706c;  // "vpl"
constexpr uint64_t kThinning = 0x7468696e;            // "thin"
constexpr int64_t kPoolChunk = 4;                     // groups are small

using Lights = std::vector<std::unique_ptr<PointLight>>;

/// The flux by which lights are chosen.
double flux_of(const PointLight& light) {
  const SampledSpectrum& flux = light.flux;
  return light.left != kAllWavelengths ? flux[light.left] : flux.max_component();
}

void drop_black(Lights& lights) {
  std::erase_if(lights, [](const auto& light) { return !(flux_of(*light) > 0.0); });
}

/// [L5] Keeps at most `most` lights, by systematic sampling with the number u in [0,1).
void thin(Lights& lights, int64_t most, float u) {
  drop_black(lights);
  double total = 0;
  for (const auto& light : lights) total += flux_of(*light);
  const double step = total / static_cast<double>(most);
  Lights kept;
  double below = 0;
  int64_t next = 0;
  for (auto& light : lights) {
    const double flux = flux_of(*light);
    below += flux;
    int64_t count = 0;
    for (; next < most && (static_cast<double>(next) + u) * step < below; ++next) ++count;
    if (count == 0) continue;
    light->flux *= static_cast<float>(static_cast<double>(count) * step / flux);
    kept.push_back(std::move(light));
  }
  lights = std::move(kept);
}

class PointLightVisitor : public LightWalkVisitor {
 public:
  /// Leaves at most `most` lights of the path in `out`; `seed` is the path's own.
  PointLightVisitor(const OwnedRoutes& owned, const Scene& scene, const Emission& emission,
                    int64_t most, uint64_t seed, Lights& out)
      : LightWalkVisitor(owned, emission),
        delta_light_(scene.lights[emission.light]->is_delta()),
        flux_(emission.flux),
        most_(most),
        seed_(seed),
        out_(out) {}

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    if (v.subsurface_exit || !v.merges) return;
    if ((v.bsdf.finite_classes() & v.letters & ClassMask::kRough) == ClassMask::kNone) return;
    auto light = std::make_unique<PointLight>();
    light->surface = v.surface;
    light->material = &v.material;
    light->medium = walk.medium;
    light->wo = v.wo;
    light->flux = flux_ * walk.throughput;
    light->state = state_;
    light->events = walk.events;
    light->only_from_light = only_from_light_;
    SampledWavelengths lambda = walk.lambda;
    light->bsdf = v.material.make_bsdf(light->surface, lambda, walk.specular_alpha, light->arena);
    light->left = lambda.left();
    if (!light->bsdf) return;
    if (static_cast<int64_t>(out_.size()) == most_) thin(out_, most_ / 2, number_of(walk.events));
    out_.push_back(std::move(light));
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    only_from_light_ |= walk.events == 1 && walk.delta && delta_light_;
    return LightWalkVisitor::scatter(walk, event);
  }

 private:
  float number_of(int events) const {
    return bits_to_unit_float(static_cast<uint32_t>(hash_combine(seed_, kThinning, events) >> 32));
  }

  const bool delta_light_;
  const SampledSpectrum flux_;
  const int64_t most_;
  const uint64_t seed_;
  Lights& out_;
  bool only_from_light_ = false;
};

/// Traces light path `number`, leaves at most `most` lights in `out` and returns the rays.
uint64_t trace(const Scene& scene, const OwnedRoutes& owned, const PhotonTraceSettings& settings,
               uint64_t number, int64_t most, Lights& out) {
  const LightPathSequence sequence{hash_combine(settings.key.seed, kPointLightPoolStream)};
  const LightPathLaunch launch{
      .scene = scene, .specular_alpha = settings.specular_alpha, .max_events = settings.max_events};
  uint64_t rays = 0;
  sequence.at(number, [&](PathSampler& sampler) {
    launch_light_path(
        launch, with_own_hero(settings.lambda, settings.key.seed, number), settings.time, sampler,
        kEmissionDimensions,
        [&](const Emission& emission) {
          return PointLightVisitor(owned, scene, emission, most,
                                   hash_combine(settings.key.seed, number), out);
        },
        [&](const PointLightVisitor&, const Walk& walk) { rays = walk.rays; });
  });
  return rays;
}

}  // namespace

int64_t point_lights_in_memory_of(int64_t photons) {
  constexpr double kSize = sizeof(PointLight), kMinLights = 1024;
  return static_cast<int64_t>(
      std::max(kMinLights, static_cast<double>(photons) * sizeof(Photon) / kSize));
}

PointLightPool::PointLightPool(const Scene& scene, const OwnedRoutes& owned,
                               const PhotonTraceSettings& settings, int64_t most) {
  const int64_t paths = settings.photons_per_pass;
  const uint64_t first = uint64_t{settings.key.pass} * paths;
  // The paths of a group leave at most a quarter of `most` lights. Thinning frees as many, so it
  // runs now and then, not after each group.
  const int64_t room = std::max<int64_t>(2, most / 4);
  const int64_t of_group = std::max<int64_t>(1, room / std::max(1, settings.max_events));
  struct Chunk {
    Lights lights;
    uint64_t rays = 0, useful = 0;
  };
  for (int64_t begin = 0; begin < paths; begin += of_group) {
    const int64_t count = std::min(of_group, paths - begin);
    const auto trace_chunk = [&](Chunk& chunk, int64_t b, int64_t e) {
      Lights of_path;
      for (int64_t j = begin + b; j < begin + e; ++j) {
        of_path.clear();
        chunk.rays += trace(scene, owned, settings, first + j, room, of_path);
        chunk.useful += !of_path.empty();
        std::move(of_path.begin(), of_path.end(), std::back_inserter(chunk.lights));
      }
    };
    ordered_reduce<Chunk>(*settings.control, count, kPoolChunk, trace_chunk, [&](Chunk&& chunk) {
      rays_ += chunk.rays;
      useful_paths_ += chunk.useful;
      std::move(chunk.lights.begin(), chunk.lights.end(), std::back_inserter(lights_));
    });
    most_held_ = std::max(most_held_, lights_.size());
    if (static_cast<int64_t>(lights_.size()) > most)
      thin(lights_, most - room,
           bits_to_unit_float(static_cast<uint32_t>(
               hash_combine(settings.key.seed, kThinning, settings.key.pass, begin) >> 32)));
  }
  add_up(paths);
}

void PointLightPool::add_up(int64_t paths) {
  for (auto& light : lights_) light->flux /= static_cast<float>(paths);
  drop_black(lights_);
  double sum = 0;
  for (const auto& light : lights_) sums_.push_back(sum += flux_of(*light));
}

ChosenLight PointLightPool::choose(int k, int count, float u) const {
  const double total = sums_.back();
  const double at = (static_cast<double>(k) + u) / count * total;
  const size_t i = std::min<size_t>(
      std::upper_bound(sums_.begin(), sums_.end(), at) - sums_.begin(), sums_.size() - 1);
  const double flux = sums_[i] - (i > 0 ? sums_[i - 1] : 0.0);
  return {lights_[i].get(), static_cast<float>(total / (count * flux))};
}

}  // namespace nephroid
