// A medium with absorption, scattering and emission as colours on a regular grid ("rgbgrid";
// pbrt-v4 section 11.4.3). It must not know rays outside its box.
#include "core/color.h"
#include "scene/medium/grid_parameters.h"
#include "scene/medium/medium_table.h"

namespace nephroid {

namespace {

/// A colour of the grid as a spectrum: a polynomial of at most about 1, and a scale. As in pbrt-v4
/// samples become spectra first and are then interpolated.
struct ColorSample {
  SigmoidPolynomial shape;
  float scale = 0.0f;

  SampledSpectrum sample(const SampledWavelengths& lambda) const {
    return scale > 0.0f ? shape.sample(lambda) * scale : SampledSpectrum();
  }
  float max_value() const { return scale > 0.0f ? scale * shape.max_value() : 0.0f; }
};
using ColorGrid = SampledGrid<ColorSample>;

/// sigma_a or sigma_s: 1 everywhere in the box if there is no grid.
struct ColorCoefficient {
  std::optional<ColorGrid> grid;

  SampledSpectrum at(const Vec3f& c, const SampledWavelengths& lambda) const {
    if (!grid) return SampledSpectrum(1.0f);
    return grid->lookup(c, [&](const ColorSample& s) { return s.sample(lambda); });
  }
  float max_value(const Vec3f& lo, const Vec3f& hi) const {
    if (!grid) return 1.0f;
    return grid->max_value(lo, hi, [](const ColorSample& s) { return s.max_value(); });
  }
  bool is_zero() const { return grid && !(max_value({0, 0, 0}, {1, 1, 1}) > 0.0f); }
};

/// "Le" times "Lescale": the illuminant of the colour space times the interpolated colour.
struct ColorEmission {
  std::optional<ColorGrid> grid;
  const Spectrum* illuminant = nullptr;
  float scale = 1.0f;
};

class RgbGridMedium final : public Medium {
 public:
  RgbGridMedium(const MediumSpace& space, ColorCoefficient sigma_a, ColorCoefficient sigma_s,
                float scale, HenyeyGreenstein phase, ColorEmission emission)
      : space_(space),
        sigma_a_(std::move(sigma_a)),
        sigma_s_(std::move(sigma_s)),
        scale_(scale),
        phase_(phase),
        emission_(std::move(emission)),
        majorants_(
            MajorantGrid::over_cells(kGridMajorants, [this](const Vec3f& lo, const Vec3f& hi) {
              return scale_ * (sigma_a_.max_value(lo, hi) + sigma_s_.max_value(lo, hi));
            })) {
    absorbing_ = scale == 0.0f || sigma_s_.is_zero();
    emissive_ = emission_.grid && emission_.scale > 0.0f && scale > 0.0f && !sigma_a_.is_zero();
  }

  bool is_emissive() const override { return emissive_; }
  bool is_purely_absorbing() const override { return absorbing_; }

  MediumProperties at(const Vec3f& p, const SampledWavelengths& lambda) const override {
    const Vec3f c = space_.to_cube(p);
    MediumProperties m{sigma_a_.at(c, lambda) * scale_, sigma_s_.at(c, lambda) * scale_,
                       SampledSpectrum(), phase_};
    if (emissive_) {
      const auto color = [&](const ColorSample& s) { return s.sample(lambda); };
      m.le =
          emission_.grid->lookup(c, color) * emission_.illuminant->sample(lambda) * emission_.scale;
    }
    return m;
  }
  MajorantIterator majorants(const Ray& ray, float t_max,
                             const SampledWavelengths&) const override {
    const auto r = space_.overlap(ray, t_max);
    if (!r) return {};
    return {r->o,
            r->d,
            r->t_min,
            r->t_max,
            SampledSpectrum(1.0f),
            majorants_.scales.data(),
            majorants_.resolution.data()};
  }

 private:
  MediumSpace space_;
  ColorCoefficient sigma_a_, sigma_s_;
  float scale_;
  HenyeyGreenstein phase_;
  ColorEmission emission_;
  MajorantGrid majorants_;  ///< majorants of extinction, the largest over wavelengths
  bool absorbing_, emissive_;
};

const RgbColorSpace& space_of(const Parameter& p) {
  const RgbColorSpace* space = RgbColorSpace::find(p.color_space);
  if (!space) throw SceneError(p.where, "unknown colour space \"" + p.color_space + "\"");
  return *space;
}

/// Reads the grid `name`. Empty if absent.
std::optional<ColorGrid> read_colors(const MediumDescription& d, const std::string& name) {
  const Parameter* p = d.parameters.find(name);
  if (!p) return std::nullopt;
  if (p->type != "rgb")
    throw SceneError(p->where, "\"" + name + "\" of medium \"" + d.name + "\" has type \"" +
                                   p->type + "\", expected \"rgb\"");
  const std::array<int, 3> resolution = read_grid_resolution(d, name, 3);
  const RgbColorSpace& space = space_of(*p);
  std::vector<ColorSample> samples(p->numbers.size() / 3);
  for (size_t i = 0; i < samples.size(); ++i) {
    float c[3];
    for (int k = 0; k < 3; ++k) {
      const double v = p->numbers[3 * i + k];
      // The scale below is twice the largest component and must not overflow.
      if (!(v >= 0.0 && v < 1e38))
        throw SceneError(p->where, "colour " + std::to_string(i) + " of \"" + name +
                                       "\" is negative or too large, expected values from 0 to "
                                       "1e38");
      c[k] = static_cast<float>(v);
    }
    ColorSample& s = samples[i];
    s.scale = 2.0f * std::max({c[0], c[1], c[2]});
    if (s.scale > 0.0f)
      s.shape = space.polynomial({c[0] / s.scale, c[1] / s.scale, c[2] / s.scale});
  }
  return ColorGrid(std::move(samples), resolution);
}

}  // namespace

NewMedium make_rgb_grid_medium(const MediumDescription& description, const MediumScope&) {
  const ParameterSet& p = description.parameters;
  ColorCoefficient sigma_a{read_colors(description, "sigma_a")};
  ColorCoefficient sigma_s{read_colors(description, "sigma_s")};
  ColorEmission emission{read_colors(description, "Le"), nullptr, read_factor(p, "Lescale", 1.0f)};
  if (!sigma_a.grid && !sigma_s.grid)
    throw SceneError(description.where, "medium \"" + description.name +
                                            "\" has neither \"sigma_a\" nor \"sigma_s\", expected "
                                            "at least one of them");
  if (emission.grid) {
    const Parameter& le = *p.find("Le");
    if (!sigma_a.grid)
      throw SceneError(le.where, "medium \"" + description.name +
                                     "\" has \"Le\" without \"sigma_a\", expected both");
    emission.illuminant = &space_of(le).illuminant();
  }
  return std::make_shared<RgbGridMedium>(read_medium_box(description), std::move(sigma_a),
                                         std::move(sigma_s), read_scale(p), read_phase(p),
                                         std::move(emission));
}

}  // namespace nephroid
