// The spherical camera: the film shows all directions around a point, by latitude and longitude or
// by Clarberg's equal-area map (pbrt-v4 section 5.3.1). It must not know images.
#include "core/equal_area_map.h"
#include "scene/camera/camera_table.h"

namespace nephroid {
namespace {

enum class SphereMapping { kEqualArea, kEquirectangular };

/// Wraps a point that a wide pixel filter moved over an edge of the octahedral square back to its
/// place on the sphere.
Vec2f wrap_octahedral(Vec2f uv) {
  for (int axis = 0; axis < 2; ++axis) {
    if (uv[axis] >= 0 && uv[axis] <= 1) continue;
    uv[axis] = uv[axis] < 0 ? -uv[axis] : 2 - uv[axis];
    uv[1 - axis] = 1 - uv[1 - axis];
  }
  return {std::clamp(uv.x, 0.0f, 1.0f), std::clamp(uv.y, 0.0f, 1.0f)};
}

class SphericalCamera final : public Camera {
 public:
  SphericalCamera(const CameraPlacement& placement, const CameraFilm& film, SphereMapping mapping)
      : Camera(placement), film_(film), mapping_(mapping) {
    footprint_ = footprint_of_central_pixel(*this, film);
  }

  std::optional<CameraRay> generate_ray(const Vec2f& film, const Vec2f&,
                                        float u_time) const override {
    const Vec2f uv(film.x / static_cast<float>(film_.width),
                   film.y / static_cast<float>(film_.height));
    Vec3f d;
    if (mapping_ == SphereMapping::kEquirectangular) {
      const float theta = kPi * uv.y, phi = 2 * kPi * uv.x;
      d = Vec3f(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    } else {
      d = equal_area_square_to_sphere(wrap_octahedral(uv));
    }
    // Both maps have their pole along z, the camera along y.
    return CameraRay{world_ray(Vec3f(0, 0, 0), Vec3f(d.x, d.z, d.y), u_time), 1.0f};
  }

  PixelFootprint footprint() const override { return footprint_; }

  std::optional<CameraConnection> connect(const Vec3f& p, const Vec2f&,
                                          float u_time) const override {
    const std::optional<Sight> sight = see(p, Vec3f(0, 0, 0), u_time);
    if (!sight) return std::nullopt;
    const Vec3f v = normalize(sight->v);
    const Vec3f d(v.x, v.z, v.y);
    Vec2f uv;
    float density;  // density of uv over the solid angle in camera space
    if (mapping_ == SphereMapping::kEquirectangular) {
      const float sine = std::hypot(d.x, d.y);
      const float phi = std::atan2(d.y, d.x);
      uv = Vec2f((phi < 0 ? phi + 2 * kPi : phi) * kInv2Pi, std::atan2(sine, d.z) * kInvPi);
      density = kInv2Pi * kInvPi / sine;
    } else {
      uv = equal_area_sphere_to_square(d);
      density = kInv4Pi;
    }
    CameraConnection c;
    c.p = sight->lens;
    c.wi = -sight->d;
    c.distance = sight->distance;
    const float w = static_cast<float>(film_.width), h = static_cast<float>(film_.height);
    c.film = Vec2f(uv.x * w, uv.y * h);
    const float stretch = length(sight->v);
    c.film_density =
        density * w * h * sight->camera_volume / (stretch * sqr(stretch) * sqr(c.distance));
    if (!std::isfinite(c.film_density)) return std::nullopt;
    return c;
  }

  // The inverse of how generate_ray wraps points outside.
  int repeats(const Vec2f& film, std::span<Vec2f, 3> out) const override {
    const float w = static_cast<float>(film_.width), h = static_cast<float>(film_.height);
    const float side = film.x < w / 2 ? 1.0f : -1.0f;
    if (mapping_ == SphereMapping::kEquirectangular) {
      // Around the sphere; over the pole the meridian continues half a turn away.
      const float y = film.y < h / 2 ? -film.y : 2 * h - film.y;
      out[0] = Vec2f(film.x + side * w, film.y);
      out[1] = Vec2f(film.x + side * w / 2, y);
      out[2] = Vec2f(film.x - side * w / 2, y);
    } else {
      const float u = film.x / w, v = film.y / h;
      const float along = v < 0.5f ? 1.0f : -1.0f;
      out[0] = Vec2f((u < 0.5f ? -u : 2 - u) * w, (1 - v) * h);
      out[1] = Vec2f((1 - u) * w, (v < 0.5f ? -v : 2 - v) * h);
      out[2] = Vec2f((u + side) * w, (v + along) * h);
    }
    return 3;
  }

 private:
  CameraFilm film_;
  SphereMapping mapping_;
  PixelFootprint footprint_;
};

}  // namespace

std::unique_ptr<Camera> make_spherical_camera(const CameraContext& c) {
  const ParameterSet& p = c.parameters;
  const std::string mapping = p.get_string("mapping", "equalarea");
  if (mapping == "equalarea")
    return std::make_unique<SphericalCamera>(c.placement, c.film, SphereMapping::kEqualArea);
  if (mapping == "equirectangular")
    return std::make_unique<SphericalCamera>(c.placement, c.film, SphereMapping::kEquirectangular);
  throw SceneError(p.find("mapping")->where,
                   "unknown mapping \"" + mapping +
                       "\" of the spherical camera, expected \"equalarea\" or \"equirectangular\"");
}

}  // namespace nephroid
