// All arithmetic is in double until the end.
#include "core/white_balance.h"

#include "core/spectra.h"

namespace nephroid {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;
using Vector = std::array<double, 3>;

constexpr Matrix kConesFromXyz{
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

Vector times(const Matrix& m, const Vector& v) {
  Vector result{};
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 3; ++c) result[r] += m[r][c] * v[c];
  return result;
}

/// Adaptation of XYZ from one white to another: M^-1 diag(to/from) M, by solving for each column.
Vector adapt(const Vector& xyz, const Vector& scale) {
  Vector cones = times(kConesFromXyz, xyz);
  for (size_t i = 0; i < 3; ++i) cones[i] *= scale[i];
  const Matrix& m = kConesFromXyz;
  const auto minor = [&](size_t r, size_t c) {
    const size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Vector result{};
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 3; ++c) result[r] += minor(c, r) / determinant * cones[c];
  return result;
}

/// Cone responses of a white of luminance 1.
Vector cones_of_white(const Xyz& white) {
  const double y = white.y;
  return times(kConesFromXyz, {white.x / y, 1.0, white.z / y});
}

}  // namespace

ColorMatrix white_balance(const RgbColorSpace& space, float kelvin) {
  const Vector from = cones_of_white(spectrum_to_xyz(*daylight_spectrum(kelvin)));
  const Vector to = cones_of_white(space.to_xyz({1, 1, 1}));
  const Vector scale{to[0] / from[0], to[1] / from[1], to[2] / from[2]};
  ColorMatrix matrix;
  for (size_t c = 0; c < 3; ++c) {
    const Xyz unit =
        space.to_xyz({c == 0 ? 1.0f : 0.0f, c == 1 ? 1.0f : 0.0f, c == 2 ? 1.0f : 0.0f});
    const Vector adapted = adapt({unit.x, unit.y, unit.z}, scale);
    const Rgb column =
        space.from_xyz({static_cast<float>(adapted[0]), static_cast<float>(adapted[1]),
                        static_cast<float>(adapted[2])});
    matrix[0][c] = column.r;
    matrix[1][c] = column.g;
    matrix[2][c] = column.b;
  }
  return matrix;
}

}  // namespace nephroid
