// All filters of the paper are computed as sums of separable ones. Outside of a picture its border
// colour continues.
#include "image/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/counted.h"
#include "core/errors.h"
#include "core/math.h"
#include "core/parallel.h"

namespace nephroid {
namespace {

constexpr int64_t kFlipRowsPerChunk = 8;

using Triple = std::array<double, 3>;

/// One number per pixel.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;

  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * h) {}
  double& at(int x, int y) { return values[static_cast<size_t>(y) * width + x]; }
  double at(int x, int y) const { return values[static_cast<size_t>(y) * width + x]; }
};

/// The weights at -r..r.
using Kernel = std::vector<double>;

double sum_of(const Kernel& kernel) {
  return std::accumulate(kernel.begin(), kernel.end(), 0.0);
}

/// Weights f(-r), ..., f(r).
template <class F>
Kernel make_kernel(int radius, const F& f) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(f(i));
  return kernel;
}

template <class Body>
void for_each_pixel(int width, int height, const Body& body) {
  parallel_chunks(height, kFlipRowsPerChunk, [&](int64_t, int64_t begin, int64_t end) {
    for (int y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < width; ++x) body(x, y);
  });
}

Plane filtered(const Plane& in, const Kernel& horizontal, const Kernel& vertical) {
  const int rx = static_cast<int>(horizontal.size() / 2),
            ry = static_cast<int>(vertical.size() / 2);
  Plane rows(in.width, in.height), result(in.width, in.height);
  for_each_pixel(in.width, in.height, [&](int x, int y) {
    double sum = 0;
    for (int i = -rx; i <= rx; ++i)
      sum += horizontal[i + rx] * in.at(std::clamp(x + i, 0, in.width - 1), y);
    rows.at(x, y) = sum;
  });
  for_each_pixel(in.width, in.height, [&](int x, int y) {
    double sum = 0;
    for (int i = -ry; i <= ry; ++i)
      sum += vertical[i + ry] * rows.at(x, std::clamp(y + i, 0, in.height - 1));
    result.at(x, y) = sum;
  });
  return result;
}

// Linear sRGB and XYZ (IEC 61966-2-1); white is (1,1,1).
constexpr double kToXyz[3][3] = {{0.4124564, 0.3575761, 0.1804375},
                                 {0.2126729, 0.7151522, 0.0721750},
                                 {0.0193339, 0.1191920, 0.9503041}};
constexpr double kToRgb[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                 {-0.9692660, 1.8760108, 0.0415560},
                                 {0.0556434, -0.2040259, 1.0572252}};

Triple times(const double (&m)[3][3], const Triple& v) {
  Triple result{};
  for (size_t r = 0; r < 3; ++r) result[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return result;
}

const Triple kWhite = times(kToXyz, {1, 1, 1});

Triple relative_xyz(const Triple& rgb) {
  Triple xyz = times(kToXyz, rgb);
  for (size_t i = 0; i < 3; ++i) xyz[i] /= kWhite[i];
  return xyz;
}

/// [FL1] The opponent space in which the eye's filters work; linear in the colour.
Triple to_opponent(const Triple& rgb) {
  const Triple f = relative_xyz(rgb);
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

/// The colour of an opponent triple, clamped to what a screen can show.
Triple opponent_to_display(const Triple& o) {
  const double y = (o[0] + 16) / 116;
  const Triple xyz = {(y + o[1] / 500) * kWhite[0], y * kWhite[1], (y - o[2] / 200) * kWhite[2]};
  Triple rgb = times(kToRgb, xyz);
  for (double& c : rgb) c = std::clamp(c, 0.0, 1.0);
  return rgb;
}

/// [FL3] CIELAB, with a and b scaled by the lightness (the Hunt effect).
Triple to_hunt_lab(const Triple& rgb) {
  const Triple relative = relative_xyz(rgb);
  Triple f{};
  for (size_t i = 0; i < 3; ++i) {
    constexpr double kDelta = 6.0 / 29;
    f[i] = relative[i] > kDelta * kDelta * kDelta ? std::cbrt(relative[i])
                                                  : relative[i] / (3 * kDelta * kDelta) + 4.0 / 29;
  }
  const double lightness = 116 * f[1] - 16;
  const double hunt = 0.01 * lightness;
  return {lightness, hunt * 500 * (f[0] - f[1]), hunt * 200 * (f[1] - f[2])};
}

/// [FL3] City-block distance in lightness plus Euclidean distance in chroma.
double hyab(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// [FL2] A term of a contrast sensitivity function: amplitude and width in degrees.
struct Gaussian {
  double a, b;
};
struct Sensitivity {
  Gaussian terms[2];
};
constexpr Sensitivity kSensitivities[3] = {
    {{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}};
constexpr double kWidest = 0.04;

/// [FL2] An opponent channel filtered by the eye's contrast sensitivity at this distance.
Plane seen(const Plane& channel, const Sensitivity& sensitivity, double ppd) {
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPiDouble * kPiDouble)) * ppd));
  Plane result(channel.width, channel.height);
  double total = 0;
  for (const Gaussian& g : sensitivity.terms) {
    if (g.a == 0) continue;
    const Kernel kernel = make_kernel(radius, [&](double i) {
      const double x = i / ppd;
      return std::exp(-kPiDouble * kPiDouble * x * x / g.b);
    });
    const double amplitude = g.a * std::sqrt(kPiDouble / g.b);
    total += amplitude * sum_of(kernel) * sum_of(kernel);
    const Plane term = filtered(channel, kernel, kernel);
    for (size_t i = 0; i < result.values.size(); ++i)
      result.values[i] += amplitude * term.values[i];
  }
  for (double& value : result.values) value /= total;
  return result;
}

