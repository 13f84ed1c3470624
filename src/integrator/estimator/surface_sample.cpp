#include "integrator/estimator/surface_sample.h"

namespace nephroid {

SurfaceSample surface_sample(const Scene& scene, const CameraPath& path,
                             const FirstSurface& first) {
  const Camera& camera = *scene.camera;
  const Transform out = scene.film.gbuffer == GBufferSpace::kCamera
                            ? camera.camera_to_world(path.walk.ray.time).inverted()
                            : Transform();
  SurfaceSample s;
  s.p = out.point(first.p);
  s.n = normalize(out.normal(face_forward(first.ng, first.wo)));
  s.ns = normalize(out.normal(face_forward(first.ns, first.wo)));
  s.uv = first.uv;
  const float step =
      scene.options.pixel_jitter
          ? std::max(0.125f, 1.0f / std::sqrt(static_cast<float>(scene.samples_per_pixel)))
          : 1.0f;
  // Depths at which the neighbours' rays meet the tangent plane.
  const auto depth_difference = [&](const Vec2f& offset) {
    const std::optional<CameraRay> c =
        camera.generate_ray(path.film + offset * step, path.u_lens, path.u_time);
    if (!c) return 0.0f;
    const float t = dot(first.ng, first.p - c->ray.o) / dot(first.ng, c->ray.d);
    const float dz = out.vector(c->ray.o + c->ray.d * t - first.p).z;
    return std::isfinite(dz) ? dz : 0.0f;
  };
  s.dzdx = depth_difference({1, 0});
  s.dzdy = depth_difference({0, 1});
  return s;
}

}  // namespace nephroid
