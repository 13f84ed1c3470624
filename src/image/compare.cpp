// Sums are taken in double and in pixel order.
#include "image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/counted.h"
#include "core/errors.h"

namespace nephroid {
namespace {

constexpr double kRelativeFloor = 0.01;
constexpr double kDimBelow = 10;
constexpr double kTrimmedShare = 0.001;
constexpr double kTwoSided95 = 1.959963984540054;

using Triple = std::array<double, 3>;

double finite_or_huge(float value) {
  if (std::isnan(value)) return 1e6;
  if (std::isinf(value)) return value > 0 ? 1e6 : -1e6;
  return value;
}

/// The three channels prefix + R, G, B; empty if one is missing.
std::vector<Triple> channels_named(const Picture& picture, const std::string& prefix) {
  int index[3];
  for (int c = 0; c < 3; ++c) index[c] = picture.find_channel(prefix + "RGB"[c]);
  if (std::any_of(index, index + 3, [](int i) { return i < 0; })) return {};
  const size_t stride = picture.channels.size();
  std::vector<Triple> result(picture.pixels.size() / stride);
  for (size_t p = 0; p < result.size(); ++p)
    for (size_t c = 0; c < 3; ++c)
      result[p][c] = finite_or_huge(picture.pixels[p * stride + index[c]]);
  return result;
}

bool have_same_space(const PictureHead& a, const PictureHead& b) {
  const auto name = [](const PictureHead& picture) {
    return picture.color_space != nullptr ? picture.color_space->name() : "srgb";
  };
  return name(a) == name(b);
}

/// Channels R, G and B, or the first three if one of those is missing.
std::vector<Triple> colors_of(const Picture& picture) {
  std::vector<Triple> result = channels_named(picture, "");
  if (!result.empty() || picture.pixels.empty()) return result;
  const size_t stride = picture.channels.size();
  if (stride < 3)
    throw UsageError("a picture has " + counted(stride, "channel") + ", expected at least three");
  result.resize(picture.pixels.size() / stride);
  for (size_t p = 0; p < result.size(); ++p)
    for (size_t c = 0; c < 3; ++c) result[p][c] = finite_or_huge(picture.pixels[p * stride + c]);
  return result;
}

/// The colours of `test` in the colour space of `reference`.
std::vector<Triple> colors_as(const Picture& reference, const Picture& test) {
  std::vector<Triple> result = colors_of(test);
  if (have_same_space(reference, test)) return result;
  for (Triple& color : result) {
    const Rgb rgb{static_cast<float>(color[0]), static_cast<float>(color[1]),
                  static_cast<float>(color[2])};
    const Rgb same = converted(rgb, test.color_space, reference.color_space);
    color = {same.r, same.g, same.b};
  }
  return result;
}

void check_sizes(const Picture& reference, const Picture& test) {
  if (reference.width() == test.width() && reference.height() == test.height()) return;
  throw UsageError(fmt::format(
      "the reference is {}x{} pixels and the other picture {}x{}, expected the same size",
      reference.width(), reference.height(), test.width(), test.height()));
}

double square(double x) {
  return x * x;
}

double relative_weight(double reference) {
  return 1.0 / (square(reference) + kRelativeFloor);
}

/// Squared relative error of one pixel, mean over channels.
double pixel_error(const Triple& reference, const Triple& test) {
  double sum = 0;
  for (size_t c = 0; c < 3; ++c)
    sum += square(test[c] - reference[c]) * relative_weight(reference[c]);
  return sum / 3;
}

/// Expected contribution of the reference's own error to pixel_error.
double pixel_reference_error(const Triple& reference, const Triple& error) {
  double sum = 0;
  for (size_t c = 0; c < 3; ++c) sum += square(error[c]) * relative_weight(reference[c]);
  return sum / 3;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Mean of `values` without the pixels with the largest `errors`.
double trimmed_mean(const std::vector<double>& errors, const std::vector<double>& values) {
  const auto share = static_cast<size_t>(static_cast<double>(errors.size()) * kTrimmedShare);
  const size_t drop = std::min(std::max<size_t>(1, share), errors.size() - 1);
  std::vector<size_t> order(errors.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return errors[a] < errors[b]; });
  double sum = 0;
  for (size_t i = 0; i + drop < order.size(); ++i) sum += values[order[i]];
  return sum / static_cast<double>(order.size() - drop);
}

/// Mean of the test over mean of the reference, minus 1; NaN if the reference is black.
double relative_difference(double test, double reference) {
  return reference == 0 ? std::numeric_limits<double>::quiet_NaN() : test / reference - 1;
}

/// Variance of a pixel's sum over channels. Channels share their paths, so their errors are added
/// as fully correlated, which can only widen the interval.
double sum_variance(const std::vector<Triple>& errors, size_t pixel) {
  if (errors.empty()) return 0;
  return square(errors[pixel][0] + errors[pixel][1] + errors[pixel][2]);
}

MeanRatio dim_ratio(const std::vector<Triple>& reference, const std::vector<Triple>& test,
                    const std::vector<Triple>& reference_error,
                    const std::vector<Triple>& test_error) {
  MeanRatio result;
  double reference_sum = 0, test_sum = 0, reference_variance = 0, test_variance = 0;
  for (size_t p = 0; p < reference.size(); ++p) {
    const Triple& r = reference[p];
    if (std::max({r[0], r[1], r[2]}) >= kDimBelow) continue;
    ++result.pixels;
    reference_sum += r[0] + r[1] + r[2];
    test_sum += test[p][0] + test[p][1] + test[p][2];
    reference_variance += sum_variance(reference_error, p);
    test_variance += sum_variance(test_error, p);
  }
  result.value = relative_difference(test_sum, reference_sum);
  if (result.is_defined() && (!reference_error.empty() || !test_error.empty()))
    result.half_width = kTwoSided95 *
                        std::sqrt(test_variance + square(result.value + 1) * reference_variance) /
                        std::abs(reference_sum);
  return result;
}

Deviations deviations_of(const std::vector<Triple>& reference, const std::vector<Triple>& test,
                         const std::vector<Triple>& reference_error,
                         const std::vector<Triple>& test_error) {
  Deviations result;
  size_t within = 0, in_95 = 0;
  for (size_t p = 0; p < reference.size(); ++p) {
    double worst = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double variance = square(reference_error[p][c]) + square(test_error[p][c]);
      const double difference = square(test[p][c] - reference[p][c]);
      // Without an error in either picture, they must be equal up to rounding.
      const double floor = square(1e-5 * reference[p][c]) + 1e-30;
      const double z2 = difference / std::max(variance, floor);
      worst = std::max(worst, z2);
      result.rms += z2;
      in_95 += z2 <= square(kTwoSided95);
    }
    within += worst < square(kDeviationLimit);
  }
  const double pixels = static_cast<double>(reference.size());
  result.share_within = static_cast<double>(within) / pixels;
  result.share_in_95 = static_cast<double>(in_95) / (3 * pixels);
  result.rms = std::sqrt(result.rms / (3 * pixels));
  return result;
}

}  // namespace

