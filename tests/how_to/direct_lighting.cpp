#include "how_to/direct_lighting.h"

#include <algorithm>

#include "integrator/path/path_pass.h"
#include "transport/direct_light.h"
#include "transport/walk_symbols.h"

namespace nephroid {
namespace {

/// Looks at what a camera ray meets first.
class FirstVertex {
 public:
  FirstVertex(const Scene& scene, const OwnedRoutes& owned, PartSums& light)
      : scene_(scene), routes_(*owned.routes), symbols_(*owned.symbols), light_(light) {}

  // The walk ends at its first vertex, because nothing that could follow is of use.
  ClassMask useful(const WalkVertex&) const { return ClassMask::kNone; }
  bool scatters_in(const Medium&) const { return false; }
  bool looks_under_surfaces() const { return false; }
  bool scatter(const Walk&, const WalkEvent&) const { return false; }
  void medium_vertex(const Walk&, const MediumVertex&, PathSampler&) {}

  // Lights that the camera sees: the path has no event, so its owner follows from the start.
  void escape(const Walk& walk) {
    for (const int i : scene_.light_sampler->infinite_lights())
      add(walk, routes_.start(), symbols_.light(i),
          scene_.lights[i]->radiance_at_infinity(walk.previous_p, walk.ray.d, walk.lambda));
  }
  void emitter(const Walk& walk, const SurfaceInteraction& hit, const Light& light) {
    add(walk, routes_.start(), symbols_.light(hit.area_light),
        light.radiance(hit.p, hit.ng, hit.uv, hit.wo, walk.lambda));
  }
  void medium_emission(const Medium& medium, const SampledSpectrum& radiance) {
    const Part part = routes_.owner(routes_.start(), symbols_.glow(medium.index()));
    if (light_.owns(part)) light_.add(part, radiance);
  }

  // Light that a surface scatters once: diffuse and glossy lobes may belong to other routes.
  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    const auto d =
        sample_direct(scene_, Receiver::of(v.surface, walk.medium), walk.lambda, sampler);
    if (!d) return;
    ++shadow_rays;
    const Vec3f wi = v.to_local(d->wi_world);
    const SampledSpectrum arriving =
        d->radiance * attenuation_to_light(scene_, *d, walk.lambda, sampler) * abs_cos_theta(wi);
    for (const EventClass c : kSurfaceClasses) {
      if (!contains(v.bsdf.finite_classes(), c)) continue;
      const BsdfEval lobe = v.bsdf.eval(v.wo, wi, TransportMode::kRadiance, c, ClassMask::kAll);
      add(walk, routes_.next(routes_.start(), symbol_at(symbols_, v, c, wi)),
          symbols_.light(d->light), arriving * lobe.f);
    }
  }

  uint64_t shadow_rays = 0;

 private:
  // The routes say who owns the path that ends here; only light of our own parts counts.
  void add(const Walk& walk, EyeState eye, LightSymbol light, const SampledSpectrum& value) {
    const Part part = routes_.owner(eye, light);
    if (light_.owns(part))
      light_.add(part, whole_spectrum(walk.throughput * value, walk.lambda.left()));
  }

  const Scene& scene_;
  const Routes& routes_;
  const SceneSymbols& symbols_;
  PartSums& light_;
};

const char* why_never_sampled(const PathSummary& path) {
  if (path.events.count > 1) return "it follows light that scatters at most once";
  if (path.events.last_specular) return "it looks for lights at rough surfaces only";
  if (path.events.any_volume) return "it does not scatter light in media";
  return nullptr;
}

}  // namespace

constinit const EstimatorDescriptor DirectLighting::kDescriptor = {
    .traits = {.name = "direct",
               .help = "light from lamps, scattered by one rough surface at most",
               .why_never_sampled = why_never_sampled},
    .make = make_estimator<DirectLighting>,
};

void DirectLighting::render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                                 PassControl& control) {
  constexpr uint64_t kStream = 0x646972656374;  // "direct": random numbers of its own
  const PathPass pass{key,     scene,  film, owned_, std::max(1, options_.camera_samples_per_pass),
                      kStream, control};
  statistics_.rays += trace_paths(pass, [&](int, int, CameraPath& path, const SensorWeights&,
                                            PathSampler& sampler, PartSums& light) {
    FirstVertex visitor(scene, owned_, light);
    if (path.camera_weight > 0)
      random_walk(scene, TransportMode::kRadiance, std::min(1, options_.max_depth), path.walk,
                  sampler, visitor);
    return path.walk.rays + visitor.shadow_rays;
  });
  statistics_.camera_paths += film.bounds().area() * pass.samples;
}

}  // namespace nephroid
