// A medium with density and emission on a regular grid ("uniformgrid"; pbrt-v4 section 11.4.2). It
// must not know rays outside its box.
#include "scene/medium/grid_parameters.h"
#include "scene/medium/medium_table.h"

namespace nephroid {

namespace {

using FloatGrid = SampledGrid<float>;

float identity(float x) {
  return x;
}

/// Emission of the grid per unit of absorption.
struct GridEmission {
  FloatGrid scale;                       ///< "Lescale", over the luminance of "Le"
  DenseSpectrum le;                      ///< "Le"
  std::optional<FloatGrid> temperature;  ///< black-body temperatures, instead of `le`
  TemperatureMap kelvin;
  bool any = false;
};

class UniformGridMedium final : public Medium {
 public:
  UniformGridMedium(const MediumSpace& space, const Extinction& extinction, HenyeyGreenstein phase,
                    FloatGrid density, GridEmission emission)
      : space_(space),
        extinction_(extinction),
        phase_(phase),
        density_(std::move(density)),
        emission_(std::move(emission)),
        majorants_(
            MajorantGrid::over_cells(kGridMajorants, [this](const Vec3f& lo, const Vec3f& hi) {
              return density_.max_value(lo, hi, identity);
            })) {
    absorbing_ = !(extinction.sigma_s.max_value() > 0.0f);
    emission_.any &= extinction.sigma_a.max_value() > 0.0f;
  }

  bool is_emissive() const override { return emission_.any; }
  bool is_purely_absorbing() const override { return absorbing_; }

  MediumProperties at(const Vec3f& p, const SampledWavelengths& lambda) const override {
    const Vec3f c = space_.to_cube(p);
    const float density = density_.lookup(c, identity);
    return {extinction_.sigma_a.sample(lambda) * density,
            extinction_.sigma_s.sample(lambda) * density, emitted(c, lambda), phase_};
  }
  MajorantIterator majorants(const Ray& ray, float t_max,
                             const SampledWavelengths& lambda) const override {
    const auto r = space_.overlap(ray, t_max);
    if (!r) return {};
    return {r->o,
            r->d,
            r->t_min,
            r->t_max,
            extinction_.sigma_a.sample(lambda) + extinction_.sigma_s.sample(lambda),
            majorants_.scales.data(),
            majorants_.resolution.data()};
  }

 private:
  SampledSpectrum emitted(const Vec3f& c, const SampledWavelengths& lambda) const {
    if (!emission_.any) return SampledSpectrum();
    const float scale = emission_.scale.lookup(c, identity);
    if (!(scale > 0.0f)) return SampledSpectrum();
    if (!emission_.temperature) return emission_.le.sample(lambda) * scale;
    return emission_.kelvin.blackbody(emission_.temperature->lookup(c, identity), lambda) * scale;
  }

  MediumSpace space_;
  Extinction extinction_;  ///< extinction at density 1
  HenyeyGreenstein phase_;
  FloatGrid density_;
  GridEmission emission_;
  MajorantGrid majorants_;  ///< majorants of density
  bool absorbing_;
};

GridEmission read_grid_emission(const MediumDescription& d, const MediumScope& scope,
                                const std::array<int, 3>& resolution) {
  const ParameterSet& p = d.parameters;
  const Parameter* temperature = p.find("temperature");
  const Parameter* le = p.find("Le");
  if (temperature && le)
    throw SceneError(le->where, "medium \"" + d.name +
                                    "\" has both \"Le\" and \"temperature\", expected one of them");
  // As in pbrt-v4 a missing "Lescale" is a grid of one sample, which falls off towards the walls.
  FloatGrid scale = p.find("Lescale")
                        ? FloatGrid(read_grid_floats(d, "Lescale", resolution), resolution)
                        : FloatGrid({1.0f}, {1, 1, 1});
  GridEmission e{std::move(scale), read_emission(p, 1.0f, scope.files), std::nullopt,
                 read_temperature_map(p)};
  if (temperature)
    e.temperature = FloatGrid(read_grid_floats(d, "temperature", resolution, true), resolution);
  e.any = temperature || e.le.max_value() > 0.0f;
  return e;
}

}  // namespace

NewMedium make_uniform_grid_medium(const MediumDescription& description, const MediumScope& scope) {
  const ParameterSet& p = description.parameters;
  const std::array<int, 3> resolution = read_grid_resolution(description, "density", 1);
  FloatGrid density(read_grid_floats(description, "density", resolution), resolution);
  return std::make_shared<UniformGridMedium>(
      read_medium_box(description), read_extinction(p, read_scale(p), scope.files), read_phase(p),
      std::move(density), read_grid_emission(description, scope, resolution));
}

}  // namespace nephroid
