// The measured spectra of data/spectra by their pbrt-v4 names, and daylight. It must not know what
// the spectra are used for.
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "core/color_fit.h"
#include "core/spectra.h"
#include "core/spectra_data.h"
#include "core/spectra_dense.h"

namespace nephroid {
namespace {

using Registry = std::map<std::string, SpectrumPtr, std::less<>>;

SpectrumPtr column_spectrum(const DataTable& table, int column) {
  const auto lambda = table.column(0), value = table.column(column);
  return piecewise_linear_spectrum({lambda.begin(), lambda.end()}, {value.begin(), value.end()});
}

Registry make_registry() {
  Registry registry;
  const std::string illuminant = "illuminant-", glass_sf = "glass-SF";
  for (const DataTable& table : data_tables()) {
    const std::string name(table.name);
    if (name.starts_with(illuminant)) {
      const std::string which = name.substr(illuminant.size());
      registry[(which == "acesD60" ? "illum-" : "stdillum-") + which] =
          std::make_shared<DenseSpectrum>(table.column(0));
    } else if (name.starts_with("metal-")) {
      registry[name + "-eta"] = column_spectrum(table, 1);
      registry[name + "-k"] = column_spectrum(table, 2);
    } else if (name.starts_with("glass-")) {
      registry[name] = column_spectrum(table, 1);
      // pbrt-v4 calls SF5 "F5", and so on.
      if (name.starts_with(glass_sf))
        registry["glass-F" + name.substr(glass_sf.size())] = registry[name];
    }
  }
  return registry;
}

const Registry& registry() {
  static const Registry spectra = make_registry();
  return spectra;
}

/// Chromaticity x of daylight at a correlated colour temperature (CIE 015, section 4.1.2).
double daylight_x(double kelvin) {
  const double m = 1000.0 / kelvin;
  if (kelvin <= 7000.0) return ((-4.6070 * m + 2.9678) * m + 0.09911) * m + 0.244063;
  return ((-2.0064 * m + 1.9018) * m + 0.24748) * m + 0.237040;
}

}  // namespace

SpectrumPtr named_spectrum(std::string_view name) {
  const auto found = registry().find(name);
  return found == registry().end() ? nullptr : found->second;
}

std::vector<std::string> named_spectra() {
  std::vector<std::string> names;
  for (const auto& [name, spectrum] : registry()) names.push_back(name);
  return names;
}

SpectrumPtr daylight_spectrum(float kelvin) {
  // The series was defined with an older value of Planck's second radiation constant.
  const double cct = kelvin * 1.4388 / 1.4380;
  if (!(cct >= 4000.0)) return blackbody_spectrum(kelvin);
  const double x = daylight_x(cct);
  const double y = (-3.0 * x + 2.870) * x - 0.275;
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
  const double m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;

  const DataTable basis = data_table("daylight");
  std::vector<float> values;
  for (int i = 0; i < kTableNodes; ++i)
    values.push_back(static_cast<float>(
        0.01 * (basis.column(0)[i] + m1 * basis.column(1)[i] + m2 * basis.column(2)[i])));
  return std::make_shared<DenseSpectrum>(values);
}

}  // namespace nephroid
