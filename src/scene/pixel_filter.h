// Reconstruction filters, used by importance sampling: a sample belongs to one pixel, its position
// is drawn from the filter's absolute value, and its weight makes the mean unbiased (Ernst et al.
// 2006; pbrt-v4 section 8.8).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/math.h"
#include "input/format_rows.h"

namespace nephroid {

class PixelFilter {
 public:
  struct Sample {
    Vec2f offset;      ///< offset from the pixel's centre, in pixels
    float weight = 1;  ///< negative in negative lobes; its mean is 1
  };
  /// A separable filter f(x)f(y), each axis a function on [-radius, radius].
  PixelFilter(float (*function)(float x, float radius, const std::array<float, 2>& parameters),
              Vec2f radius, std::array<float, 2> parameters_x, std::array<float, 2> parameters_y);

  /// False if the parameters give a function without a positive, finite integral.
  bool can_be_sampled() const;
  Sample sample(const Vec2f& u) const;
  Vec2f radius() const { return {axes_[0].radius, axes_[1].radius}; }
  /// Value at an offset, normalised so that the integral over the plane is 1.
  float eval(const Vec2f& offset) const;

 private:
  struct Axis {
    float (*function)(float, float, const std::array<float, 2>&);
    std::array<float, 2> parameters;
    float radius;
    float integral;          ///< integral of the signed function
    std::vector<float> cdf;  ///< cdf of a piecewise constant bound of |f|, normalised
    float value(float x) const { return function(x, radius, parameters); }
    void sample(float u, float* x, float* weight) const;
  };
  Axis axes_[2];
};

/// All types of the format.
std::vector<FormatType> pixel_filter_types();

/// box, triangle, gaussian, mitchell or sinc with pbrt-v4's parameters and defaults; gaussian if
/// absent.
std::unique_ptr<PixelFilter> make_pixel_filter(
    const std::optional<DirectiveDescription>& description, Diagnostics& diagnostics);

}  // namespace nephroid
