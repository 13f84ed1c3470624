// Fits the sigmoid polynomials that stand for rgb colours (Jakob & Hanika 2019, "A Low-Dimensional
// Function Space for Efficient Spectral Upsampling"): the table that colour spaces interpolate.
// Who calls it: the table generator at build time (sRGB) and color_space.cpp at first use (others).
// It must not know where the curves come from; it depends on nothing but the standard library.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace nephroid {

inline constexpr int kTableNodes = 471;  ///< 360, 361, ..., 830 nm
/// Resolution of every table, that of pbrt-v4; docs/adr/0002-rgb-spectra.md has the errors.
inline constexpr int kTableResolution = 64;

using Matrix3d = std::array<std::array<double, 3>, 3>;

/// Chromaticities (x, y) of the three primaries.
struct RgbPrimaries {
  std::array<double, 2> red, green, blue;
};
inline constexpr RgbPrimaries kSrgbPrimaries{{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}};

/// Matching curves and the light under which a reflectance is seen, kTableNodes values each.
struct FitCurves {
  std::span<const float> x, y, z, illuminant;
};

/// XYZ of the light itself, normalised to Y = 1.
std::array<double, 3> white_point(const FitCurves& curves);
/// The matrix whose columns are the XYZ of the primaries, scaled so that (1,1,1) gives `white`.
Matrix3d xyz_from_rgb(const RgbPrimaries& primaries, const std::array<double, 3>& white);
/// Inverse of a regular matrix.
Matrix3d inverse(const Matrix3d& m);

/// coefficients[3*(((max*res + k)*res + j)*res + i) + n] is coefficient n for the colour whose
/// largest component, number `max`, is nodes[k]; the next one (cyclically) is i/(res-1) and the one
/// after that j/(res-1) of it.
struct SigmoidTable {
  int resolution = 0;
  std::vector<float> nodes;
  std::vector<float> coefficients;
};

/// The largest components at which a table of `resolution` has entries, from 0 to 1, dense at both
/// ends where the polynomials change fastest.
std::vector<float> sigmoid_nodes(int resolution);

/// Fits a table on `threads` threads; the result does not depend on their number.
SigmoidTable fit_sigmoid_table(const FitCurves& curves, const RgbPrimaries& primaries,
                               int resolution, int threads);

}  // namespace nephroid
