// The perspective and the orthographic camera, with a thin lens. They differ only in how a film
// point becomes a camera ray (pbrt-v4 sections 5.2 and 5.3). It must not know lens systems.
#include "core/counted.h"
#include "core/warps.h"
#include "scene/camera/camera_table.h"

namespace nephroid {
namespace {

class ProjectiveCamera final : public Camera {
 public:
  struct Settings {
    bool perspective = true;
    float tan_half_fov = 1;
    float screen[4] = {-1, 1, -1, 1};  ///< x0 x1 y0 y1
    float lens_radius = 0, focal_distance = 1e6f;
    int width = 1, height = 1;
  };

  ProjectiveCamera(const CameraPlacement& placement, const Settings& s) : Camera(placement), s_(s) {
    const float screen_pixel =
        std::max(std::abs(s.screen[1] - s.screen[0]) / static_cast<float>(s.width),
                 std::abs(s.screen[3] - s.screen[2]) / static_cast<float>(s.height));
    if (s.perspective)
      footprint_.spread = screen_pixel * s.tan_half_fov;
    else if (s.lens_radius > 0)
      footprint_.spread = screen_pixel / s.focal_distance;
    else
      footprint_.offset = screen_pixel * length(camera_to_world(0).vector({1, 0, 0}));
    pixels_per_screen_area_ = static_cast<float>(s.width) * static_cast<float>(s.height) /
                              std::abs((s.screen[1] - s.screen[0]) * (s.screen[3] - s.screen[2]));
  }

  std::optional<CameraRay> generate_ray(const Vec2f& film, const Vec2f& u_lens,
                                        float u_time) const override {
    const float sx = lerp(film.x / static_cast<float>(s_.width), s_.screen[0], s_.screen[1]);
    const float sy = lerp(film.y / static_cast<float>(s_.height), s_.screen[3], s_.screen[2]);
    Vec3f o(0, 0, 0), d(0, 0, 1);
    if (s_.perspective)
      d = normalize(Vec3f(sx * s_.tan_half_fov, sy * s_.tan_half_fov, 1));
    else
      o = Vec3f(sx, sy, 0);
    // Thin lens: all rays of a film point meet on the plane of focus. As in pbrt-v4 the lens lies
    // around the optical axis, even if an orthographic camera's film points do not.
    if (s_.lens_radius > 0) {
      const Vec2f lens = square_to_disk(u_lens) * s_.lens_radius;
      const Vec3f focus = o + d * (s_.focal_distance / d.z);
      o = Vec3f(lens.x, lens.y, 0);
      d = normalize(focus - o);
    }
    return CameraRay{world_ray(o, d, u_time), 1.0f};
  }

  PixelFootprint footprint() const override { return footprint_; }

  std::optional<CameraConnection> connect(const Vec3f& p, const Vec2f& u_lens,
                                          float u_time) const override {
    if (!s_.perspective && !(s_.lens_radius > 0)) return connect_in_parallel(p, u_time);
    const Vec2f disk = s_.lens_radius > 0 ? square_to_disk(u_lens) : Vec2f(0, 0);
    const Vec3f lens(disk.x * s_.lens_radius, disk.y * s_.lens_radius, 0);
    const std::optional<Sight> sight = see(p, lens, u_time);
    if (!sight || !(sight->v.z > 0)) return std::nullopt;
    // All rays of a film point meet where the central one crosses the plane of focus. The screen is
    // the plane z = 1, or for an orthographic camera the plane of focus.
    const float slope_x = sight->v.x / sight->v.z, slope_y = sight->v.y / sight->v.z;
    const float screen_z = s_.perspective ? 1.0f : s_.focal_distance;
    const float to_screen = screen_z / s_.focal_distance;
    const float zoom = s_.perspective ? 1 / s_.tan_half_fov : 1.0f;
    // From world to camera space solid angles scale by camera_volume / |v|^3. An area of the screen
    // is screen_z^2 / cos^3 times its solid angle.
    return connection(*sight, (slope_x * screen_z + lens.x * to_screen) * zoom,
                      (slope_y * screen_z + lens.y * to_screen) * zoom,
                      sqr(zoom * screen_z) * sight->camera_volume /
                          (sight->v.z * sqr(sight->v.z) * sqr(sight->distance)));
  }