std::vector<double> relative_squared_errors(const Picture& reference, const Picture& test) {
  check_sizes(reference, test);
  const std::vector<Triple> r = colors_of(reference), x = colors_as(reference, test);
  std::vector<double> errors(r.size());
  for (size_t p = 0; p < r.size(); ++p) errors[p] = pixel_error(r[p], x[p]);
  return errors;
}

Comparison compare_pictures(const Picture& reference, const Picture& test,
                            const CompareOptions& options) {
  check_sizes(reference, test);
  const std::vector<Triple> r = colors_of(reference), x = colors_as(reference, test);
  const std::vector<Triple> r_error = channels_named(reference, "stderr.");
  // Errors of mixed channels would need their correlations, which no file has.
  const std::vector<Triple> x_error =
      have_same_space(reference, test) ? channels_named(test, "stderr.") : std::vector<Triple>();
  if (options.subtract_reference_error && r_error.empty())
    throw UsageError(
        "--subtract-reference-error: the reference has no layer stderr, expected channels "
        "stderr.R, stderr.G and stderr.B");

  std::vector<double> relative(r.size()), kept(r.size());
  double squares = 0, reference_sum = 0, test_sum = 0;
  for (size_t p = 0; p < r.size(); ++p) {
    relative[p] = kept[p] = pixel_error(r[p], x[p]);
    if (options.subtract_reference_error) kept[p] -= pixel_reference_error(r[p], r_error[p]);
    for (size_t c = 0; c < 3; ++c) {
      squares += square(x[p][c] - r[p][c]);
      if (options.subtract_reference_error) squares -= square(r_error[p][c]);
      reference_sum += r[p][c];
      test_sum += x[p][c];
    }
  }
  Comparison result;
  result.is_same = r == x;
  const double mean_square = squares / (3.0 * static_cast<double>(r.size()));
  result.rmse = std::copysign(std::sqrt(std::abs(mean_square)), mean_square);
  result.relmse = mean_of(kept);
  result.relmse_trim = trimmed_mean(relative, kept);
  result.mean.value = relative_difference(test_sum, reference_sum);
  result.mean.pixels = r.size();
  result.dim_mean = dim_ratio(r, x, r_error, x_error);
  if (!r_error.empty() && !x_error.empty())
    result.deviations = deviations_of(r, x, r_error, x_error);
  return result;
}

}  // namespace nephroid
