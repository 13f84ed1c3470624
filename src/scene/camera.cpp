#include "scene/camera.h"

#include "core/warps.h"
#include "scene/shape/shape.h"

namespace nephroid {

namespace {

// Perspective and orthographic cameras differ in how a film point becomes a camera ray; lens,
// shutter and transform are common to both (pbrt-v4 sections 5.2 and 5.3).
class ProjectiveCamera : public Camera {
 public:
  struct Settings {
    Transform camera_to_world;
    bool perspective = true;
    float tan_half_fov = 1;
    float screen[4] = {-1, 1, -1, 1};  ///< x0 x1 y0 y1
    float lens_radius = 0, focal_distance = 1e6f;
    float shutter_open = 0, shutter_close = 1;
    int width = 1, height = 1;
  };

  explicit ProjectiveCamera(const Settings& s) : s_(s) {
    const float screen_pixel =
        std::max(std::abs(s.screen[1] - s.screen[0]) / static_cast<float>(s.width),
                 std::abs(s.screen[3] - s.screen[2]) / static_cast<float>(s.height));
    if (s.perspective) {
      footprint_.spread = screen_pixel * s.tan_half_fov;
    } else {
      footprint_.offset = screen_pixel * length(s.camera_to_world.vector({1, 0, 0}));
    }
  }

  Ray generate_ray(const Vec2f& film, const Vec2f& u_lens, float u_time) const override {
    const float sx = lerp(film.x / static_cast<float>(s_.width), s_.screen[0], s_.screen[1]);
    const float sy = lerp(film.y / static_cast<float>(s_.height), s_.screen[3], s_.screen[2]);
    Vec3f o(0, 0, 0), d(0, 0, 1);
    if (s_.perspective)
      d = normalize(Vec3f(sx * s_.tan_half_fov, sy * s_.tan_half_fov, 1));
    else
      o = Vec3f(sx, sy, 0);
    // A thin lens: all rays of a film point meet on the plane of focus.
    if (s_.lens_radius > 0) {
      const Vec2f lens = square_to_disk(u_lens) * s_.lens_radius;
      const Vec3f focus = o + d * (s_.focal_distance / d.z);
      o = Vec3f(o.x + lens.x, o.y + lens.y, o.z);
      d = normalize(focus - o);
    }
    Ray ray;
    ray.o = s_.camera_to_world.point(o);
    ray.d = normalize(s_.camera_to_world.vector(d));
    ray.time = lerp(u_time, s_.shutter_open, s_.shutter_close);
    return ray;
  }

  PixelFootprint footprint() const override { return footprint_; }

 private:
  Settings s_;
  PixelFootprint footprint_;
};

void set_screen(ProjectiveCamera::Settings& s, const ParameterSet& p) {
  const float aspect =
      p.get_float("frameaspectratio", static_cast<float>(s.width) / static_cast<float>(s.height));
  if (!(aspect > 0)) throw SceneError(p.where, "frameaspectratio must be positive");
  const float x = aspect > 1 ? aspect : 1, y = aspect > 1 ? 1 : 1 / aspect;
  s.screen[0] = -x;
  s.screen[1] = x;
  s.screen[2] = -y;
  s.screen[3] = y;
  const std::vector<float> window = p.get_floats("screenwindow");
  if (window.empty()) return;
  if (window.size() != 4)
    throw SceneError(p.where, "\"screenwindow\" has " + std::to_string(window.size()) +
                                  " values, expected 4 (x0 x1 y0 y1)");
  for (size_t i = 0; i < 4; ++i) s.screen[i] = window[i];
  if (s.screen[0] == s.screen[1] || s.screen[2] == s.screen[3])
    throw SceneError(p.where, "\"screenwindow\" is empty");
}

/// Each number may be fine alone and the camera still so far away, or its screen so large, that
/// floating-point numbers do not hold its rays.
void check_rays(const Camera& camera, const ProjectiveCamera::Settings& s,
                const SourceLocation& where) {
  const float w = static_cast<float>(s.width), h = static_cast<float>(s.height);
  for (const Vec2f& film :
       {Vec2f(0, 0), Vec2f(w, 0), Vec2f(0, h), Vec2f(w, h), Vec2f(w / 2, h / 2)}) {
    const Ray ray = camera.generate_ray(film, Vec2f(0.3f, 0.6f), 0.5f);
    if (!is_in_reach(ray.o) || !(std::abs(length(ray.d) - 1) < 1e-3f))
      throw SceneError(where,
                       "the camera is too far away or its view too extreme, expected "
                       "coordinates up to 1e17");
  }
}

}  // namespace

std::unique_ptr<Camera> make_camera(const std::optional<CameraDescription>& description, int width,
                                    int height, Diagnostics& diagnostics) {
  static const ParameterSet kNone;
  const ParameterSet& p = description ? description->parameters : kNone;
  const std::string type = description ? description->type : "perspective";
  if (type != "perspective" && type != "orthographic") {
    const bool known = type == "realistic" || type == "spherical";
    throw SceneError(description->where, (known ? "camera \"" + type + "\" is not rendered yet"
                                                : "unknown camera \"" + type + "\"") +
                                             ", expected \"perspective\" or \"orthographic\"");
  }
  ProjectiveCamera::Settings s;
  s.width = width;
  s.height = height;
  s.perspective = type == "perspective";
  if (description) {
    if (description->world_to_camera.is_animated())
      diagnostics.warn(description->where,
                       "the camera moves: motion blur is not rendered yet, its start is used");
    s.camera_to_world = Transform(description->world_to_camera.start).inverted();
  }
  set_screen(s, p);
  if (s.perspective) {
    const float fov = p.get_float("fov", 90.0f);
    if (!(fov > 0 && fov < 180))
      throw SceneError(p.where, "\"fov\" must lie between 0 and 180 degrees");
    s.tan_half_fov = std::tan(fov * kPi / 360.0f);
  }
  s.lens_radius = p.get_float("lensradius", 0.0f);
  s.focal_distance = p.get_float("focaldistance", 1e6f);
  if (s.lens_radius < 0 || !(s.focal_distance > 0))
    throw SceneError(p.where, "\"lensradius\" must not be negative, \"focaldistance\" positive");
  s.shutter_open = p.get_float("shutteropen", 0.0f);
  s.shutter_close = p.get_float("shutterclose", 1.0f);
  if (description) p.report_unused("camera \"" + type + "\"", diagnostics);
  auto camera = std::make_unique<ProjectiveCamera>(s);
  check_rays(*camera, s, p.where);
  return camera;
}

}  // namespace nephroid
