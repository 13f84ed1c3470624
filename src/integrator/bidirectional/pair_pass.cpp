#include "integrator/bidirectional/pair_pass.h"

#include <cmath>
#include <optional>
#include <vector>

#include "core/parallel.h"
#include "integrator/bidirectional/light_batches.h"
#include "integrator/bidirectional/path_pair.h"
#include "integrator/bidirectional/samples_to_clamp.h"
#include "integrator/estimator/features.h"
#include "integrator/estimator/technique_counter.h"
#include "integrator/learning/guided_walk.h"
#include "integrator/path/specular_chain_pass.h"
#include "integrator/photons/merge_pass.h"

namespace nephroid {

namespace {

constexpr uint64_t kEyeStream = 0x76636d65;   // "vcme"
constexpr uint64_t kPairStream = 0x76636d70;  // "vcmp"
constexpr int kRowsWithRecords = 64;

/// What a row of pixels left.
struct Row {
  std::vector<RadianceRecord> records;
  uint64_t rays = 0, camera_paths = 0;
  TechniqueCounter::Row techniques;
};

float total(std::span<const Rgb> colors) {
  float sum = 0;
  for (const Rgb& color : colors) sum += color.r + color.g + color.b;
  return sum;
}

class Rendering {
 public:
  /// For a film like `like`; what is found goes to `film`, unless it is null.
  Rendering(const PairPass& how, const PassKey& key, const Scene& scene, const Film& like,
            Film* film, const OwnedRoutes& owned, const IntegratorOptions& options)
      : how_(how),
        key_(key),
        seed_(hash_combine(key.seed,
                           static_cast<uint64_t>(owned.routes->groups()[owned.group].estimator))),
        learns_(owned.routes->groups()[owned.group].estimator == EstimatorKind::kPathAndPhotons),
        scene_(scene),
        like_(like),
        film_(film),
        owned_(owned),
        options_(options),
        techniques_(film ? TechniqueCounter(like, owned.group, key.pass) : TechniqueCounter(like)),
        pass_(start_photon_pass(key, scene, like, options)),
        view_(scene, like.bounds()),
        records_(how.records,
                 static_cast<size_t>(like.bounds().area()) *
                     static_cast<size_t>(how.samples ? how.samples->most() : 1),
                 how.records_of_path),
        tree_(scene, owned, options.max_depth),
        settings_{.scene = scene,
                  .owned = owned,
                  .guide = *how.guide,
                  .radiance = how.radiance,
                  .tree = how.leaves_glints || options.specular_trees ? &tree_ : nullptr} {
    merging_.caustics_only = how.caustics_only;
    merging_.photons = static_cast<double>(how.light_paths);
    merging_.radius_pixels = radius_of_pass(options, key.pass);
    merging_.footprint = pass_.footprint;
    merging_.eye = scene.camera->camera_to_world(pass_.trace.time).point(Vec3f(0, 0, 0));
    merging_.connects = how.connects;
    settings_.view = scene.camera->connects() && merging_.connects ? &view_ : nullptr;
    settings_.specular_alpha = pass_.trace.specular_alpha;
    settings_.max_depth = options.max_depth;
    settings_.light_paths = static_cast<double>(how.light_paths);
    if (!learns_) settings_.technique = options.technique;
    settings_.merging = &merging_;
    const size_t pixels = static_cast<size_t>(like.bounds().area());
    parts_ = like.parts_of(static_cast<int>(owned.group)).size();
    values_.resize(pixels * parts_);
    if (film) bias_.resize(pixels);
    const int most = how.samples ? how.samples->most() : 1;
    points_.resize(static_cast<size_t>(most));
    if (how.spread) found_.resize(pixels * points_.size());
    if (!film && how.connects && how.spreads_splats) splatted_.resize(pixels);
    for (int n = 1; n <= most; ++n)
      if (how.samples ? how.samples->has(n) : n == 1)
        for (int k = 0; k < n; ++k)
          points_[static_cast<size_t>(n - 1)].push_back(sample_points(n, k));
  }

