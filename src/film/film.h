// The picture while it is being made: exact sums per pixel, one buffer for each part of the light.
// A sum is 128-bit fixed point with steps of 2^-64, so that adding commutes: any order, any number
// of threads and any split into runs gives the same bits (docs/architecture.md, section 3). Who
// calls it: integrators add, session reads. It must not know scenes or estimators.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/math.h"
#include "core/zeroed_array.h"
#include "film/film_format.h"
#include "film/fixed_sum.h"
#include "film/outlier_rejection.h"
#include "film/pixel_slices.h"
#include "film/render_state.h"

namespace nephroid {

/// Estimates of a route that were left out because a value was infinite or NaN.
struct BadEstimates {
  static constexpr uint64_t kNoPixel = ~uint64_t{0};
  uint64_t count = 0;
  uint64_t first_pixel = kNoPixel;  ///< the first of their pixels, row by row over the crop
};

/// The surface that a sample saw first, in the coordinate system that the caller chose.
struct SurfaceSample {
  Vec3f p{0, 0, 0};
  Vec3f n{0, 0, 0}, ns{0, 0, 0};  ///< geometric and shading normal, unit, towards the viewer
  Vec2f uv{0, 0};
  float dzdx = 0, dzdy = 0;  ///< change of p.z from a pixel to its neighbour
};

class Film {
 public:
  Film(const FilmSettings& settings, FilmLayout layout);
  /// Memory that a film takes for each pixel of the crop, with or without geometric layers.
  static size_t bytes_per_pixel(const FilmLayout& layout, bool gbuffer);

  const FilmFormat& format() const { return format_; }
  const FilmSettings& settings() const { return format_.settings(); }
  const PixelBounds& bounds() const { return format_.bounds(); }
  const FilmLayout& layout() const { return format_.layout(); }
  /// Parts of a group's routes, in increasing order.
  const std::vector<int>& parts_of(int group) const { return format_.parts_of(group); }

  /// Adds one estimate of a pixel by a group: values[i] is what it found for parts_of(group)[i].
  /// The caller has clamped their sum to max_component before it applied the filter's weight. Each
  /// pixel has exactly one writer at a time. An estimate with a value that is not finite is counted
  /// (see bad_estimates) and left out, with all its parts.
  void add(int group, int x, int y, std::span<const Rgb> values);
  /// Replaces what the group has for this pixel, for estimators whose passes cannot be added (E1).
  /// `estimates` is then set to 1 by the caller.
  void replace(int group, int x, int y, std::span<const Rgb> values);
  /// Adds an estimate of the bias that the group's estimate of each pixel has in the mean (of R, G
  /// and B), row by row over the crop, once for each estimate; forgotten unless the layout has the
  /// group merge.
  void add_bias(int group, std::span<const float> of_pixels);
  void add_bias(int group, int x, int y, float bias);
  /// Says that `count` more estimates per pixel were added to a group, those of slices included.
  void add_estimates(int group, uint64_t count);
  void set_estimates(int group, uint64_t count);
  uint64_t estimates(int group) const;

  /// The order in which passes reach the pixels.
  const PixelSlices& slices() const { return slices_; }
  /// Says that `count` more estimates of each pixel of a slice were added to a group, in a pass
  /// that add_estimates() ends. Slices on any number of threads, each once in a pass; `count` is
  /// that of all slices.
  void finish_slice(int group, size_t slice, uint64_t count);
  bool has_slice(int group, size_t slice) const { return open_[group].done[slice] != 0; }
  /// The same for features.
  void finish_feature_slice(size_t slice, uint64_t count) {
    finish_slice(layout().group_count(), slice, count);
  }
  /// Notes that a group has all of a pass that others have not, until close_pass().
  void note_whole(int group) { open_[group].is_whole = 1; }
  bool is_whole(int group) const { return open_[group].is_whole != 0; }
  /// All groups have the pass.
  void close_pass();
  /// True if a group has some slices of a pass.
  bool is_open(int group) const { return open_[group].slices > 0; }
  /// True if there is a pass of which a group, or the features, has something and another has not.
  bool has_open_pass() const;
  /// True if some light is there.
  bool has_light() const;
  /// True if every group has estimates of all pixels of the first lattice.
  bool can_be_shown() const;
  /// How much a group has of that pass, 0..1.
  double fraction_of_pass(int group) const {
    return is_whole(group)
               ? 1
               : static_cast<double>(open_[group].slices) / static_cast<double>(slices_.count());
  }
  /// Estimates of a pixel by a group.
  uint64_t estimates(int group, int x, int y) const { return count_of(group, index(x, y)); }

