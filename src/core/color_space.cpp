// The four rgb colour spaces: matrices from primaries and white point, and the coefficient tables.
// The table of sRGB is linked in, the others are fitted at first use. Paper: Jakob & Hanika 2019;
// table layout in color_fit.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/color.h"
#include "core/color_fit.h"
#include "core/parallel.h"
#include "core/spectra_data.h"
#include "core/spectra_dense.h"

namespace nephroid {
namespace {

struct Definition {
  std::string_view name;
  RgbPrimaries primaries;
  std::string_view illuminant;  // name of the embedded table
};

constexpr Definition kDefinitions[] = {
    {"srgb", kSrgbPrimaries, "illuminant-D65"},
    {"dci-p3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}}, "illuminant-D65"},
    {"rec2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}}, "illuminant-D65"},
    {"aces2065-1", {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}}, "illuminant-acesD60"},
};

/// Large enough for a sigmoid of exactly 0 or 1, and a power of two, so that its square and the
/// root of that are exact.
constexpr float kEndlessCoefficient = 0x1p30f;

std::array<std::array<float, 3>, 3> to_float(const Matrix3d& m) {
  std::array<std::array<float, 3>, 3> result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result[r][c] = static_cast<float>(m[r][c]);
  return result;
}

/// Clamps to [0,1]. NaN, and values too dark to be inverted, become 0.
float unit(float x) {
  constexpr float kDarkest = 1e-20f;
  return x > kDarkest ? std::min(x, 1.0f) : 0.0f;
}

struct TableView {
  std::span<const float> nodes, coefficients;
};

/// Trilinear interpolation of the coefficients for a colour whose components are not all equal.
SigmoidPolynomial interpolate(const TableView& table, const Rgb& rgb) {
  const int res = static_cast<int>(table.nodes.size());
  const int largest = rgb.r > rgb.g ? (rgb.r > rgb.b ? 0 : 2) : (rgb.g > rgb.b ? 1 : 2);
  const float z = rgb[largest];
  const float to_index = static_cast<float>(res - 1) / z;
  const float x = rgb[(largest + 1) % 3] * to_index;
  const float y = rgb[(largest + 2) % 3] * to_index;
  const int xi = std::min(static_cast<int>(x), res - 2);
  const int yi = std::min(static_cast<int>(y), res - 2);
  // The last node below z.
  const auto above = std::lower_bound(table.nodes.begin(), table.nodes.end(), z);
  const int zi = std::clamp(static_cast<int>(above - table.nodes.begin()) - 1, 0, res - 2);
  const float dx = x - static_cast<float>(xi), dy = y - static_cast<float>(yi);
  const float dz = (z - table.nodes[zi]) / (table.nodes[zi + 1] - table.nodes[zi]);

  const size_t row = static_cast<size_t>(res) * 3, slab = row * res;
  const float* corner = table.coefficients.data() +
                        (static_cast<size_t>(largest) * res + zi) * slab + yi * row + xi * 3;
  float c[3];
  for (int n = 0; n < 3; ++n) {
    const float* at = corner + n;
    const float low = lerp(dy, lerp(dx, at[0], at[3]), lerp(dx, at[row], at[row + 3]));
    at += slab;
    const float high = lerp(dy, lerp(dx, at[0], at[3]), lerp(dx, at[row], at[row + 3]));
    c[n] = lerp(dz, low, high);
  }
  return {c[0], c[1], c[2]};
}

}  // namespace

struct RgbColorSpace::Impl {
  explicit Impl(const Definition& d)
      : definition(d), illuminant(data_table(d.illuminant).column(0)) {
    const DataTable cie = data_table("cie");
    curves = {cie.column(0), cie.column(1), cie.column(2), illuminant.values()};
    xyz_from_rgb = nephroid::xyz_from_rgb(d.primaries, white_point(curves));
    rgb_from_xyz = inverse(xyz_from_rgb);
    for (int i = 0; i < kTableNodes; ++i) {
      const double xyz[3] = {curves.x[i], curves.y[i], curves.z[i]};
      float rgb[3];
      for (int r = 0; r < 3; ++r) {
        double sum = 0;
        for (int c = 0; c < 3; ++c) sum += rgb_from_xyz[r][c] * xyz[c];
        rgb[r] = static_cast<float>(sum);
      }
      sensor_curves.push_back({rgb[0], rgb[1], rgb[2]});
    }
  }

  const TableView& table() {
    std::call_once(table_made, [this] {
      if (definition.name == "srgb") {
        view = {data_table("srgb-nodes").column(0), data_table("srgb").column(0)};
      } else {
        fitted = fit_sigmoid_table(curves, definition.primaries, kTableResolution, thread_count());
        view = {fitted.nodes, fitted.coefficients};
      }
    });
    return view;
  }

  const Definition& definition;
  DenseSpectrum illuminant;
  FitCurves curves;
  Matrix3d xyz_from_rgb, rgb_from_xyz;
  std::vector<Rgb> sensor_curves;

 private:
  std::once_flag table_made;
  SigmoidTable fitted;
  TableView view;
};

RgbColorSpace::RgbColorSpace(std::unique_ptr<Impl> impl)
    : name_(impl->definition.name),
      from_xyz_(to_float(impl->rgb_from_xyz)),
      to_xyz_(to_float(impl->xyz_from_rgb)),
      impl_(std::move(impl)) {}

RgbColorSpace::~RgbColorSpace() = default;

const RgbColorSpace* RgbColorSpace::find(std::string_view name) {
  static const std::vector<std::unique_ptr<const RgbColorSpace>> spaces = [] {
    std::vector<std::unique_ptr<const RgbColorSpace>> all;
    for (const Definition& definition : kDefinitions)
      all.push_back(std::make_unique<const RgbColorSpace>(std::make_unique<Impl>(definition)));
    return all;
  }();
  for (const auto& space : spaces)
    if (space->name() == name) return space.get();
  return nullptr;
}

const RgbColorSpace& RgbColorSpace::srgb() {
  static const RgbColorSpace& space = *find("srgb");
  return space;
}

Rgb RgbColorSpace::from_xyz(Xyz c) const {
  const auto& m = from_xyz_;
  return {m[0][0] * c.x + m[0][1] * c.y + m[0][2] * c.z,
          m[1][0] * c.x + m[1][1] * c.y + m[1][2] * c.z,
          m[2][0] * c.x + m[2][1] * c.y + m[2][2] * c.z};
}

Xyz RgbColorSpace::to_xyz(Rgb c) const {
  const auto& m = to_xyz_;
  return {m[0][0] * c.r + m[0][1] * c.g + m[0][2] * c.b,
          m[1][0] * c.r + m[1][1] * c.g + m[1][2] * c.b,
          m[2][0] * c.r + m[2][1] * c.g + m[2][2] * c.b};
}

SigmoidPolynomial RgbColorSpace::polynomial(Rgb rgb) const {
  const Rgb c{unit(rgb.r), unit(rgb.g), unit(rgb.b)};
  if (c.r == c.g && c.g == c.b) {
    // The sigmoid can be inverted: the same reflectance at every wavelength.
    const float inverse_sigmoid = (c.r - 0.5f) / std::sqrt(c.r * (1.0f - c.r));
    return {0.0f, 0.0f, std::clamp(inverse_sigmoid, -kEndlessCoefficient, kEndlessCoefficient)};
  }
  return interpolate(impl_->table(), c);
}

const Spectrum& RgbColorSpace::illuminant() const {
  return impl_->illuminant;
}

std::span<const Rgb> RgbColorSpace::sensor_curves() const {
  return impl_->sensor_curves;
}

}  // namespace nephroid