  void render(EstimatorStatistics& statistics) {
    std::optional<SplatBuffer> buffer;
    if (film_ && merging_.connects)
      buffer.emplace(*film_, static_cast<int>(owned_.group), *scene_.filter);
    LightBatches batches({.light_paths = how_.light_paths,
                          .memory_photons = options_.memory_photons,
                          .seed = seed_,
                          .number_varies = learns_},
                         pass_, settings_);
    const auto expose = [&](std::span<const Splat> splats) {
      techniques_.add_splats(splats, 1.0 / static_cast<double>(how_.light_paths));
      if (buffer)
        buffer->add(splats);
      else if (!splatted_.empty())
        add_to_nearest(splats);
    };
    do {
      std::vector<Photon> photons = batches.next(expose, statistics);
      if (clamps() && clamped_.empty() && !batches.empty())
        clamped_.resize(values_.size() / parts_ * points_.size(), parts_);
      const PhotonGrid grid(std::move(photons));
      merging_.grid = &grid;
      trace_eye_paths(statistics);
      statistics.hold(
          grid.bytes() + records_.bytes() + (how_.radiance ? how_.radiance->bytes() : 0),
          values_.size() / parts_ *
              PairPass::bytes_per_pixel(parts_, how_.spread ? points_.size() : 0,
                                        clamped_.empty() ? 0 : points_.size()));
      if (how_.glints && !settings_.merges_only) look_for_glints(statistics);
      merging_.grid = nullptr;
      settings_.merges_only = true;
    } while (!batches.empty());
    if (!clamped_.empty()) clamp_samples();
    if (how_.spread) add_to_spread();
    if (buffer)
      buffer->finish(1.0 / static_cast<double>(how_.light_paths), values_);
    else if (film_)
      add_values();
    if (film_) film_->add_bias(static_cast<int>(owned_.group), bias_);
    techniques_.add_to(statistics.techniques);
    statistics.photon_paths += static_cast<uint64_t>(how_.light_paths);
    statistics.radius_min_pixels = merging_.radius_pixels;
    if (statistics.radius_max_pixels == 0) statistics.radius_max_pixels = merging_.radius_pixels;
  }

 private:
  /// The film of a trial is a box a pixel wide.
  void add_to_nearest(std::span<const Splat> splats) {
    const PixelBounds& b = like_.bounds();
    for (const Splat& splat : splats) {
      const int x = static_cast<int>(std::floor(splat.film.x)) - b.x0,
                y = static_cast<int>(std::floor(splat.film.y)) - b.y0;
      if (x < 0 || y < 0 || x >= b.width() || y >= b.height()) continue;
      splatted_[static_cast<size_t>(y) * static_cast<size_t>(b.width()) + static_cast<size_t>(x)] +=
          total({&splat.value, 1}) / 3.0f / static_cast<float>(how_.light_paths);
    }
  }

  /// Number of a pixel's first sample of `n` in this pass.
  uint32_t first_index(int n) const {
    const uint32_t passes = how_.head > 0 && key_.pass > 0 ? key_.pass - 1 : key_.pass;
    return (key_.pass > 0 ? how_.head : 0) + passes * static_cast<uint32_t>(n);
  }
  /// The numbers of a pixel's sample `k` of `n` in this pass.
  struct SamplePoints {
    SobolPoint eye, light;
  };
  SamplePoints sample_points(int n, int k) const {
    const uint32_t index = first_index(n) + static_cast<uint32_t>(k);
    return {eye_point(index, kEyePathDimensions),
            how_.connects ? light_point(index) : SobolPoint(index, 1)};
  }

  void trace_eye_paths(EstimatorStatistics& statistics) {
    const int height = like_.bounds().height();
    // The records of some rows at a time are held twice.
    const int at_once = how_.records ? kRowsWithRecords : height;
    for (int first = 0; first < height; first += at_once)
      trace_rows(first, std::min(at_once, height - first), statistics);
    if (film_ && how_.adds_features && !settings_.merges_only) film_->add_feature_estimates(1);
  }

