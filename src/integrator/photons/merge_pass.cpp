#include "integrator/photons/merge_pass.h"

#include "integrator/photons/gather.h"

namespace nephroid {

namespace {

constexpr uint64_t kMergeStream = 0x6d65726765;  // "merge"

}  // namespace

size_t MergePass::bytes_per_pixel(size_t parts) {
  return Gathered::bytes_per_walk(parts) + sizeof(float);
}

MergePass merge_pass(const PassKey& key, const Scene& scene, const Film& film,
                     const OwnedRoutes& owned, const IntegratorOptions& options,
                     const PhotonGuide& guide, float radius_pixels, const MergeWeight& weight,
                     EstimatorStatistics& statistics, PassControl& control) {
  const PixelBounds& b = film.bounds();
  PhotonPass pass = start_photon_pass(key, scene, film.format(), options, control);
  pass.trace.guide = &guide;
  const int64_t photons = pass.trace.photons_per_pass;
  const size_t parts = film.parts_of(static_cast<int>(owned.group)).size();
  const size_t pixels = b.area();
  Gathered gathered(pixels, parts);
  gathered.bias.resize(pixels);

  // A pixel's estimate is summed over the batches; its walk and filter weight are the same in all.
  for (int64_t begin = 0; begin < photons;) {
    PhotonTrace trace = trace_batch(scene, owned, pass.trace, options.memory_photons, begin);
    count_photons(trace, statistics);
    if (trace.photons.empty()) continue;
    const PhotonGrid grid(std::move(trace.photons));
    statistics.hold(grid.bytes(), pixels * MergePass::bytes_per_pixel(parts));
    gather(scene, b, owned, options.max_depth, pass,
           {{&pass.point, 1}, hash_combine(key.seed, kMergeStream)}, gathered,
           [&](size_t, const CameraPath& path, const Walk& walk, MergePoint at,
               PartSums& sums) -> uint64_t {
             const float r = radius_pixels * pass.footprint.width(walk.length);
             if (!(r > 0.0f)) return 0;
             const float share = weight ? weight(path, at, r) : 1.0f;
             if (!(share > 0.0f)) return 0;
             at.throughput = at.throughput * (share / (static_cast<float>(photons) * kPi * r * r));
             return merge_photons(grid, owned, at, options.max_depth, r, sums);
           });
  }
  finish_estimates(gathered, film.settings().max_component);
  statistics.rays += gathered.rays;
  statistics.camera_paths += b.area();
  statistics.radius_min_pixels = radius_pixels;
  statistics.radius_max_pixels = radius_pixels;
  return {std::move(gathered.values), std::move(gathered.bias), gathered.found};
}

}  // namespace nephroid
