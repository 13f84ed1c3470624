#include "transport/camera_connection.h"

#include "transport/direct_light.h"

namespace nephroid {

CameraView::CameraView(const Scene& scene, const PixelBounds& crop) : camera_(*scene.camera) {
  const Vec2f radius = scene.filter->radius();
  low_ = Vec2f(static_cast<float>(crop.x0), static_cast<float>(crop.y0)) - radius;
  high_ = Vec2f(static_cast<float>(crop.x1), static_cast<float>(crop.y1)) + radius;
}

std::optional<LensConnection> CameraView::connect(const Vec3f& p, const Vec2f& u_lens,
                                                  float u_time) const {
  const std::optional<CameraConnection> line = camera_.connect(p, u_lens, u_time);
  if (!line) return std::nullopt;
  LensConnection e{*line, {}, 0};
  const auto add = [&](const Vec2f& film) {
    if (reaches(film)) e.film[e.count++] = film;
  };
  add(line->film);
  std::array<Vec2f, 3> repeats;
  const int count = camera_.repeats(line->film, repeats);
  for (int i = 0; i < count; ++i) add(repeats[i]);
  if (e.count == 0) return std::nullopt;
  return e;
}

SampledSpectrum attenuation_to_camera(const Scene& scene, const Vec3f& origin, float time,
                                      const Medium* medium, const CameraConnection& line,
                                      const SampledWavelengths& lambda,
                                      const PathSampler& sampler) {
  Ray ray;
  ray.o = origin;
  const Vec3f way = line.p - origin;
  ray.d = normalize(way);
  ray.t_max = length(way);
  ray.time = time;
  if (!(ray.t_max > 0.0f)) return SampledSpectrum(0.0f);
  return attenuation_along(scene, ray, medium, lambda, sampler);
}

}  // namespace nephroid
