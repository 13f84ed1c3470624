// The accumulating film: exact sums per pixel, one buffer for each route and each AOV of a group.
// Sums are fixed point, so any order, number of threads and split into runs gives the same bits
// (docs/architecture.md, section 3). It must not know scenes or estimators.
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
#include "film/pixel_sums.h"
#include "film/render_state.h"

namespace nephroid {

/// Invalid estimates of a route: left out because a value was infinite or NaN.
struct BadEstimates {
  static constexpr uint64_t kNoPixel = ~uint64_t{0};
  uint64_t count = 0;
  uint64_t first_pixel = kNoPixel;  ///< lowest index of their pixels, row by row over the crop
};

/// The first surface of a sample, in the caller's coordinate system.
struct SurfaceSample {
  Vec3f p{0, 0, 0};
  Vec3f n{0, 0, 0}, ns{0, 0, 0};  ///< geometric and shading normal, unit, towards the viewer
  Vec2f uv{0, 0};
  float dzdx = 0, dzdy = 0;  ///< differences of p.z to the neighbouring pixels
};

class Film {
 public:
  Film(const FilmSettings& settings, FilmLayout layout);
  /// Memory for each pixel of the crop, with or without geometric layers. Carries of routes and
  /// AOVs, which few pixels need, are not counted, those of squares are (pixel_sums.h).
  static size_t bytes_per_pixel(const FilmLayout& layout, bool gbuffer);

  const FilmFormat& format() const { return format_; }
  const FilmSettings& settings() const { return format_.settings(); }
  const PixelBounds& bounds() const { return format_.bounds(); }
  const FilmLayout& layout() const { return format_.layout(); }
  /// Parts of a group's routes, in increasing order.
  const std::vector<int>& parts_of(int group) const { return format_.parts_of(group); }

  /// Adds a group's estimate of a pixel: values[i] belongs to parts_of(group)[i]. The caller clamps
  /// their sum to max_component before it applies the filter weight. A pixel has one writer at a
  /// time. An estimate with a value that is not finite is left out with all its parts, and counted
  /// in bad_estimates().
  void add(int group, int x, int y, std::span<const Rgb> values);
  /// Replaces the group's estimate of a pixel, for estimators whose passes cannot be added ([E1]).
  /// The caller then sets the number of estimates to 1.
  void replace(int group, int x, int y, std::span<const Rgb> values);
  /// Adds an estimate [E4] of the bias of each pixel's estimate (mean of R, G and B), row by row
  /// over the crop. Called once for each estimate. Ignored for a group that does not merge.
  void add_bias(int group, std::span<const float> of_pixels);
  void add_bias(int group, int x, int y, float bias);
  /// Counts `count` more estimates per pixel of a group, those of slices included.
  void add_estimates(int group, uint64_t count);
  /// Sets the number of estimates of each pixel of a group.
  void set_estimates(int group, uint64_t count);
  uint64_t estimates(int group) const;

  /// The slices of a pass, in their order.
  const PixelSlices& slices() const { return slices_; }
  /// Counts `count` more estimates of each pixel of a slice, in a pass that add_estimates() ends.
  /// Called once per slice and pass, by any thread, with the same `count`.
  void finish_slice(int group, size_t slice, uint64_t count);
  bool has_slice(int group, size_t slice) const { return open_[group].done[slice] != 0; }
  /// The same for features.
  void finish_feature_slice(size_t slice, uint64_t count) {
    finish_slice(layout().group_count(), slice, count);
  }
  /// Marks a pass as complete for a group, though not yet for others, until close_pass().
  void note_whole(int group) { open_[group].is_whole = 1; }
  bool is_whole(int group) const { return open_[group].is_whole != 0; }
  /// Marks the pass as complete for all groups.
  void close_pass();
  /// True if a group has slices of an unfinished pass.
  bool is_open(int group) const { return open_[group].slices > 0; }
  /// True if a pass is unfinished: a group, or the features, has some or all of it, others do not.
  bool has_open_pass() const;
  /// True if any sum is not 0.
  bool has_light() const;
  /// True if every group has estimates of all pixels of the first lattice.
  bool can_be_shown() const;
  /// The group's progress in the unfinished pass, 0 to 1.
  double fraction_of_pass(int group) const {
    return is_whole(group)
               ? 1
               : static_cast<double>(open_[group].slices) / static_cast<double>(slices_.count());
  }
  /// A group's estimates of a pixel.
  uint64_t estimates(int group, int x, int y) const { return count_of(group, index(x, y)); }

  /// Count invalid estimates left out by the caller, and sums that reached their limit. `pixel` may
  /// be outside of the crop. Called by any thread.
  void count_bad(int group, size_t part, const Vec2i& pixel);
  void count_saturated(uint64_t sums);

  /// Turns on outlier rejection: estimates too isolated in position and brightness are held ([O1]
  /// in docs/estimators.md). Held light is not in routes, AOVs and value(), but in outliers().
  /// Called before the first estimate. Estimates of replace() are never held.
  void reject_outliers(OutlierSettings settings);
  /// Null unless outliers are rejected.
  const OutlierRejection* rejection() const { return outliers_ ? &*outliers_ : nullptr; }
  /// Ends a pass of all groups: releases confirmed estimates into the picture.
  void finish_pass();

  /// Adds a sample's first-hit features: albedo, normal in world space, depth (0 or infinite if
  /// nothing was hit). Components that are not finite are left out.
  void add_features(int x, int y, const Rgb& albedo, const Vec3f& normal, float depth);
  void add_feature_estimates(uint64_t count);
  /// Adds a sample that hit something to the geometric layers, if the film has them.
  void add_surface(int x, int y, const SurfaceSample& sample);

