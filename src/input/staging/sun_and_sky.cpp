#include "input/staging/sun_and_sky.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/equal_area_map.h"
#include "input/parameter_list.h"
#include "input/staging/default_view.h"
#include "input/staging/preetham_sky.h"

namespace nephroid {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;
constexpr double kSunAngle = 0.53;  ///< angular diameter, degrees
constexpr int kSkySize = 256;       ///< side of the sky's image, pixels
constexpr float kGround = 0.2f;     ///< reflectance
constexpr const char* kSkyFile = "sky.pfm";

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

Vec3d direction_to(const SunDirection& sun) {
  const double elevation = sun.elevation * kPiDouble / 180, azimuth = sun.azimuth * kPiDouble / 180;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

/// The sky and the ground that it and the sun light, as an equal-area octahedral map.
struct SkyImage {
  std::vector<Rgb> pixels;  ///< cd/m^2, rows from the top
  double illuminance = 0;   ///< of the ground, by the sky, in lux

  SkyImage(const PreethamSky& sky, double sun_on_ground) : pixels(kSkySize * kSkySize) {
    const double per_pixel = 4 * kPiDouble / static_cast<double>(pixels.size());
    std::vector<size_t> below;
    Rgb on_ground{};
    for (size_t i = 0; i < pixels.size(); ++i) {
      const Vec3f w =
          equal_area_square_to_sphere({(static_cast<float>(i % kSkySize) + 0.5f) / kSkySize,
                                       (static_cast<float>(i / kSkySize) + 0.5f) / kSkySize});
      if (w.z <= 0) {
        below.push_back(i);
        continue;
      }
      pixels[i] = sky.luminance(to_double(w));
      on_ground = on_ground + pixels[i] * static_cast<float>(w.z * per_pixel);
    }
    illuminance = RgbColorSpace::srgb().to_xyz(on_ground).y;
    const auto sun = static_cast<float>(sun_on_ground);
    const Rgb ground = (on_ground + Rgb{sun, sun, sun}) * (kGround * kInvPi);
    for (const size_t i : below) pixels[i] = ground;
  }

  /// The image as a PFM file, whose rows begin at the bottom, in the machine's byte order.
  std::string pfm() const {
    std::string bytes = "PF\n" + std::to_string(kSkySize) + " " + std::to_string(kSkySize) +
                        (std::endian::native == std::endian::little ? "\n-1.0\n" : "\n1.0\n");
    const size_t head = bytes.size(), row_bytes = kSkySize * 3 * sizeof(float);
    bytes.resize(head + kSkySize * row_bytes);
    for (size_t row = 0; row < kSkySize; ++row) {
      std::vector<float> values;
      for (size_t x = 0; x < kSkySize; ++x) {
        const Rgb& c = pixels[row * kSkySize + x];
        values.insert(values.end(), {c.r, c.g, c.b});
      }
      std::memcpy(bytes.data() + head + (kSkySize - 1 - row) * row_bytes, values.data(), row_bytes);
    }
    return bytes;
  }
};

}  // namespace

double set_sun(SceneDescription* scene, const SunDirection& sun, const Surroundings& surroundings) {
  const Vec3d to_sun = direction_to(sun);
  const PreethamSky sky(to_sun);
  const SkyImage image(sky, sky.sun_illuminance() * to_sun.z);
  remove_lights(scene, {"infinite", "distant"});

  const SourceLocation where = not_in_a_file("--sun");
  scene->files->add_in_memory(kSkyFile, image.pfm());
  ParameterList of_sky(where);
  of_sky.add_string("filename", kSkyFile);
  of_sky.add_string("name", "sky");
  add_light(scene, "infinite", std::move(of_sky), surroundings);

  ParameterList of_sun(where);
  std::vector<double> spectrum;
  for (const auto& sample : sky.sun_spectrum())
    spectrum.insert(spectrum.end(), {sample.first, sample.second});
  of_sun.add_numbers("spectrum", "L", std::move(spectrum));
  of_sun.add_float("illuminance", sky.sun_illuminance());
  of_sun.add_float("angle", kSunAngle);
  of_sun.add_point("from", to_sun);
  of_sun.add_point("to", {0, 0, 0});
  of_sun.add_string("name", "sun");
  add_light(scene, "distant", std::move(of_sun), surroundings);
  return sky.sun_illuminance() + image.illuminance;
}

void set_environment(SceneDescription* scene, const std::string& file,
                     const Surroundings& surroundings) {
  remove_lights(scene, {"infinite"});
  const bool is_alone = !has_light(*scene);
  ParameterList list(not_in_a_file("--environment"));
  list.add_string("filename", std::filesystem::absolute(file).lexically_normal().string());
  // For an image pbrt-v4 gives twice the "illuminance" that is asked for.
  if (is_alone) list.add_float("illuminance", kPiDouble / 2);
  list.add_string("name", "environment");
  add_light(scene, "infinite", std::move(list), surroundings);
}

}  // namespace nephroid
