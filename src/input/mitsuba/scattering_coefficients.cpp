#include "input/mitsuba/scattering_coefficients.h"

#include <cctype>

#include "input/mitsuba/color_value.h"
#include "input/mitsuba/volume_source.h"

namespace nephroid::mitsuba {
namespace {

/// The colour of a property or of a constant volume.
std::optional<Vec3d> constant_of(PluginProperties& p, const char* name) {
  if (const Object* volume = p.child("volume", name)) return constant_volume(p.context(), *volume);
  return read_rgb(p, name);
}

}  // namespace

Coefficients of_extinction(const Vec3d& extinction, const Vec3d& albedo) {
  return {extinction * (Vec3d(1.0) - albedo), extinction * albedo};
}

Vec3d read_albedo(PluginProperties& p) {
  const Vec3d albedo = constant_of(p, "albedo").value_or(Vec3d(0.75));
  for (int i = 0; i < 3; ++i)
    if (!(albedo[i] >= 0 && albedo[i] <= 1))
      throw SceneError(p.where(), "\"albedo\" is out of range, expected 0 to 1");
  return albedo;
}

std::optional<Coefficients> read_coefficients(PluginProperties& p) {
  const auto absorption = constant_of(p, "sigma_a"), scattering = constant_of(p, "sigma_s");
  const auto extinction = constant_of(p, "sigma_t");
  if (absorption || scattering)
    return Coefficients{absorption.value_or(Vec3d(0.0)), scattering.value_or(Vec3d(0.0))};
  if (!extinction) return std::nullopt;
  return of_extinction(*extinction, read_albedo(p));
}

std::string preset_name(PluginProperties& p) {
  // Mitsuba compares without case; pbrt-v4's names have a capital in each word.
  std::string name = p.text("material", "Skin1");
  for (size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    const bool begins = i == 0 || name[i - 1] == ' ';
    name[i] = static_cast<char>(begins ? std::toupper(c) : std::tolower(c));
  }
  return name;
}

}  // namespace nephroid::mitsuba
