#include "input/mitsuba/metals.h"

#include <array>

#include "core/spectra.h"
#include "input/mitsuba/parameter_values.h"
#include "input/spelling.h"

namespace nephroid::mitsuba {
namespace {

/// Values at 450, 550 and 650 nm, rounded (Palik, Handbook of Optical Constants of Solids), of
/// conductors whose spectra are not built in.
struct Metal {
  const char* name;
  std::array<double, 3> eta, k;
};
constexpr Metal kMetals[] = {
    {"Be", {3.1, 3.36, 3.46}, {3.16, 3.17, 3.2}},
    {"Cr", {1.93, 3.12, 3.64}, {4.17, 4.42, 4.36}},
    {"Hg", {1.06, 1.55, 2.07}, {3.86, 4.65, 5.34}},
    {"Ir", {1.83, 2.23, 2.56}, {3.66, 4.31, 4.67}},
    {"K", {0.043, 0.0493, 0.0506}, {1.06, 1.44, 1.8}},
    {"Li", {0.238, 0.206, 0.226}, {1.9, 2.47, 3.01}},
    {"Mo", {3.1, 3.78, 3.74}, {3.46, 3.52, 3.58}},
    {"Na", {0.0673, 0.0586, 0.0498}, {1.8, 2.25, 2.7}},
    {"Nb", {2.66, 2.93, 2.77}, {2.86, 2.87, 2.87}},
    {"Ni", {1.63, 1.77, 2.01}, {2.65, 3.25, 3.81}},
    {"Rh", {1.75, 1.97, 2.19}, {4.45, 5.02, 5.74}},
    {"Ta", {2.85, 2.47, 1.59}, {2.11, 1.84, 2.22}},
    {"TiN", {1.5, 1.25, 1.39}, {1.31, 2.1, 2.85}},
    {"V", {3.1, 3.68, 3.5}, {3.39, 3.02, 2.99}},
    {"W", {3.31, 3.5, 3.69}, {2.53, 2.73, 2.94}},
};

Parameter three_values(const std::array<double, 3>& v, const SourceLocation& where) {
  return numbers_parameter("spectrum", "", {360, v[0], 450, v[0], 550, v[1], 650, v[2], 830, v[2]},
                           where);
}

}  // namespace

MetalIndex metal_index(const std::string& name, const SourceLocation& where) {
  if (named_spectrum("metal-" + name + "-eta"))
    return {text_parameter("spectrum", "", {"metal-" + name + "-eta"}, where),
            text_parameter("spectrum", "", {"metal-" + name + "-k"}, where)};
  std::vector<std::string> known = {"none"};
  for (const Metal& metal : kMetals) {
    if (name == metal.name) return {three_values(metal.eta, where), three_values(metal.k, where)};
    known.emplace_back(metal.name);
  }
  for (const std::string& spectrum : named_spectra())
    if (spectrum.starts_with("metal-") && spectrum.ends_with("-eta"))
      known.push_back(spectrum.substr(6, spectrum.size() - 10));
  std::string names;
  for (const std::string& n : known) names += (names.empty() ? "" : ", ") + n;
  throw SceneError(where, "conductor \"" + name.substr(0, 40) +
                              "\" is unknown, expected eta and k, or one of " + names +
                              did_you_mean(name, known));
}

}  // namespace nephroid::mitsuba
