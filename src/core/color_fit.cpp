// Levenberg-Marquardt in CIELAB with the analytic Jacobian, warm-started along the brightness axis.
// Sums run over eight fixed lanes in double, so that every instruction set finds the same table.
// Paper: Jakob & Hanika 2019, section 4.
#include "core/color_fit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>

namespace nephroid {
namespace {

using Vec3 = std::array<double, 3>;
constexpr int kLanes = 8;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
// A reflectance is smooth enough to be summed at 128 wavelengths instead of 471. That is four times
// faster, and the error is below single precision except at the sharpest edges.
constexpr int kBlocks = 16;
constexpr int kQuadrature = kBlocks * kLanes;

constexpr double kFirst = 360.0, kRange = 470.0;  // nm
// The square of an error of 3e-4 CIELAB units, a few thousandths of a visible difference.
constexpr double kGoodEnough = 1e-7;
constexpr int kMaxIterations = 30;
// Colours at the limit of possible reflectances (black, white, pure hues) have their best fit at
// infinity. The bound keeps them finite, so that single precision still places the edges. It costs
// less than 1e-3 in any component of an sRGB colour.
constexpr double kMaxCoefficient = 1000.0;

Vec3 multiply(const Matrix3d& m, const Vec3& v) {
  Vec3 r{};
  for (int i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return r;
}

Lanes sqrt_lanes(Lanes v) {
  double a[kLanes];
  std::memcpy(a, &v, sizeof a);
  for (double& x : a) x = std::sqrt(x);
  std::memcpy(&v, a, sizeof a);
  return v;
}

double total(Lanes v) {
  double s = 0;
  for (int i = 0; i < kLanes; ++i) s += v[i];
  return s;
}

/// CIELAB's compressive curve and its derivative.
struct Compressed {
  double value, slope;
};
Compressed compress(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  if (t > kDelta * kDelta * kDelta) {
    const double root = std::cbrt(t);
    return {root, 1.0 / (3.0 * root * root)};
  }
  return {t / (3.0 * kDelta * kDelta) + 4.0 / 29.0, 1.0 / (3.0 * kDelta * kDelta)};
}

/// The colour of a polynomial and how it changes with the coefficients.
struct Colour {
  Vec3 lab{};
  Matrix3d jacobian{};  // rows L, a, b; columns coefficients
};

class Fitter {
 public:
  Fitter(const FitCurves& curves, const RgbPrimaries& primaries)
      : white_(white_point(curves)), xyz_from_rgb_(xyz_from_rgb(primaries, white_)) {
    double norm = 0;
    for (int i = 0; i < kTableNodes; ++i) norm += double(curves.illuminant[i]) * curves.y[i];
    const std::span<const float> curve[3] = {curves.x, curves.y, curves.z};
    for (int q = 0; q < kQuadrature; ++q)
      position_[q / kLanes][q % kLanes] = q / double(kQuadrature - 1);
    // The reflectance at each nanometre is a cubic through four neighbouring positions, so the
    // weight of a nanometre is dealt out to those four.
    for (int i = 0; i < kTableNodes; ++i) {
      const double at = i / kRange * (kQuadrature - 1);
      const int first = std::clamp(static_cast<int>(at) - 1, 0, kQuadrature - 4);
      for (int a = 0; a < 4; ++a) {
        double basis = 1;
        for (int b = 0; b < 4; ++b)
          if (b != a) basis *= (at - (first + b)) / (a - b);
        const int q = first + a;
        for (int k = 0; k < 3; ++k)
          weight_[q / kLanes][k][q % kLanes] +=
              basis * double(curves.illuminant[i]) * curve[k][i] / norm;
      }
    }
  }

  /// Moves `c`, coefficients over wavelengths scaled to [0,1], towards the colour `rgb`; starts
  /// from `fallback` if that is closer.
  void fit(const Vec3& rgb, const Vec3& fallback, Vec3& c) const {
    const Vec3 xyz = multiply(xyz_from_rgb_, rgb);
    Colour target;
    to_lab(xyz, nullptr, target);
    limit(c);
    Colour now = evaluate(c);
    double error = distance_squared(target.lab, now.lab);
    if (error > kGoodEnough) {
      const Colour other = evaluate(fallback);
      const double other_error = distance_squared(target.lab, other.lab);
      if (other_error < error) c = fallback, now = other, error = other_error;
    }
    double damping = 0;
    for (int i = 0; i < kMaxIterations && error > kGoodEnough; ++i) {
      Vec3 trial = c;
      const Vec3 step = damped_step(now, target.lab, damping);
      for (int n = 0; n < 3; ++n) trial[n] += step[n];
      limit(trial);
      const Colour then = evaluate(trial);
      const double trial_error = distance_squared(target.lab, then.lab);
      if (trial_error < error) {
        c = trial, now = then, error = trial_error;
        damping = damping < 1e-4 ? 0 : damping * 0.1;
      } else {
        damping = std::max(damping * 10.0, 1e-3);
      }
    }
  }

 private:
  static double distance_squared(const Vec3& a, const Vec3& b) {
    double s = 0;
    for (int i = 0; i < 3; ++i) s += (a[i] - b[i]) * (a[i] - b[i]);
    return s;
  }

  static void limit(Vec3& c) {
    const double most = std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])});
    if (most > kMaxCoefficient)
      for (double& x : c) x *= kMaxCoefficient / most;
    if (!(most <= 1e300)) c = {};
  }

  /// (J'J + damping diag(J'J))^-1 J'(target - now).
  static Vec3 damped_step(const Colour& now, const Vec3& target, double damping) {
    Matrix3d normal{};
    Vec3 gradient{};
    for (int r = 0; r < 3; ++r)
      for (int a = 0; a < 3; ++a) {
        gradient[a] += now.jacobian[r][a] * (target[r] - now.lab[r]);
        for (int b = 0; b < 3; ++b) normal[a][b] += now.jacobian[r][a] * now.jacobian[r][b];
      }
    for (int a = 0; a < 3; ++a) normal[a][a] *= 1.0 + damping;
    return multiply(inverse(normal), gradient);
  }

  /// Turns XYZ, and its derivatives if there are any, into CIELAB relative to the white point.
  void to_lab(const Vec3& xyz, const Matrix3d* derivative, Colour& out) const {
    Compressed f[3];
    for (int k = 0; k < 3; ++k) f[k] = compress(xyz[k] / white_[k]);
    out.lab = {116 * f[1].value - 16, 500 * (f[0].value - f[1].value),
               200 * (f[1].value - f[2].value)};
    if (!derivative) return;
    for (int n = 0; n < 3; ++n) {
      double d[3];
      for (int k = 0; k < 3; ++k) d[k] = f[k].slope / white_[k] * (*derivative)[k][n];
      out.jacobian[0][n] = 116 * d[1];
      out.jacobian[1][n] = 500 * (d[0] - d[1]);
      out.jacobian[2][n] = 200 * (d[1] - d[2]);
    }
  }

  /// One pass over the wavelengths sums the colour and its derivatives.
  Colour evaluate(const Vec3& c) const {
    Lanes sum[3] = {}, quadratic[3] = {}, linear[3] = {}, constant[3] = {};
    for (int b = 0; b < kBlocks; ++b) {
      const Lanes t = position_[b];
      const Lanes p = (c[0] * t + c[1]) * t + c[2];
      const Lanes inv = 1.0 / sqrt_lanes(1.0 + p * p);
      const Lanes value = 0.5 + 0.5 * p * inv;
      const Lanes slope = 0.5 * inv * inv * inv;
      for (int k = 0; k < 3; ++k) {
        sum[k] += weight_[b][k] * value;
        const Lanes d = weight_[b][k] * slope;
        constant[k] += d;
        linear[k] += d * t;
        quadratic[k] += d * t * t;
      }
    }
    Vec3 xyz;
    Matrix3d derivative;
    for (int k = 0; k < 3; ++k) {
      xyz[k] = total(sum[k]);
      derivative[k] = {total(quadratic[k]), total(linear[k]), total(constant[k])};
    }
    Colour out;
    to_lab(xyz, &derivative, out);
    return out;
  }

  Vec3 white_;
  Matrix3d xyz_from_rgb_;
  std::array<Lanes, kBlocks> position_{};
  std::array<std::array<Lanes, 3>, kBlocks> weight_{};
};