  /// Counts an estimate that was left out before it came here, of parts_of(group)[part] and, if it
  /// is inside the crop, of a pixel; or sums that reached their limit. Any number of threads.
  void count_bad(int group, size_t part, const Vec2i& pixel);
  void count_saturated(uint64_t sums);

  /// From now on holds estimates that are too isolated in position and brightness ([O1] of
  /// docs/estimators.md): what is held is no part of routes, AOVs and value(), but of outliers().
  /// Called before the first estimate. What `replace` sets is never held.
  void reject_outliers(OutlierSettings settings);
  /// Null unless outliers are rejected.
  const OutlierRejection* rejection() const { return outliers_ ? &*outliers_ : nullptr; }
  /// Ends a pass of all groups: what has been confirmed by now is released into the picture.
  void finish_pass();

  /// First-hit features of a pixel (sums over samples): albedo, normal in world space, depth (0 or
  /// infinite where nothing was hit). Components that are not finite are left out.
  void add_features(int x, int y, const Rgb& albedo, const Vec3f& normal, float depth);
  void add_feature_estimates(uint64_t count);
  /// Adds to the geometric layers of a film that has them; for samples that hit something.
  void add_surface(int x, int y, const SurfaceSample& sample);

  /// Mean of a route, of an AOV, and of the sum of all routes, each from its parts' accumulators
  /// and rounded once. Where a group has not reached the pixel yet it is that of the nearest pixel
  /// of a wider lattice, in its first pass.
  Rgb route_value(int route, int x, int y) const;
  Rgb aov_value(int aov, int x, int y) const;
  Rgb value(int x, int y) const;
  /// What is held of all routes: value() + outliers() is the picture without rejection, up to one
  /// rounding; the sums behind them add up to it exactly. Black without rejection.
  Rgb outliers(int x, int y) const;
  /// Standard error of value() + outliers(), from the spread of the estimates of each group, taken
  /// as independent (an upper bound in practice where passes are stratified). Zero with fewer than
  /// two estimates.
  Rgb standard_error(int x, int y) const;
  /// The same for the estimates of one group.
  Rgb standard_error(int group, int x, int y) const;
  /// True if some group's estimates come with their bias.
  bool has_bias() const { return !biases_.empty(); }
  /// How far value() lies above the truth, estimated, mean of R, G and B; and the standard error of
  /// that. Zero without bias, the error also with fewer than two estimates.
  float bias(int x, int y) const;
  float bias_error(int x, int y) const;
  /// Mean over the feature samples; what hit nothing counts as black.
  Rgb albedo(int x, int y) const;
  /// Direction of the mean, unit length; null where nothing was hit.
  Vec3f normal(int x, int y) const;
  /// Mean over the samples that hit something, 0 if none did.
  float depth(int x, int y) const;

  /// Mean over the samples that hit something: normals as directions of the mean, dzdx and dzdy as
  /// magnitudes of theirs. All zero if none did.
  SurfaceSample surface(int x, int y) const;

  /// All that it has summed up, as it lies in memory: to be written down, or to be read back into a
  /// film of the same settings and layout, which then goes on as if nothing had happened.
  RenderState state();
  /// Adds what another film of the same settings and layout has of other passes, whose estimates
  /// can be added; neither rejects outliers.
  void add(const Film& other);