 private:
  /// Without a lens, an orthographic camera looks along z from every point of its screen.
  std::optional<CameraConnection> connect_in_parallel(const Vec3f& p, float u_time) const {
    const Transform to_world = camera_to_world(motion_time(u_time));
    const Vec3f at = to_world.inverted().point(p);
    if (!(at.z > 0) || !is_finite(at)) return std::nullopt;
    const std::optional<Sight> sight = see(p, Vec3f(at.x, at.y, 0), u_time);
    if (!sight) return std::nullopt;
    const float stretch = length(to_world.vector(Vec3f(0, 0, 1)));
    return connection(*sight, at.x, at.y, sight->camera_volume * stretch);
  }

  /// The connection through the screen point (sx, sy). `screen_area` is the screen area per unit
  /// area perpendicular to the connection.
  std::optional<CameraConnection> connection(const Sight& sight, float sx, float sy,
                                             float screen_area) const {
    CameraConnection c;
    c.p = sight.lens;
    c.wi = -sight.d;
    c.distance = sight.distance;
    c.film.x = (sx - s_.screen[0]) / (s_.screen[1] - s_.screen[0]) * static_cast<float>(s_.width);
    c.film.y = (sy - s_.screen[3]) / (s_.screen[2] - s_.screen[3]) * static_cast<float>(s_.height);
    c.film_density = screen_area * pixels_per_screen_area_;
    if (!std::isfinite(c.film.x) || !std::isfinite(c.film.y) || !std::isfinite(c.film_density))
      return std::nullopt;
    return c;
  }

  Settings s_;
  float pixels_per_screen_area_ = 1;
  PixelFootprint footprint_;
};

void set_screen(ProjectiveCamera::Settings& s, const ParameterSet& p) {
  const float aspect =
      p.get_float("frameaspectratio", static_cast<float>(s.width) / static_cast<float>(s.height));
  if (!(aspect > 0)) throw SceneError(p.where, "\"frameaspectratio\" must be positive");
  const float x = aspect > 1 ? aspect : 1, y = aspect > 1 ? 1 : 1 / aspect;
  s.screen[0] = -x;
  s.screen[1] = x;
  s.screen[2] = -y;
  s.screen[3] = y;
  const std::vector<float> window = p.get_floats("screenwindow");
  if (window.empty()) return;
  if (window.size() != 4)
    throw SceneError(p.where, "\"screenwindow\" has " + counted(window.size(), "value") +
                                  ", expected 4 (x0 x1 y0 y1)");
  for (size_t i = 0; i < 4; ++i) s.screen[i] = window[i];
  if (s.screen[0] == s.screen[1] || s.screen[2] == s.screen[3])
    throw SceneError(p.where,
                     "\"screenwindow\" is empty, expected x0 and x1 to differ, and y0 and y1");
}

ProjectiveCamera::Settings common_settings(const CameraContext& c) {
  ProjectiveCamera::Settings s;
  s.width = c.film.width;
  s.height = c.film.height;
  set_screen(s, c.parameters);
  s.lens_radius = c.parameters.get_float("lensradius", 0.0f);
  s.focal_distance = c.parameters.get_float("focaldistance", 1e6f);
  if (s.lens_radius < 0 || !(s.focal_distance > 0))
    throw SceneError(c.parameters.where,
                     "\"lensradius\" must not be negative, and \"focaldistance\" must be positive");
  return s;
}

}  // namespace

std::unique_ptr<Camera> make_perspective_camera(const CameraContext& c) {
  ProjectiveCamera::Settings s = common_settings(c);
  const float fov = c.parameters.get_float("fov", 90.0f);
  if (!(fov > 0 && fov < 180))
    throw SceneError(c.parameters.where, "\"fov\" must lie between 0 and 180 degrees");
  s.tan_half_fov = std::tan(fov * kPi / 360.0f);
  return std::make_unique<ProjectiveCamera>(c.placement, s);
}

std::unique_ptr<Camera> make_orthographic_camera(const CameraContext& c) {
  ProjectiveCamera::Settings s = common_settings(c);
  s.perspective = false;
  return std::make_unique<ProjectiveCamera>(c.placement, s);
}

}  // namespace nephroid
