#include "integrator/photon_mapping/vertex_merging.h"

#include "integrator/photon_mapping/light_tracing.h"
#include "integrator/photons/merge_pass.h"
#include "integrator/photons/merge_radius.h"
#include "integrator/photons/missing_caustics.h"

namespace nephroid {

namespace {

/// m of [X1]: the expected number of camera walks, one per pixel, within the radius of the point
/// where a light path lands. Light tracing finds that path once, and traces as many light paths.
float merges_per_splat(const CameraConnection& line, const Vec3f& ng, float radius) {
  return kPi * sqr(radius) * line.film_density * abs_dot(ng, line.wi);
}

}  // namespace

constinit const EstimatorDescriptor VertexMerging::kDescriptor = {
    .traits = {.name = "photons+light",
               .help = "photons that are merged and connected to the camera, weighed against each "
                       "other",
               .merges = true,
               .connects = true,
               .starts_at_lights = true},
    .merges_with_radius = true,
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = MergePass::bytes_per_pixel(need.parts) +
                                       SplatBuffer::bytes_per_pixel(need.parts)};
        },
    .exposed_pixels = pixels_of_merging_and_splats,
    .make = make_estimator<VertexMerging>,
};

VertexMerging::VertexMerging(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options), photons_can_count_(photons_can_count(owned_)) {}

void VertexMerging::render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                                PassControl& control) {
  const int group = static_cast<int>(owned_.group);
  if (!photons_can_count_) {
    film.add_estimates(group, 1);
    return;
  }
  const float radius_pixels = radius_of_pass(options_, film.format().picture_pixels(), key.pass);
  const PixelFootprint footprint = scene.camera->footprint();

  const MergeWeight merge_weight = [&](const CameraPath& path, const MergePoint& at, float radius) {
    // Below a surface the two techniques would be weighed at two different points (entry and exit):
    // merging alone finds these paths.
    if (at.events > 1 || at.vertex.subsurface_exit) return 1.0f;
    const auto line = scene.camera->connect(at.vertex.surface.p, path.u_lens, path.u_time);
    if (!line) return 1.0f;
    const float m = merges_per_splat(*line, at.vertex.surface.ng, radius);
    return m / (1.0f + m);
  };
  const MergePass merged = merge_pass(key, scene, film, owned_, options_, kUnguidedPhotons,
                                      radius_pixels, merge_weight, statistics_, control);
  found_ += merged.found;
  const ConnectionWeight splat_weight = [&](const CameraConnection& line, const WalkVertex& v) {
    const float radius = radius_pixels * footprint.width(line.distance);
    return 1.0f / (1.0f + merges_per_splat(line, v.surface.ng, radius));
  };
  SplatBuffer buffer(film, group, *scene.filter);
  const size_t parts = film.parts_of(group).size();
  const uint64_t of_splats =
      static_cast<uint64_t>(film.bounds().area()) *
      (MergePass::bytes_per_pixel(parts) + SplatBuffer::bytes_per_pixel(parts));
  statistics_.hold(0, of_splats);
  const int64_t paths =
      light_pass(key, scene, film, owned_, options_, splat_weight, buffer, statistics_, control);
  buffer.finish(1.0 / static_cast<double>(paths), merged.values);
  film.add_bias(group, merged.bias);
  film.add_estimates(group, 1);
}

EstimatorStatistics VertexMerging::statistics() const {
  EstimatorStatistics s = statistics_;
  explain_darkness(owned_, found_, s);
  return s;
}

}  // namespace nephroid
