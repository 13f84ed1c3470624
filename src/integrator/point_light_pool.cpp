#include "integrator/point_light_pool.h"

#include <algorithm>

#include "core/parallel.h"
#include "photon/light_walk.h"

namespace nephroid {

namespace {

constexpr uint64_t kStream = 0x76706c;  // "vpl"
constexpr int64_t kChunk = 128;

using Lights = std::vector<std::unique_ptr<PointLight>>;

class PointLightVisitor : public LightWalkVisitor {
 public:
  PointLightVisitor(const OwnedRoutes& owned, const Scene& scene, const Emission& emission,
                    Lights& out)
      : LightWalkVisitor(owned, emission),
        delta_light_(scene.lights[static_cast<size_t>(emission.light)]->is_delta()),
        flux_(emission.flux),
        out_(out) {}

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler&) {
    if (v.subsurface_exit || !v.merges) return;
    if ((v.bsdf.finite_classes() & useful(v) & ClassMask::kRough) == ClassMask::kNone) return;
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
    light->secondary_terminated = lambda.secondary_terminated();
    if (light->bsdf) out_.push_back(std::move(light));
  }

  bool scatter(const Walk& walk, const WalkEvent& event) {
    only_from_light_ |= walk.events == 1 && walk.delta && delta_light_;
    return LightWalkVisitor::scatter(walk, event);
  }

 private:
  const bool delta_light_;
  const SampledSpectrum flux_;
  Lights& out_;
  bool only_from_light_ = false;
};

uint64_t trace(const Scene& scene, const OwnedRoutes& owned, const PhotonTraceSettings& settings,
               uint64_t number, Lights& out) {
  // All passes together run through one sequence; the seed changes when its 32 bits are used up.
  const SobolPoint point(static_cast<uint32_t>(number), kLightPathPointDimensions);
  PathSampler sampler(point, hash_combine(settings.key.seed, kStream, number >> 32));
  const auto emitted = emit(scene, kUnguided, settings.lambda, settings.time, sampler);
  if (!emitted) return 0;
  Walk walk = walk_from(*emitted, settings.lambda, settings.specular_alpha, kEmissionDimensions);
  PointLightVisitor visitor(owned, scene, *emitted, out);
  random_walk(scene, TransportMode::kImportance, settings.max_events, walk, sampler, visitor);
  return walk.rays;
}

}  // namespace

PointLightPool::PointLightPool(const Scene& scene, const OwnedRoutes& owned,
                               const PhotonTraceSettings& settings) {
  struct Chunk {
    Lights lights;
    uint64_t rays = 0, useful = 0;
  };
  const int64_t paths = settings.photons_per_pass;
  const uint64_t first = uint64_t{settings.key.pass} * static_cast<uint64_t>(paths);
  std::vector<Chunk> chunks(static_cast<size_t>(chunk_count(paths, kChunk)));
  parallel_chunks(paths, kChunk, [&](int64_t c, int64_t begin, int64_t end) {
    Chunk& chunk = chunks[static_cast<size_t>(c)];
    for (int64_t j = begin; j < end; ++j) {
      const size_t before = chunk.lights.size();
      chunk.rays += trace(scene, owned, settings, first + static_cast<uint64_t>(j), chunk.lights);
      chunk.useful += chunk.lights.size() > before;
    }
  });
  double sum = 0;
  for (Chunk& chunk : chunks) {
    rays_ += chunk.rays;
    useful_paths_ += chunk.useful;
    for (auto& light : chunk.lights) {
      light->flux /= static_cast<float>(paths);
      const float flux = light->secondary_terminated ? light->flux[0] : light->flux.max_component();
      if (!(flux > 0.0f)) continue;
      sums_.push_back(sum += static_cast<double>(flux));
      lights_.push_back(std::move(light));
    }
  }
}

ChosenLight PointLightPool::choose(int k, int count, float u) const {
  const double total = sums_.back();
  const double at = (static_cast<double>(k) + static_cast<double>(u)) / count * total;
  const size_t i = std::min(
      static_cast<size_t>(std::upper_bound(sums_.begin(), sums_.end(), at) - sums_.begin()),
      sums_.size() - 1);
  const double flux = sums_[i] - (i > 0 ? sums_[i - 1] : 0.0);
  return {lights_[i].get(), static_cast<float>(total / (count * flux))};
}

}  // namespace nephroid
