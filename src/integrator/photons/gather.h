// The camera walks of a pass that gather photons: one or several per pixel, rows on any thread. It
// must not know radii.
#pragma once

#include <span>
#include <vector>

#include "core/parallel.h"
#include "integrator/photons/photon_pass.h"

namespace nephroid {

/// Light gathered by camera walks, summed over the batches of a pass.
struct Gathered {
  std::vector<Rgb> values;            ///< [walk * parts + part], with the camera's weight
  std::vector<float> filter_weights;  ///< [walk]
  std::vector<float> bias;       ///< [walk] bias of the values, mean of R, G and B; may be empty
  uint64_t rays = 0, found = 0;  ///< found: photons merged

  Gathered(size_t walks, size_t parts) : values(walks * parts), filter_weights(walks, 1.0f) {}
  /// Bytes per walk without bias.
  static constexpr size_t bytes_per_walk(size_t parts) {
    return parts * sizeof(Rgb) + sizeof(float);
  }
  /// One walk's colours. They are not clamped.
  std::span<Rgb> of_walk(size_t walk) {
    const size_t parts = values.size() / filter_weights.size();
    return {&values[walk * parts], parts};
  }
};

/// Turns each walk's colours into an estimate of its pixel: clamped to `max_component` like samples
/// of other integrators, then weighed by the filter.
inline void finish_estimates(Gathered& gathered, float max_component) {
  for (size_t walk = 0; walk < gathered.filter_weights.size(); ++walk) {
    const std::span<Rgb> estimate = gathered.of_walk(walk);
    PartSums::clamp_total(estimate, max_component);
    for (Rgb& color : estimate) color = color * gathered.filter_weights[walk];
    if (!gathered.bias.empty()) gathered.bias[walk] *= gathered.filter_weights[walk];
  }
}

/// Random numbers of the walks: walk k of a pixel takes points[k], scrambled for the pixel.
struct GatherNumbers {
  std::span<const SobolPoint> points;
  uint64_t seed = 0;
};

/// Runs the walks of all pixels and adds to `into`. Walk k of pixel p, counted row by row over the
/// crop, has the number p * points.size() + k. `merge(walk number, camera path, walk, merge point,
/// sums)` is called at each vertex where the group merges; it returns the number of photons found.
template <class Merge>
void gather(const Scene& scene, const PixelBounds& b, const OwnedRoutes& owned, int max_depth,
            const PhotonPass& pass, const GatherNumbers& numbers, Gathered& into, Merge&& merge) {
  struct RowCounts {
    uint64_t rays = 0, found = 0;
  };
  const auto gather_row = [&](RowCounts& counts, int64_t row, int64_t) {
    const int y = b.y0 + static_cast<int>(row);
    PartSums sums(*owned.routes, owned.group);
    size_t number = row * b.width() * numbers.points.size();
    for (int x = b.x0; x < b.x1; ++x)
      for (size_t k = 0; k < numbers.points.size(); ++k) {
        PathSampler sampler(numbers.points[k], hash_combine(numbers.seed, x, y));
        CameraPath path = start_merging_path(scene, x, y, sampler, pass, static_cast<int>(k));
        sums.clear();
        auto merge_here = [&](const Walk& walk, const MergePoint& at) {
          counts.found += merge(number, path, walk, at, sums);
        };
        MergeWalkVisitor visitor(owned, merge_here);
        if (path.camera_weight > 0)
          random_walk(scene, TransportMode::kRadiance, max_depth, path.walk, sampler, visitor);
        counts.rays += path.walk.rays;
        const std::span<Rgb> values = into.of_walk(number);
        for (size_t i = 0; i < values.size(); ++i)
          values[i] = values[i] + pass.weights.apply(sums.sums()[i]) * path.camera_weight;
        if (!into.bias.empty()) into.bias[number] += sums.bias(pass.weights) * path.camera_weight;
        into.filter_weights[number++] = path.filter_weight;
      }
  };
  ordered_reduce<RowCounts>(*pass.trace.control, b.height(), 1, gather_row,
                            [&](RowCounts&& of_row) {
                              into.rays += of_row.rays;
                              into.found += of_row.found;
                            });
}

}  // namespace nephroid