/// Coefficients over [0,1] as coefficients over nanometres.
std::array<float, 3> in_nanometres(const Vec3& c) {
  const double s = 1.0 / kRange, shift = kFirst * s;
  return {static_cast<float>(c[0] * s * s), static_cast<float>((c[1] - 2 * c[0] * shift) * s),
          static_cast<float>(c[2] - c[1] * shift + c[0] * shift * shift)};
}

/// Fits all colours with the same largest component and the same ratio j/(res-1). Each column
/// starts in the middle, where the problem is easy, and follows the solution up and down. The next
/// start is extrapolated from the last two solutions.
void fit_row(const Fitter& fitter, int max_component, int j, SigmoidTable& table) {
  const int res = table.resolution;
  const int start = res / 5;
  Vec3 middle{};
  for (int i = 0; i < res; ++i) {
    const auto solve = [&](int k, const Vec3& fallback, Vec3& c) {
      const double top = table.nodes[k];
      Vec3 rgb{};
      rgb[max_component] = top;
      rgb[(max_component + 1) % 3] = top * i / (res - 1);
      rgb[(max_component + 2) % 3] = top * j / (res - 1);
      fitter.fit(rgb, fallback, c);
      const auto out = in_nanometres(c);
      const size_t at = ((static_cast<size_t>(max_component) * res + k) * res + j) * res + i;
      std::copy(out.begin(), out.end(), table.coefficients.begin() + 3 * at);
    };
    solve(start, Vec3{}, middle);
    for (const int direction : {1, -1}) {
      Vec3 before = middle, last = middle;
      for (int k = start + direction; k >= 0 && k < res; k += direction) {
        Vec3 c;
        for (int n = 0; n < 3; ++n) c[n] = 2 * last[n] - before[n];
        solve(k, last, c);
        before = last;
        last = c;
      }
    }
  }
}

}  // namespace