Triple triple_of(const Rgb& rgb) {
  return {rgb.r, rgb.g, rgb.b};
}

/// Colours after the eye's filters, in the space for differences.
std::vector<Triple> seen_colors(int width, int height, const std::vector<Rgb>& colors, double ppd) {
  std::vector<Plane> channels(3, Plane(width, height));
  for (size_t p = 0; p < colors.size(); ++p) {
    const Triple opponent = to_opponent(triple_of(colors[p]));
    for (size_t c = 0; c < 3; ++c) channels[c].values[p] = opponent[c];
  }
  for (size_t c = 0; c < 3; ++c) channels[c] = seen(channels[c], kSensitivities[c], ppd);
  std::vector<Triple> result(colors.size());
  for (size_t p = 0; p < colors.size(); ++p)
    result[p] = to_hunt_lab(
        opponent_to_display({channels[0].values[p], channels[1].values[p], channels[2].values[p]}));
  return result;
}

/// [FL4] The colour difference in [0,1]; most of the range is used for common differences.
double color_error(const Triple& a, const Triple& b) {
  constexpr double kExponent = 0.7, kKnee = 0.4, kKneeValue = 0.95;
  static const double largest =
      std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), kExponent);
  const double error = std::pow(hyab(a, b), kExponent), knee = kKnee * largest;
  if (error < knee) return error * kKneeValue / knee;
  return std::min(1.0, kKneeValue + (error - knee) / (largest - knee) * (1 - kKneeValue));
}

/// Scales the positive weights to sum 1 and the negative ones to sum -1.
void balance(Kernel& kernel) {
  double positive = 0, negative = 0;
  for (const double w : kernel) (w > 0 ? positive : negative) += w;
  for (double& w : kernel) w /= w > 0 ? positive : -negative;
}

/// [FL5] Magnitudes of the picture filtered by the first and second derivatives of a Gaussian.
struct Features {
  Plane edges, points;
};
Features features_of(int width, int height, const std::vector<Rgb>& colors, double ppd) {
  constexpr double kFeatureWidth = 0.082;  // degrees
  const double sigma = 0.5 * kFeatureWidth * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto bell = [&](double i) { return std::exp(-i * i / (2 * sigma * sigma)); };
  Kernel smooth = make_kernel(radius, bell);
  for (const double total = sum_of(smooth); double& w : smooth) w /= total;
  Kernel edge = make_kernel(radius, [&](double i) { return -i * bell(i); });
  Kernel point =
      make_kernel(radius, [&](double i) { return (i * i / (sigma * sigma) - 1) * bell(i); });
  balance(edge);
  balance(point);

  Plane grey(width, height);
  for (size_t p = 0; p < colors.size(); ++p) grey.values[p] = relative_xyz(triple_of(colors[p]))[1];
  const auto magnitude = [&](const Kernel& kernel) {
    Plane result = filtered(grey, kernel, smooth);
    const Plane y = filtered(grey, smooth, kernel);
    for (size_t i = 0; i < result.values.size(); ++i)
      result.values[i] = std::hypot(result.values[i], y.values[i]);
    return result;
  };
  return {magnitude(edge), magnitude(point)};
}

}  // namespace

std::vector<Rgb> display_colors(const Picture& picture, float exposure) {
  const size_t stride = picture.channels.size();
  if (stride < 3)
    throw UsageError("a picture has " + counted(stride, "channel") + ", expected at least three");
  size_t index[3] = {0, 1, 2};
  const int named[3] = {picture.find_channel("R"), picture.find_channel("G"),
                        picture.find_channel("B")};
  if (std::all_of(named, named + 3, [](int i) { return i >= 0; }))
    std::copy(named, named + 3, index);
  std::vector<Rgb> colors(picture.pixels.size() / stride);
  for (size_t p = 0; p < colors.size(); ++p) {
    const float* pixel = picture.pixels.data() + p * stride;
    const Rgb color = converted({pixel[index[0]], pixel[index[1]], pixel[index[2]]},
                                picture.color_space, nullptr);
    const auto shown = [&](float value) {
      return value * exposure > 0 ? std::min(value * exposure, 1.0f) : 0.0f;
    };
    colors[p] = {shown(color.r), shown(color.g), shown(color.b)};
  }
  return colors;
}

std::vector<double> flip_errors(int width, int height, const std::vector<Rgb>& reference,
                                const std::vector<Rgb>& test, double pixels_per_degree) {
  const std::vector<Triple> a = seen_colors(width, height, reference, pixels_per_degree);
  const std::vector<Triple> b = seen_colors(width, height, test, pixels_per_degree);
  const Features fa = features_of(width, height, reference, pixels_per_degree);
  const Features fb = features_of(width, height, test, pixels_per_degree);
  std::vector<double> errors(a.size());
  for (size_t p = 0; p < errors.size(); ++p) {
    // [FL5] and [FL6].
    const double edge = std::abs(fa.edges.values[p] - fb.edges.values[p]);
    const double point = std::abs(fa.points.values[p] - fb.points.values[p]);
    const double feature = std::min(1.0, std::sqrt(std::max(edge, point) / std::numbers::sqrt2));
    errors[p] = std::pow(color_error(a[p], b[p]), 1 - feature);
  }
  return errors;
}

double flip(const Picture& reference, const Picture& test, float exposure) {
  if (reference.width() != test.width() || reference.height() != test.height())
    throw UsageError(fmt::format(
        "the reference is {}x{} pixels and the other picture {}x{}, expected the same size",
        reference.width(), reference.height(), test.width(), test.height()));
  const std::vector<double> errors =
      flip_errors(reference.width(), reference.height(), display_colors(reference, exposure),
                  display_colors(test, exposure));
  return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

}  // namespace nephroid
