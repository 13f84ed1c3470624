// Measured reflection (Dupuy & Jakob 2018; [R1] to [R3] of docs/estimators.md). A warp by visible
// facets maps the unit square to half vectors, so values on the square are smooth. Always class G:
// the file does not tell how narrow the lobe is, and a measured mirror would show the instrument.
// It must not know files.
#pragma once

#include "scene/bsdf/bilinear_warp.h"
#include "scene/bsdf/bsdf.h"

namespace nephroid {

/// Contents of a file. Directions are polar angles and azimuths in radians. Grids lie on the square
/// (sqrt(2 theta / pi), (phi + pi) / (2 pi)) of facet normals or directions. The last two lie on
/// the square that the facet warp maps to facet normals. All numbers are finite and at most
/// MeasuredBrdf::kMaxValue.
struct MeasuredTables {
  std::vector<float> phi, theta;   ///< outgoing direction, increasing; grids [phi][theta]
  std::vector<float> wavelengths;  ///< nm, increasing
  GridFamily facets;               ///< density of facet normals, one grid
  GridFamily projected_area;       ///< projected area of the facets by direction, one grid
  GridFamily visible_facets;       ///< density over the square of normals, by outgoing direction
  GridFamily luminance;            ///< density of samples, by outgoing direction
  GridFamily spectra;  ///< f cos / pdf_w of visible facets, grids [phi][theta][wavelength]
  bool values_are_ratios = true;  ///< false: `spectra` holds f cos itself
};

/// A path's wavelengths located among those of a file.
using WavelengthPlaces = std::array<ParameterAxis::Place, kSpectrumSamples>;

/// One measured surface, shared by all points that have it. Constant after construction.
class MeasuredBrdf {
 public:
  static constexpr float kMaxValue = 1e9f;  ///< bound of all numbers in the tables

  explicit MeasuredBrdf(MeasuredTables tables);

  WavelengthPlaces places(const SampledWavelengths& lambda) const;
  /// f without cosine for light from wi that leaves towards wo, both unit and above; and the
  /// density pdf_w with which sample(wo, ...) returns wi.
  BsdfEval evaluate(const Vec3f& wo, const Vec3f& wi, const WavelengthPlaces& places) const;
  struct Sample {
    SampledSpectrum f;
    Vec3f wi;
    float pdf_w = 0;
  };
  /// Samples wi for a wo above. Empty if the sampled facet reflects below.
  std::optional<Sample> sample(const Vec3f& wo, const Vec2f& u,
                               const WavelengthPlaces& places) const;
  /// Approximate reflectance: the mean of the tabulated ratios.
  SampledSpectrum albedo(const Vec3f& wo, const WavelengthPlaces& places) const;

 private:
  struct View;
  View view_from(const Vec3f& wo) const;
  Vec2f facet_at(const View& view, const Vec3f& m) const;
  SampledSpectrum ratio(const View& view, const Vec2f& u, const WavelengthPlaces& places) const;
  float factor(const View& view, const Vec2f& facet, float cos_i) const;

  ParameterAxis phi_, theta_, wavelengths_;
  bool isotropic_, values_are_ratios_;
  int symmetry_;  ///< number of measured azimuth ranges in a full turn: 1, 2 or 4
  BilinearFunction facets_, projected_area_;
  BilinearWarp visible_facets_, luminance_;
  GridFamily nodes_;            ///< size of the spectra's grids, without values
  std::vector<float> spectra_;  ///< [phi][theta][y][x][wavelength]
  std::vector<float> means_;    ///< [phi][theta][wavelength]
};

/// Reflects on both sides alike (rotated by half a turn). Measured values need not be reciprocal:
/// both modes use the value with the camera's direction as the outgoing one. For walks from a light
/// the tables predict that value only roughly, so they also sample a share of directions by the
/// cosine.
class MeasuredBsdf final : public Bsdf {
 public:
  /// `brdf` outlives the object.
  MeasuredBsdf(const MeasuredBrdf& brdf, const SampledWavelengths& lambda)
      : brdf_(&brdf), places_(brdf.places(lambda)) {}

  ClassMask classes() const override { return ClassMask::kGlossy; }
  ClassMask finite_classes() const override { return ClassMask::kGlossy; }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  SampledSpectrum albedo(const Vec3f& wo) const override {
    return brdf_->albedo(wo.z < 0.0f ? -wo : wo, places_);
  }

 private:
  /// Share of directions sampled from the tables.
  static float share_of_tables(TransportMode mode);
  BsdfEval eval_above(const Vec3f& wo, const Vec3f& wi, TransportMode mode) const;

  const MeasuredBrdf* brdf_;
  WavelengthPlaces places_;
};

}  // namespace nephroid