  void trace_rows(int first, int count, EstimatorStatistics& statistics) {
    const PixelBounds& b = like_.bounds();
    std::vector<Row> rows(static_cast<size_t>(count));
    parallel_chunks(count, 1, [&](int64_t row, int64_t, int64_t) {
      LightSubpath path;
      PartSums light(*owned_.routes, owned_.group);
      rows[static_cast<size_t>(row)].techniques = techniques_.start_row(light);
      const int y = b.y0 + first + static_cast<int>(row);
      for (int x = b.x0; x < b.x1; ++x) {
        const int samples = how_.samples ? how_.samples->at(x - b.x0, y - b.y0) : 1;
        for (int k = 0; k < samples; ++k)
          trace_sample(x, y, samples, k, path, light, rows[static_cast<size_t>(row)]);
      }
    });
    for (Row& row : rows) {
      statistics.rays += row.rays;
      if (settings_.merges_only) statistics.again_rays += row.rays;
      statistics.camera_paths += row.camera_paths;
      records_.take(row.records, settings_.merges_only);
      techniques_.add(row.techniques);
    }
  }

  void trace_sample(int x, int y, int samples, int k, LightSubpath& path, PartSums& light,
                    Row& row) {
    const PixelBounds& b = like_.bounds();
    const size_t pixel = static_cast<size_t>(y - b.y0) * static_cast<size_t>(b.width()) +
                         static_cast<size_t>(x - b.x0);
    const SamplePoints& points = points_[static_cast<size_t>(samples - 1)][static_cast<size_t>(k)];
    const uint64_t before = row.rays;
    PathSampler sampler(points.eye, hash_combine(seed_, kEyeStream, x, y));
    CameraPath camera = start_merging_path(scene_, x, y, sampler, pass_);
    camera.walk.window = how_.window;
    if (merging_.connects && !settings_.merges_only) {
      // A light path of its own: those that are merged run through one sequence, of which a pixel
      // would see the same part in all passes.
      PathSampler own(points.light, hash_combine(seed_, kPairStream, x, y));
      row.rays += trace_light_path(settings_, pass_.trace.lambda, pass_.u_time, own, &path, nullptr,
                                   nullptr, kEyePathDimensions)
                      .rays;
    }
    light.clear();
    Features features;
    const bool sees = film_ && how_.adds_features && !settings_.merges_only && k == 0;
    row.rays += trace_eye_path(settings_, path, camera, sampler, light,
                               {.features = sees ? &features : nullptr,
                                .records = records_.of_path(pixel, k, row.records),
                                .leaves = leaves_at(x - b.x0, y - b.y0)});
    if (sees) features.add_to(*film_, x, y, scene_, camera, pass_.weights);
    const float share = 1.0f / static_cast<float>(samples);
    if (film_)
      bias_[pixel] +=
          light.bias(pass_.weights) * camera.camera_weight * camera.filter_weight * share;
    light.add_techniques_to(
        row.techniques, pass_.weights,
        static_cast<double>(camera.camera_weight) * camera.filter_weight * share);
    const size_t sample = pixel * points_.size() + static_cast<size_t>(k);
    // What has to wait for other batches is clamped at the end.
    const bool waits = !clamped_.empty();
    const std::span<const Rgb> colors = light.colors(
        pass_.weights, camera.camera_weight, waits ? kInfinity : like_.settings().max_component,
        camera.filter_weight * share);
    const std::span<Rgb> sums =
        waits ? clamped_.sums(sample) : std::span(values_).subspan(pixel * parts_, parts_);
    for (size_t i = 0; i < parts_; ++i) sums[i] = sums[i] + colors[i];
    const double seen = static_cast<double>(total(colors));
    if (how_.spread) {
      PairPass::Found& found = found_[sample];
      found.light += static_cast<float>(seen / (3.0 * share));
      if (!settings_.merges_only) found.rays = static_cast<float>(row.rays - before);
    }
    if (settings_.merges_only) return;
    ++row.camera_paths;
    if (waits) clamped_.weights[sample] = std::abs(camera.filter_weight) * share;
  }

  SpecularRoot::Leaves leaves_at(int x, int y) const {
    if (!how_.leaves_glints) return SpecularRoot::Leaves::kBranches;
    return how_.glints && how_.glints->at(x, y) == 0 ? SpecularRoot::Leaves::kNothing
                                                     : SpecularRoot::Leaves::kAll;
  }

