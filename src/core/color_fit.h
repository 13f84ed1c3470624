// Fits the table of sigmoid polynomials from which colour spaces interpolate: at build time for
// sRGB, at first use for others. Depends on the standard library only; it must not know where the
// curves come from. Paper: Jakob & Hanika 2019, "A Low-Dimensional Function Space for Efficient
// Spectral Upsampling".
#pragma once

#include <array>
#include <span>
#include <vector>

namespace nephroid {

inline constexpr int kTableNodes = 471;  ///< 360, 361, ..., 830 nm
/// Resolution of every table, as in pbrt-v4; docs/adr/0002-rgb-spectra.md has the errors.
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

/// coefficients[3*(((max*res + k)*res + j)*res + i) + n] is coefficient n of a colour. Its largest
/// component, of index `max`, is nodes[k]. The next one (cyclically) is i/(res-1) of it, and the
/// one after that j/(res-1).
struct SigmoidTable {
  int resolution = 0;
  std::vector<float> nodes;
  std::vector<float> coefficients;
};

/// The nodes of a table of `resolution`, from 0 to 1, dense at both ends, where the polynomials
/// change fastest.
std::vector<float> sigmoid_nodes(int resolution);

/// Fits a table on `threads` threads; the result does not depend on their number.
SigmoidTable fit_sigmoid_table(const FitCurves& curves, const RgbPrimaries& primaries,
                               int resolution, int threads);

}  // namespace nephroid
