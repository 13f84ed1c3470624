#include "input/mitsuba/refraction_index.h"

#include <cmath>
#include <vector>

#include "input/mitsuba/value_text.h"
#include "input/spelling.h"

namespace nephroid::mitsuba {
namespace {

struct Substance {
  const char* name;
  double index;
};

/// Indices at 589 nm (Hecht, Optics, fourth edition), by Mitsuba's names.
constexpr Substance kSubstances[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
};

double index_of(const std::string& name, const SourceLocation& where) {
  const std::string lower = lower_case(trimmed(name));
  std::vector<std::string> known;
  for (const Substance& s : kSubstances) {
    if (lower == s.name) return s.index;
    known.emplace_back(s.name);
  }
  throw SceneError(where,
                   "substance \"" + name.substr(0, 40) +
                       "\" is unknown, expected a refractive index or a name such as \"bk7\"" +
                       did_you_mean(lower, known));
}

/// Fresnel reflectance of unpolarized light; `eta` is transmitted over incident index.
double fresnel(double cosine, double eta) {
  const double sine2 = (1 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1) return 1;
  const double transmitted = std::sqrt(1 - sine2);
  const double parallel = (eta * cosine - transmitted) / (eta * cosine + transmitted);
  const double perpendicular = (cosine - eta * transmitted) / (cosine + eta * transmitted);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

}  // namespace

double refraction_index(PluginProperties& properties, const std::string& name,
                        const char* fallback) {
  const Property* p = properties.find(name);
  const SourceLocation where = p ? p->where : properties.where();
  if (!p || p->tag == "string") return index_of(properties.text(name, fallback), where);
  const double index = properties.number(name, 1);
  if (!(index >= 0.01 && index <= 100))
    throw SceneError(where, "refractive index \"" + name +
                                "\" is out of range, expected 0.01 to "
                                "100");
  return index;
}

double relative_index(PluginProperties& properties, const char* interior) {
  const double inside = refraction_index(properties, "int_ior", interior);
  return inside / refraction_index(properties, "ext_ior", "air");
}

double internal_diffuse_reflectance(double eta) {
  // Midpoint rule over sin^2, for which irradiance is uniform.
  constexpr int kSteps = 4096;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += fresnel(std::sqrt(1 - (i + 0.5) / kSteps), 1 / eta);
  return sum / kSteps;
}

}  // namespace nephroid::mitsuba
