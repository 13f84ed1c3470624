#include "integrator/vertex_connection_merging.h"

#include <vector>

#include "core/parallel.h"
#include "integrator/merge_pass.h"
#include "integrator/path_pair.h"

namespace nephroid {

namespace {

constexpr uint64_t kEyeStream = 0x76636d65;    // "vcme"
constexpr uint64_t kLightStream = 0x76636d6c;  // "vcml"
constexpr uint64_t kPairStream = 0x76636d70;   // "vcmp"
constexpr int64_t kChunk = 1024;
constexpr int64_t kGroup = 32 * kChunk;

/// One light path for each pixel, within bounds: paths are shared or spare outside of them.
int64_t default_light_paths(int64_t pixels) {
  constexpr int64_t kMin = 1 << 12, kMax = 1 << 20;
  return std::clamp(pixels, kMin, kMax);
}

/// What a chunk of light paths or a row of pixels found.
struct Chunk {
  std::vector<Photon> photons;
  std::vector<Splat> splats;
  uint64_t rays = 0, useful = 0;
};

class VcmPass {
 public:
  VcmPass(const PassKey& key, const Scene& scene, Film& film, const OwnedRoutes& owned,
          const IntegratorOptions& options, int64_t light_paths)
      : key_(key),
        kind_(owned.routes->groups()[owned.group].estimator),
        seed_(hash_combine(key.seed, static_cast<uint64_t>(kind_))),
        scene_(scene),
        film_(film),
        owned_(owned),
        options_(options),
        light_paths_(light_paths),
        pass_(start_photon_pass(key, scene, film, options)),
        eye_point_(key.pass, kEyePathDimensions),
        light_point_(key.pass, kPairDimensions),
        view_(scene, film.bounds()),
        places_(*owned.routes, owned.group),
        settings_{scene, owned} {
    merging_.photons = static_cast<double>(light_paths);
    merging_.radius_pixels = radius_of_pass(options, key.pass);
    merging_.footprint = pass_.footprint;
    merging_.eye = scene.camera->camera_to_world(pass_.trace.time).point(Vec3f(0, 0, 0));
    merging_.connects = kind_ != EstimatorKind::kBpm;
    settings_.view = scene.camera->connects() && merging_.connects ? &view_ : nullptr;
    settings_.specular_alpha = pass_.trace.specular_alpha;
    settings_.max_depth = options.max_depth;
    settings_.light_paths = static_cast<double>(light_paths);
    settings_.technique = options.technique;
    settings_.merging = &merging_;
    const size_t pixels = static_cast<size_t>(film.bounds().area());
    parts_ = film.parts_of(static_cast<int>(owned.group)).size();
    values_.resize(pixels * parts_);
    filter_weights_.assign(pixels, 1.0f);
  }

  void render(EstimatorStatistics& statistics) {
    SplatBuffer buffer(film_, static_cast<int>(owned_.group), *scene_.filter);
    int64_t begin = 0;
    do {
      std::vector<Photon> photons = trace_batch_of_paths(begin, buffer, statistics);
      const PhotonGrid grid(std::move(photons));
      statistics.hold(grid.bytes(),
                      filter_weights_.size() * VertexConnectionMerging::bytes_per_pixel(parts_));
      merging_.grid = &grid;
      trace_eye_paths(statistics);
      merging_.grid = nullptr;
      settings_.merges_only = true;
    } while (begin < light_paths_);
    finish_values();
    buffer.finish(1.0 / static_cast<double>(light_paths_), values_);
    statistics.photon_paths += static_cast<uint64_t>(light_paths_);
    statistics.camera_paths += static_cast<uint64_t>(film_.bounds().area());
    statistics.radius_min_pixels = merging_.radius_pixels;
    if (statistics.radius_max_pixels == 0) statistics.radius_max_pixels = merging_.radius_pixels;
  }

 private:
  /// Light path number `j` of those that are merged and connected to the camera.
  uint64_t trace_path(int64_t j, std::vector<FilmConnection>& seen,
                      std::vector<Photon>& photons) const {
    const uint64_t number =
        uint64_t{key_.pass} * static_cast<uint64_t>(light_paths_) + static_cast<uint64_t>(j);
    const SobolPoint point(static_cast<uint32_t>(number), kLightPathDimensions);
    PathSampler sampler(point, hash_combine(seed_, kLightStream, number >> 32));
    return trace_light_path(settings_, pass_.trace.lambda, pass_.u_time, sampler, nullptr, &seen,
                            &photons);
  }

