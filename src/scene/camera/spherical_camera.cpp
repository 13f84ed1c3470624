// The spherical camera: the film shows all directions around a point, by latitude and longitude or
// by Clarberg's equal-area map (pbrt-v4 section 5.3.1).
// Who calls it: the table. It must not know images.
#include "scene/camera/camera_table.h"
#include "scene/light/equal_area_map.h"

namespace nephroid {
namespace {

enum class SphereMapping { kEqualArea, kEquirectangular };

/// A point that a wide pixel filter has moved over an edge of the octahedral square, brought back
/// to where the sphere goes on.
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