std::array<double, 3> white_point(const FitCurves& curves) {
  std::array<double, 3> xyz{};
  for (int i = 0; i < kTableNodes; ++i) {
    xyz[0] += double(curves.illuminant[i]) * curves.x[i];
    xyz[1] += double(curves.illuminant[i]) * curves.y[i];
    xyz[2] += double(curves.illuminant[i]) * curves.z[i];
  }
  return {xyz[0] / xyz[1], 1.0, xyz[2] / xyz[1]};
}

Matrix3d xyz_from_rgb(const RgbPrimaries& primaries, const std::array<double, 3>& white) {
  const std::array<double, 2> xy[3] = {primaries.red, primaries.green, primaries.blue};
  Matrix3d m;
  for (int c = 0; c < 3; ++c) {
    m[0][c] = xy[c][0] / xy[c][1];
    m[1][c] = 1.0;
    m[2][c] = (1.0 - xy[c][0] - xy[c][1]) / xy[c][1];
  }
  const Vec3 scale = multiply(inverse(m), white);
  for (auto& row : m)
    for (int c = 0; c < 3; ++c) row[c] *= scale[c];
  return m;
}

Matrix3d inverse(const Matrix3d& m) {
  const auto minor = [&m](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix3d result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result[c][r] = minor(r, c) / determinant;
  return result;
}

std::vector<float> sigmoid_nodes(int resolution) {
  const auto smooth_step = [](double x) { return x * x * (3.0 - 2.0 * x); };
  std::vector<float> nodes;
  for (int k = 0; k < resolution; ++k)
    nodes.push_back(static_cast<float>(smooth_step(smooth_step(k / double(resolution - 1)))));
  return nodes;
}

SigmoidTable fit_sigmoid_table(const FitCurves& curves, const RgbPrimaries& primaries,
                               int resolution, int threads) {
  SigmoidTable table;
  table.resolution = resolution;
  table.nodes = sigmoid_nodes(resolution);
  table.coefficients.resize(size_t(9) * resolution * resolution * resolution);

  // Rows are independent, so it does not matter which thread takes which.
  const Fitter fitter(curves, primaries);
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int row = next++; row < 3 * resolution; row = next++)
      fit_row(fitter, row / resolution, row % resolution, table);
  };
  std::vector<std::jthread> helpers;
  for (int t = 1; t < threads; ++t) helpers.emplace_back(work);
  work();
  helpers.clear();
  return table;
}

}  // namespace nephroid