  /// Light paths from `begin` on until memory is full; moves `begin`.
  std::vector<Photon> trace_batch_of_paths(int64_t& begin, SplatBuffer& buffer,
                                           EstimatorStatistics& statistics) {
    std::vector<Photon> photons;
    while (begin < light_paths_ && static_cast<int64_t>(photons.size()) < options_.memory_photons) {
      const int64_t count = std::min(kGroup, light_paths_ - begin);
      std::vector<Chunk> chunks(static_cast<size_t>(chunk_count(count, kChunk)));
      parallel_chunks(count, kChunk, [&](int64_t c, int64_t b, int64_t e) {
        std::vector<FilmConnection> seen;
        Chunk& chunk = chunks[static_cast<size_t>(c)];
        for (int64_t j = begin + b; j < begin + e; ++j) {
          seen.clear();
          const size_t before = chunk.photons.size();
          chunk.rays += trace_path(j, seen, chunk.photons);
          chunk.useful += chunk.photons.size() > before;
          expose(seen, chunk);
        }
      });
      begin += count;
      std::vector<Splat> splats;
      for (const Chunk& chunk : chunks) {
        photons.insert(photons.end(), chunk.photons.begin(), chunk.photons.end());
        splats.insert(splats.end(), chunk.splats.begin(), chunk.splats.end());
        statistics.rays += chunk.rays;
        statistics.photon_paths_useful += chunk.useful;
      }
      buffer.add(splats);
      statistics.splats += splats.size();
    }
    statistics.photons_stored += photons.size();
    return photons;
  }

  void expose(const std::vector<FilmConnection>& seen, Chunk& chunk) const {
    for (const FilmConnection& c : seen)
      for (int i = 0; i < c.seen.count; ++i)
        chunk.splats.push_back({c.seen.film[static_cast<size_t>(i)],
                                static_cast<uint8_t>(places_.place(c.part)),
                                pass_.weights.apply(c.value)});
  }

  void trace_eye_paths(EstimatorStatistics& statistics) {
    const PixelBounds& b = film_.bounds();
    std::vector<Chunk> rows(static_cast<size_t>(b.height()));
    parallel_chunks(b.height(), 1, [&](int64_t row, int64_t, int64_t) {
      LightSubpath path;
      PartSums light(*owned_.routes, owned_.group);
      for (int x = b.x0; x < b.x1; ++x)
        trace_pixel(x, b.y0 + static_cast<int>(row), path, light, rows[static_cast<size_t>(row)]);
    });
    for (const Chunk& row : rows) statistics.rays += row.rays;
  }

  void trace_pixel(int x, int y, LightSubpath& path, PartSums& light, Chunk& row) {
    const PixelBounds& b = film_.bounds();
    const size_t pixel = static_cast<size_t>(y - b.y0) * static_cast<size_t>(b.width()) +
                         static_cast<size_t>(x - b.x0);
    PathSampler sampler(eye_point_, hash_combine(seed_, kEyeStream, x, y));
    CameraPath camera = start_merging_path(scene_, x, y, sampler, pass_);
    if (merging_.connects && !settings_.merges_only) {
      // A light path of its own: those that are merged run through one sequence, of which a pixel
      // would see the same part in all passes.
      PathSampler own(light_point_, hash_combine(seed_, kPairStream, x, y));
      row.rays += trace_light_path(settings_, pass_.trace.lambda, pass_.u_time, own, &path, nullptr,
                                   nullptr, kEyePathDimensions);
    }
    light.clear();
    row.rays += trace_eye_path(settings_, path, camera, sampler, light);
    for (size_t i = 0; i < parts_; ++i) {
      Rgb& sum = values_[pixel * parts_ + i];
      sum = sum + pass_.weights.apply(light.sums()[i]) * camera.camera_weight;
    }
    filter_weights_[pixel] = camera.filter_weight;
  }

  void finish_values() {
    for (size_t pixel = 0; pixel < filter_weights_.size(); ++pixel) {
      const std::span<Rgb> estimate(&values_[pixel * parts_], parts_);
      PartSums::clamp_total(estimate, film_.settings().max_component);
      for (Rgb& color : estimate) color = color * filter_weights_[pixel];
    }
  }

  const PassKey key_;
  const EstimatorKind kind_;
  const uint64_t seed_;  ///< of the kind: `vcm` and `bpm` of one plan are independent
  const Scene& scene_;
  Film& film_;
  const OwnedRoutes& owned_;
  const IntegratorOptions& options_;
  const int64_t light_paths_;
  const PhotonPass pass_;
  const SobolPoint eye_point_, light_point_;  ///< of pairs
  const CameraView view_;
  const PartSums places_;
  PairMerging merging_;
  PairSettings settings_;
  size_t parts_ = 1;
  std::vector<Rgb> values_;  ///< [pixel * parts + part]
  std::vector<float> filter_weights_;
};

}  // namespace

VertexConnectionMerging::VertexConnectionMerging(OwnedRoutes owned,
                                                 const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

void VertexConnectionMerging::render_pass(const PassKey& key, const Scene& scene, Film& film) {
  const int64_t paths = options_.photons_per_pass > 0 ? options_.photons_per_pass
                                                      : default_light_paths(film.bounds().area());
  VcmPass(key, scene, film, owned_, options_, paths).render(statistics_);
  film.add_estimates(static_cast<int>(owned_.group), 1);
}

}  // namespace nephroid