  /// Light behind delta lobes alone.
  void look_for_glints(EstimatorStatistics& statistics) {
    const GlintPass pass{.scene = scene_,
                         .like = like_,
                         .owned = owned_,
                         .tree = tree_,
                         .walks = *how_.glints,
                         .seed = seed_,
                         .specular_alpha = settings_.specular_alpha,
                         .spread = how_.glint_spread,
                         .spread_of_choice = how_.choice_spread,
                         .techniques = &techniques_};
    statistics.rays += pass.render(values_, [this](int n) { return first_index(n); });
  }

  bool clamps() const { return like_.settings().max_component < kInfinity; }

  /// Where memory cut the photons into batches, a sample is what it found in all of them, in as
  /// many rays as it took for one; splats are light of all samples of their pixel.
  void add_to_spread() {
    const PixelBounds& b = like_.bounds();
    size_t pixel = 0;
    for (int y = 0; y < b.height(); ++y)
      for (int x = 0; x < b.width(); ++x, ++pixel) {
        const size_t samples = how_.samples ? static_cast<size_t>(how_.samples->at(x, y)) : 1;
        for (size_t k = 0; k < samples; ++k) {
          const PairPass::Found& found = found_[pixel * points_.size() + k];
          how_.spread->add(pixel,
                           static_cast<double>(found.light) +
                               (splatted_.empty() ? 0.0 : static_cast<double>(splatted_[pixel])),
                           static_cast<double>(found.rays));
        }
      }
  }

  /// Each sample is clamped before the filter's weight, and its light is what is left.
  void clamp_samples() {
    for (size_t sample = 0; sample < clamped_.weights.size(); ++sample) {
      const std::span<Rgb> sums = clamped_.sums(sample);
      const float before = total(sums);
      PartSums::clamp_total(sums, like_.settings().max_component * clamped_.weights[sample]);
      if (how_.spread && before != 0) found_[sample].light *= total(sums) / before;
      for (size_t i = 0; i < parts_; ++i) {
        Rgb& value = values_[sample / points_.size() * parts_ + i];
        value = value + sums[i];
      }
    }
  }

  /// Without splats the values are all there is.
  void add_values() {
    const PixelBounds& b = like_.bounds();
    const int group = static_cast<int>(owned_.group);
    size_t first = 0;
    for (int y = b.y0; y < b.y1; ++y)
      for (int x = b.x0; x < b.x1; ++x, first += parts_)
        film_->add(group, x, y, std::span(values_).subspan(first, parts_));
  }

  const PairPass& how_;
  const PassKey key_;
  const uint64_t seed_;  ///< of the kind: `vcm` and `bpm` of one plan are independent
  const bool learns_;    ///< path+photons: passes differ in their number of light paths
  const Scene& scene_;
  const Film& like_;
  Film* film_;
  const OwnedRoutes& owned_;
  const IntegratorOptions& options_;
  TechniqueCounter techniques_;
  const PhotonPass pass_;
  const CameraView view_;
  PairMerging merging_;
  PassRecords records_;
  const SpecularTree tree_;
  PairSettings settings_;
  std::vector<std::vector<SamplePoints>> points_;  ///< [samples of a pixel - 1][sample]
  size_t parts_ = 1;
  std::vector<Rgb> values_;             ///< [pixel * parts + part]
  std::vector<float> bias_;             ///< [pixel], [E4]
  std::vector<PairPass::Found> found_;  ///< [pixel * most samples + sample], for the spread
  std::vector<float> splatted_;         ///< [pixel] mean of the components; of trials that connect
  /// Empty unless the film clamps and photons come in batches; [pixel * most samples + sample].
  SamplesToClamp clamped_;
};

}  // namespace

void PairPass::render(const PassKey& key, const Scene& scene, Film& film, const OwnedRoutes& owned,
                      const IntegratorOptions& options, EstimatorStatistics& statistics) const {
  Rendering(*this, key, scene, film, &film, owned, options).render(statistics);
  film.add_estimates(static_cast<int>(owned.group), 1);
}

void PairPass::try_out(const PassKey& key, const Scene& scene, const Film& film,
                       const OwnedRoutes& owned, const IntegratorOptions& options,
                       EstimatorStatistics& statistics) const {
  Rendering(*this, key, scene, film, nullptr, owned, options).render(statistics);
}

}  // namespace nephroid
