#include "input/staging/sun_and_sky.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/equal_area_map.h"
#include "input/parameter_list.h"
#include "input/sky/hosek_wilkie_sky.h"
#include "input/sky/pfm_image.h"
#include "input/sky/preetham_sun.h"
#include "input/staging/default_view.h"

namespace nephroid {
namespace {

constexpr double kSunAngle = 0.53;  ///< angular diameter, degrees
constexpr double kLowestSun = 0.1;  ///< elevation of a sun on the horizon, degrees
constexpr double kTurbidity = 3;    ///< clear air
constexpr int kSkySize = 256;       ///< side of the sky's image, pixels
/// cd/m^2 of a radiance of 1 W / (m^2 sr nm) at all wavelengths.
constexpr float kLuminancePerRadiance = 683 * kCieYIntegral;
constexpr float kGround = 0.2f;  ///< reflectance
/// In memory; no file of a scene is called that.
constexpr const char* kSkyFile = "--sun#/sky.pfm";

void remove_lights(SceneDescription* scene, std::initializer_list<const char*> types) {
  std::erase_if(scene->lights, [&](const LightDescription& light) {
    return std::any_of(types.begin(), types.end(),
                       [&](const char* type) { return light.type == type; });
  });
}

/// A light in the frame east, north, up.
void add_light(SceneDescription* scene, const char* type, ParameterList list,
               const Surroundings& surroundings) {
  LightDescription& light = scene->lights.emplace_back();
  static_cast<DirectiveDescription&>(light) = std::move(list).directive(type);
  light.transform = {surroundings.to_world(), surroundings.to_world()};
}

/// Angles of the sun, in radians; it stands above the horizon.
struct SunAngles {
  double zenith, azimuth;

  explicit SunAngles(const SunDirection& sun)
      : zenith((90 - std::max(sun.elevation, kLowestSun)) * kDegree),
        azimuth(sun.azimuth * kDegree) {}
  /// In the frame east, north, up.
  Vec3d direction() const {
    return {std::sin(azimuth) * std::sin(zenith), std::cos(azimuth) * std::sin(zenith),
            std::cos(zenith)};
  }
};

/// The sky, and the ground that it and the sun light, as an equal-area octahedral map in cd/m^2.
struct SkyImage {
  std::vector<Rgb> pixels;  ///< rows from the top
  Rgb on_ground;            ///< illuminance of the ground by the sky, in lux

  SkyImage(const SunAngles& sun, const Rgb& sun_on_ground) : pixels(kSkySize * kSkySize) {
    const HosekWilkieSky sky(kTurbidity, Vec3d(kGround), 0.5 * kPiDouble - sun.zenith);
    const double per_pixel = 4 * kPiDouble / static_cast<double>(pixels.size());
    std::vector<size_t> below;
    for (size_t i = 0; i < pixels.size(); ++i) {
      const Vec3f w =
          equal_area_square_to_sphere({(static_cast<float>(i % kSkySize) + 0.5f) / kSkySize,
                                       (static_cast<float>(i / kSkySize) + 0.5f) / kSkySize});
      if (w.z <= 0) {
        below.push_back(i);
        continue;
      }
      const double to_sun = std::acos(std::clamp(to_double(w).dot(sun.direction()), -1.0, 1.0));
      pixels[i] = sky.radiance(std::acos(w.z), to_sun) * kLuminancePerRadiance;
      on_ground = on_ground + pixels[i] * static_cast<float>(w.z * per_pixel);
    }
    const Rgb ground = (on_ground + sun_on_ground) * (kGround * kInvPi);
    for (const size_t i : below) pixels[i] = ground;
  }
};

double luminance(const Rgb& c) {
  return RgbColorSpace::srgb().to_xyz(c).y;
}

void add_sky(SceneDescription* scene, const SkyImage& image, const Surroundings& surroundings) {
  scene->files->add_in_memory(kSkyFile, pfm_image(image.pixels, kSkySize, kSkySize));
  ParameterList list(not_in_a_file("--sun"));
  list.add_string("filename", kSkyFile);
  list.add_string("name", "sky");
  add_light(scene, "infinite", std::move(list), surroundings);
}

void add_sun(SceneDescription* scene, const Vec3d& to_sun, const Rgb& illuminance,
             const Surroundings& surroundings) {
  ParameterList list(not_in_a_file("--sun"));
  list.add_color("L", {illuminance.r, illuminance.g, illuminance.b});
  list.add_float("angle", kSunAngle);
  list.add_point("from", to_sun);
  list.add_point("to", {0, 0, 0});
  list.add_string("name", "sun");
  add_light(scene, "distant", std::move(list), surroundings);
}

}  // namespace

double set_sun(SceneDescription* scene, const SunDirection& sun, const Surroundings& surroundings) {
  const SunAngles angles(sun);
  const double solid_angle = 2 * kPiDouble * (1 - std::cos(0.5 * kSunAngle * kDegree));
  const Rgb of_sun = sun_radiance(angles.zenith, kTurbidity) *
                     static_cast<float>(solid_angle * kLuminancePerRadiance);
  const SkyImage image(angles, of_sun * static_cast<float>(std::cos(angles.zenith)));
  remove_lights(scene, {"infinite", "distant"});
  add_sky(scene, image, surroundings);
  add_sun(scene, angles.direction(), of_sun, surroundings);
  return luminance(of_sun) + luminance(image.on_ground);
}

void set_environment(SceneDescription* scene, const std::string& file,
                     const Surroundings& surroundings, double glow) {
  remove_lights(scene, {"infinite"});
  const bool is_alone = !has_light(*scene, glow);
  ParameterList list(not_in_a_file("--environment"));
  list.add_string("filename", std::filesystem::absolute(file).lexically_normal().string());
  // For an image pbrt-v4 gives twice the "illuminance" that is asked for.
  if (is_alone) list.add_float("illuminance", kPiDouble / 2);
  list.add_string("name", "environment");
  add_light(scene, "infinite", std::move(list), surroundings);
}

}  // namespace nephroid