  /// Estimates that were not finite; the route is that of the first part that was not.
  const BadEstimates& bad_estimates(int route) const { return bad_[route]; }
  /// Sums that reached their limit, and features and biases that were not finite.
  uint64_t saturated_values() const { return saturated_; }

 private:
  struct Bias {
    FixedSum sum, square;
  };
  struct Features {
    UnitSum albedo[3], normal[3];
    FixedSum depth;
  };
  /// Sums of p, n, ns, uv, dzdx and dzdy.
  using SurfaceSums = std::array<FixedSum, 13>;
  size_t index(int x, int y) const {
    return static_cast<size_t>(y - bounds().y0) * bounds().width() + (x - bounds().x0);
  }
  /// Add an estimate of which no value is infinite or NaN to the parts of its group, and its square
  /// to the group. False if a sum reached its limit.
  bool add_parts(int group, size_t pixel, std::span<const Rgb> values);
  bool add_square(int group, size_t pixel, std::span<const Rgb> values);
  void add_bias_of(int group, size_t pixel, float bias);
  /// Adds what was held to the parts of a group.
  void release(int group, size_t pixel, std::span<const RgbSum> parts);
  /// Counts an estimate with a value that is not finite. False if it has none.
  bool is_bad(int group, int x, int y, std::span<const Rgb> values);
  Rgb mean_of_parts(const std::vector<int>& parts, size_t pixel) const;
  /// Estimates of a pixel by a group; the features are one group more.
  uint64_t count_of(size_t group, size_t pixel) const {
    return estimates_[group] + (open_[group].slices > 0 ? count_of_slice(group, pixel) : 0);
  }
  uint64_t count_of_slice(size_t group, size_t pixel) const;
  /// The pixel itself or the nearest one of a wider lattice that the group has reached.
  size_t nearest_reached(size_t group, size_t pixel) const {
    return estimates_[group] > 0 || open_[group].slices == 0 ? pixel
                                                             : nearest_of_lattices(group, pixel);
  }
  size_t nearest_of_lattices(size_t group, size_t pixel) const;
  /// Squared standard errors of a group's estimates.
  std::array<double, 3> error_squared(size_t group, size_t pixel) const;

  FilmFormat format_;
  // Lists of parts, each ordered by group.
  std::vector<std::vector<int>> parts_of_route_, parts_of_aov_;
  std::vector<int> all_parts_;
  std::vector<ZeroedArray<RgbSum>> sums_;     ///< [part][pixel]
  std::vector<ZeroedArray<RgbSum>> squares_;  ///< [group][pixel], of an estimate's sum over parts
  std::vector<uint64_t> estimates_;           ///< [group], and of features
  /// Progress of one group in an unfinished pass.
  struct OpenPass {
    std::vector<uint32_t> done;  ///< [slice] 0 or 1
    uint64_t is_whole = 0;       ///< 1: all slices are done and counted in estimates_
    uint64_t slices = 0;         ///< number of slices done
    uint64_t estimates = 0;      ///< estimates per pixel in those slices
  };
  PixelSlices slices_;
  std::vector<OpenPass> open_;             ///< [group], and of features
  std::vector<ZeroedArray<Bias>> biases_;  ///< [group][pixel], of groups that merge; or empty
  std::optional<OutlierRejection> outliers_;
  ZeroedArray<Features> features_;
  ZeroedArray<uint64_t> depths_;           ///< [pixel], feature samples that hit something
  ZeroedArray<SurfaceSums> surfaces_;      ///< empty without geometric layers
  ZeroedArray<uint64_t> surface_samples_;  ///< [pixel], of these
  std::vector<BadEstimates> bad_;          ///< [route]
  uint64_t saturated_ = 0;
};

}  // namespace nephroid