  /// Means of a route, of an AOV, and of all routes together. Estimates are rounded to steps of
  /// 2^-44 and summed exactly, and the mean is rounded once. If a group has not reached the pixel
  /// in its first pass, the nearest pixel of a wider lattice stands in.
  Rgb route_value(int route, int x, int y) const;
  Rgb aov_value(int aov, int x, int y) const;
  Rgb value(int x, int y) const;
  /// Estimates of a pixel by the group that has most of them.
  uint64_t samples(int x, int y) const;
  /// Held light of all routes. value() + outliers() is the picture without rejection, up to
  /// rounding. Black without rejection.
  Rgb outliers(int x, int y) const;
  /// [F3] Standard error of value() + outliers(), from the variance of each group's estimates,
  /// taken as independent. In practice an upper bound if passes are stratified. Zero with fewer
  /// than two estimates.
  Rgb standard_error(int x, int y) const;
  /// The same for the estimates of one group.
  Rgb standard_error(int group, int x, int y) const;
  /// True if a group's estimates have a bias estimate.
  bool has_bias() const { return !biases_.empty(); }
  /// [E4] Estimated bias of value(), mean of R, G and B, and its standard error. Both are zero
  /// without bias estimates; the error needs at least two.
  float bias(int x, int y) const;
  float bias_error(int x, int y) const;
  /// Mean over the feature samples; samples that hit nothing count as black.
  Rgb albedo(int x, int y) const;
  /// Direction of the mean, unit length; null where nothing was hit.
  Vec3f normal(int x, int y) const;
  /// Mean over the samples that hit something, 0 if none did.
  float depth(int x, int y) const;

  /// Mean over the samples that hit something: normals as directions of the mean, dzdx and dzdy as
  /// magnitudes of theirs. All zero if none did.
  SurfaceSample surface(int x, int y) const;

  /// All sums as they lie in memory, to be saved, or loaded into a film of the same settings and
  /// layout, which then continues the render.
  RenderState state();
  /// Adds another film of the same settings and layout with other passes. Neither film rejects
  /// outliers, and the estimates can be added.
  void add(const Film& other);

  /// Invalid estimates. The route is that of the first part that was not finite.
  const BadEstimates& bad_estimates(int route) const { return bad_[route]; }
  /// Number of sums that reached their limit, and of features and biases that were not finite.
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
  /// Number of a part's route.
  size_t route_of(int part) const { return static_cast<size_t>(layout().parts[part].route); }
  /// Fills the lists of buffers.
  void list_buffers();
  /// A buffer, by its index in sums_ or layers_, and its group.
  struct Term {
    int group = 0;
    size_t buffer = 0;
  };
  /// Add a finite estimate to the routes and AOVs of its group, and its square to the group. False
  /// if a sum reached its limit.
  bool add_parts(int group, size_t pixel, std::span<const Rgb> values);
  bool add_square(int group, size_t pixel, std::span<const Rgb> values);
  void add_bias_of(int group, size_t pixel, float bias);
  /// Adds held sums of a group's parts to its routes and AOVs.
  void release(int group, size_t pixel, std::span<const RgbSum> parts);
  /// True if a value is not finite; counts the estimate then.
  bool is_bad(int group, int x, int y, std::span<const Rgb> values);
  /// Mean of the terms' sums; sum_of(buffer, pixel) is one of them.
  template <class SumOf>
  Rgb mean_of(std::span<const Term> terms, size_t pixel, const SumOf& sum_of) const;
  Rgb mean_of_routes(std::span<const Term> terms, size_t pixel) const;
  /// A group's estimates of a pixel. The features are one more group.
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
  // Lists of buffers, ordered by group.
  std::vector<Term> routes_;                         ///< all routes
  std::vector<std::vector<Term>> layers_of_aov_;     ///< [AOV]
  std::vector<std::vector<size_t>> layers_of_part_;  ///< [part]: in layers_
  std::vector<std::vector<size_t>> routes_of_group_, layers_of_group_;
  std::vector<PixelSums> sums_;      ///< [route]
  std::vector<PixelSums> layers_;    ///< [layer of a group]
  std::vector<PixelSums> squares_;   ///< [group]: squares of estimates' totals
  std::vector<uint64_t> estimates_;  ///< [group], features last
  /// Progress of one group in an unfinished pass.
  struct OpenPass {
    std::vector<uint32_t> done;  ///< [slice] 0 or 1
    uint64_t is_whole = 0;       ///< 1: all slices are done and counted in estimates_
    uint64_t slices = 0;         ///< number of slices done
    uint64_t estimates = 0;      ///< estimates per pixel in those slices
  };
  PixelSlices slices_;
  std::vector<OpenPass> open_;             ///< [group], features last
  std::vector<ZeroedArray<Bias>> biases_;  ///< [group][pixel], empty for groups that do not merge
  std::optional<OutlierRejection> outliers_;
  ZeroedArray<Features> features_;
  ZeroedArray<uint64_t> depths_;           ///< [pixel]: feature samples that hit something
  ZeroedArray<SurfaceSums> surfaces_;      ///< empty without geometric layers
  ZeroedArray<uint64_t> surface_samples_;  ///< [pixel]: samples in surfaces_
  std::vector<BadEstimates> bad_;          ///< [route]
  uint64_t saturated_ = 0;
};

}  // namespace nephroid
