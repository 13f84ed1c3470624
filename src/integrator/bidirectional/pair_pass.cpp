#include "integrator/bidirectional/pair_pass.h"

#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "integrator/bidirectional/light_batches.h"
#include "integrator/bidirectional/path_pair.h"
#include "integrator/bidirectional/samples_to_clamp.h"
#include "integrator/estimator/features.h"
#include "integrator/estimator/technique_counter.h"
#include "integrator/path/path_options.h"
#include "integrator/photons/merge_pass.h"

namespace nephroid {

namespace {

constexpr uint64_t kEyeStream = 0x76636d65;   // "vcme"
constexpr uint64_t kPairStream = 0x76636d70;  // "vcmp"
constexpr int kRowsWithRecords = 64;

/// Records and counts of one row of pixels.
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

/// Where what a pass finds goes: any of these may be asked for, and not all of them are.
struct Destinations {
  Film* film = nullptr;
  bool adds_features = false;
  SampleVariance* paths = nullptr;
  bool measures_splats = false;  ///< as light of the camera paths of their pixel
  ChainVariance* chains = nullptr;
  std::vector<RadianceRecord>* records = nullptr;
  double records_per_path = PassRecords::kMaxPerPath;
};

/// How camera paths are made.
struct CameraSide {
  const SampleMap& paths;
  const SampleMap* chains = nullptr;  ///< null: nobody looks for specular chains if they are apart
  uint32_t in_first_pass = 0;
  const RadianceGuide& directions = kNoRadiance;
};

class PairRendering {
 public:
  PairRendering(const PairPass& pass, const FilmFormat& format, const CameraSide& camera,
                const Destinations& to)
      : in_(pass),
        techniques_(pass.techniques),
        camera_(camera),
        to_(to),
        format_(format),
        counter_(to.film ? TechniqueCounter(format, pass.owned.group, pass.key.pass)
                         : TechniqueCounter(format)),
        pass_(start_photon_pass(pass.key, pass.scene, format, pass.options)),
        view_(pass.scene, format.bounds()),
        most_(camera.paths.most()),
        records_(to.records, format.bounds().area() * most_, to.records_per_path),
        tree_(pass.scene, pass.owned, pass.options.max_depth),
        settings_{
            .scene = pass.scene,
            .owned = pass.owned,
            .technique = pass.technique,
            .guide = pass.emission,
            .radiance = camera.directions.guides() ? &camera.directions : nullptr,
            .tree = techniques_.separates_chains || pass.options.own<PathOptions>().specular_trees
                        ? &tree_
                        : nullptr} {
    merging_.caustics_only = techniques_.caustics_only;
    merging_.photons = static_cast<double>(techniques_.light_paths);
    merging_.radius_pixels = radius_of_pass(pass.options, pass.key.pass);
    merging_.footprint = pass_.footprint;
    merging_.eye = pass.scene.camera->camera_to_world(pass_.trace.time).point(Vec3f(0, 0, 0));
    merging_.connects = techniques_.connects;
    settings_.view = pass.scene.camera->connects() && merging_.connects ? &view_ : nullptr;
    settings_.specular_alpha = pass_.trace.specular_alpha;
    settings_.max_depth = pass.options.max_depth;
    settings_.light_paths = static_cast<double>(techniques_.light_paths);
    settings_.merging = &merging_;
    const size_t pixels = format.bounds().area();
    parts_ = format.parts_of(static_cast<int>(pass.owned.group)).size();
    values_.resize(pixels * parts_);
    if (to.film) bias_.resize(pixels);
    if (to.paths) measured_.emplace(format, most_);
    points_.resize(most_);
    for (int n = 1; n <= static_cast<int>(most_); ++n)
      if (camera.paths.has(n))
        for (int k = 0; k < n; ++k) points_[n - 1].push_back(sample_points(n, k));
  }

  void run(EstimatorStatistics& statistics) {
    std::optional<SplatBuffer> buffer;
    if (to_.film && merging_.connects)
      buffer.emplace(*to_.film, static_cast<int>(in_.owned.group), *in_.scene.filter);
    LightBatches batches({.light_paths = techniques_.light_paths,
                          .memory_photons = in_.options.memory_photons,
                          .seed = in_.seed,
                          .number_varies = in_.light_paths_vary},
                         pass_, settings_);
    const auto add_splats = [&](std::span<const Splat> splats) {
      counter_.add_splats(splats, 1.0 / static_cast<double>(techniques_.light_paths));
      if (buffer)
        buffer->add(splats);
      else if (measured_ && to_.measures_splats)
        measured_->add_splats(splats, static_cast<float>(techniques_.light_paths));
    };
    do {
      std::vector<Photon> photons = batches.next(add_splats, statistics);
      if (clamps() && clamped_.empty() && !batches.empty())
        clamped_.resize(values_.size() / parts_ * most_, parts_);
      const PhotonGrid grid(std::move(photons));
      merging_.grid = &grid;
      trace_eye_paths(statistics);
      statistics.hold(grid.bytes() + records_.bytes() + camera_.directions.bytes(),
                      values_.size() / parts_ *
                          pair_pass_bytes_per_pixel(parts_, measured_ ? most_ : 0,
                                                    clamped_.empty() ? 0 : most_));
      if (techniques_.separates_chains && camera_.chains && !settings_.merges_only)
        look_for_chains(statistics);
      merging_.grid = nullptr;
      settings_.merges_only = true;
    } while (!batches.empty());
    if (!clamped_.empty()) clamp_samples();
    if (measured_) measured_->add_to(*to_.paths, camera_.paths);
    if (buffer)
      buffer->finish(1.0 / static_cast<double>(techniques_.light_paths), values_);
    else if (to_.film)
      add_values();
    if (to_.film) to_.film->add_bias(static_cast<int>(in_.owned.group), bias_);
    counter_.add_to(statistics.techniques);
    statistics.photon_paths += techniques_.light_paths;
    statistics.radius_min_pixels = merging_.radius_pixels;
    if (statistics.radius_max_pixels == 0) statistics.radius_max_pixels = merging_.radius_pixels;
  }

 private:
  /// Number of a pixel's first sample of `n` in this pass.
  uint32_t first_index(int n) const {
    const uint32_t pass = in_.key.pass, first = camera_.in_first_pass;
    const uint32_t before = first > 0 && pass > 0 ? pass - 1 : pass;
    return (pass > 0 ? first : 0) + before * n;
  }
  /// The numbers of a pixel's sample `k` of `n` in this pass.
  struct SamplePoints {
    SobolPoint eye, light;
  };
  SamplePoints sample_points(int n, int k) const {
    const uint32_t index = first_index(n) + k;
    return {eye_point(index, kEyePathDimensions),
            techniques_.connects ? light_point(index) : SobolPoint(index, 1)};
  }

  void trace_eye_paths(EstimatorStatistics& statistics) {
    const int height = format_.bounds().height();
    // The records of some rows at a time are held twice.
    const int at_once = to_.records ? kRowsWithRecords : height;
    for (int first = 0; first < height; first += at_once)
      trace_rows(first, std::min(at_once, height - first), statistics);
    if (to_.film && to_.adds_features && !settings_.merges_only) to_.film->add_feature_estimates(1);
  }

  void trace_rows(int first, int count, EstimatorStatistics& statistics) {
    const PixelBounds& b = format_.bounds();
    const auto trace_row = [&](Row& row, int64_t number, int64_t) {
      LightSubpath path;
      PartSums light(*in_.owned.routes, in_.owned.group);
      row.techniques = counter_.start_row(light);
      const int y = b.y0 + first + static_cast<int>(number);
      for (int x = b.x0; x < b.x1; ++x) {
        const int samples = camera_.paths.at(x - b.x0, y - b.y0);
        for (int k = 0; k < samples; ++k) trace_sample(x, y, samples, k, path, light, row);
      }
    };
    ordered_reduce<Row>(count, 1, trace_row, [&](Row&& row) {
      statistics.rays += row.rays;
      if (settings_.merges_only) statistics.again_rays += row.rays;
      statistics.camera_paths += row.camera_paths;
      records_.take(row.records, settings_.merges_only);
      counter_.add(row.techniques);
    });
  }

  void trace_sample(int x, int y, int samples, int k, LightSubpath& path, PartSums& light,
                    Row& row) {
    const PixelBounds& b = format_.bounds();
    const size_t pixel = static_cast<size_t>(y - b.y0) * b.width() + (x - b.x0);
    const SamplePoints& points = points_[samples - 1][k];
    const uint64_t rays_before = row.rays;
    PathSampler sampler(points.eye, hash_combine(in_.seed, kEyeStream, x, y));
    CameraPath camera = start_merging_path(in_.scene, x, y, sampler, pass_);
    camera.walk.roulette_threshold = techniques_.roulette_threshold;
    if (merging_.connects && !settings_.merges_only) {
      // A light path of its own: those that are merged run through one sequence, of which a pixel
      // would see the same part in all passes.
      PathSampler own(points.light, hash_combine(in_.seed, kPairStream, x, y));
      row.rays += trace_light_path(settings_, pass_.trace.lambda, pass_.u_time, own, &path, nullptr,
                                   nullptr, kEyePathDimensions)
                      .rays;
    }
    light.clear();
    Features features;
    const bool sees = to_.film && to_.adds_features && !settings_.merges_only && k == 0;
    row.rays += trace_eye_path(settings_, path, camera, sampler, light,
                               {.features = sees ? &features : nullptr,
                                .records = records_.of_path(pixel, k, row.records),
                                .leaves = leaves_at(x - b.x0, y - b.y0)});
    if (sees) features.add_to(*to_.film, x, y, in_.scene, camera, pass_.weights);
    const float share = 1.0f / static_cast<float>(samples);
    if (to_.film)
      bias_[pixel] +=
          light.bias(pass_.weights) * camera.camera_weight * camera.filter_weight * share;
    light.add_techniques_to(
        row.techniques, pass_.weights,
        static_cast<double>(camera.camera_weight) * camera.filter_weight * share);
    const size_t sample = pixel * most_ + k;
    // What has to wait for other batches is clamped at the end.
    const bool waits = !clamped_.empty();
    const std::span<const Rgb> colors = light.colors(
        pass_.weights, camera.camera_weight, waits ? kInfinity : format_.settings().max_component,
        camera.filter_weight * share);
    const std::span<Rgb> sums =
        waits ? clamped_.sums(sample) : std::span(values_).subspan(pixel * parts_, parts_);
    for (size_t i = 0; i < parts_; ++i) sums[i] = sums[i] + colors[i];
    if (measured_) {
      const double seen = total(colors);
      measured_->add_light(sample, static_cast<float>(seen / (3.0 * share)));
      if (!settings_.merges_only) measured_->set_rays(sample, row.rays - rays_before);
    }
    if (settings_.merges_only) return;
    ++row.camera_paths;
    if (waits) clamped_.weights[sample] = std::abs(camera.filter_weight) * share;
  }

  SpecularRoot::Leaves leaves_at(int x, int y) const {
    if (!techniques_.separates_chains) return SpecularRoot::Leaves::kBranches;
    return camera_.chains && camera_.chains->at(x, y) == 0 ? SpecularRoot::Leaves::kNothing
                                                           : SpecularRoot::Leaves::kAll;
  }

  void look_for_chains(EstimatorStatistics& statistics) {
    const SpecularChainPass pass{.scene = in_.scene,
                                 .film = format_,
                                 .owned = in_.owned,
                                 .tree = tree_,
                                 .walks = *camera_.chains,
                                 .seed = in_.seed,
                                 .specular_alpha = settings_.specular_alpha,
                                 .measured = to_.chains,
                                 .techniques = &counter_};
    statistics.rays += pass.render(values_, [this](int n) { return first_index(n); });
  }

  bool clamps() const { return format_.settings().max_component < kInfinity; }

  /// Each sample is clamped before the filter's weight, and its light is what is left.
  void clamp_samples() {
    for (size_t sample = 0; sample < clamped_.weights.size(); ++sample) {
      const std::span<Rgb> sums = clamped_.sums(sample);
      const float before = total(sums);
      PartSums::clamp_total(sums, format_.settings().max_component * clamped_.weights[sample]);
      if (measured_ && before != 0) measured_->scale_light(sample, total(sums) / before);
      for (size_t i = 0; i < parts_; ++i) {
        Rgb& value = values_[sample / most_ * parts_ + i];
        value = value + sums[i];
      }
    }
  }

  /// Without splats the values are all there is.
  void add_values() {
    const PixelBounds& b = format_.bounds();
    const int group = static_cast<int>(in_.owned.group);
    size_t first = 0;
    for (int y = b.y0; y < b.y1; ++y)
      for (int x = b.x0; x < b.x1; ++x, first += parts_)
        to_.film->add(group, x, y, std::span(values_).subspan(first, parts_));
  }

  const PairPass& in_;
  const PairTechniques& techniques_;
  const CameraSide& camera_;
  const Destinations& to_;
  const FilmFormat& format_;
  TechniqueCounter counter_;
  const PhotonPass pass_;
  const CameraView view_;
  const size_t most_;  ///< camera paths of a pixel
  PairMerging merging_;
  PassRecords records_;
  const SpecularTree tree_;
  PairSettings settings_;
  std::vector<std::vector<SamplePoints>> points_;  ///< [samples of a pixel - 1][sample]
  size_t parts_ = 1;
  std::vector<Rgb> values_;  ///< [pixel * parts + part]
  std::vector<float> bias_;  ///< [pixel], [E4]
  std::optional<MeasuredSamples> measured_;
  /// Empty unless the film clamps and photons come in batches; [pixel * most samples + sample].
  SamplesToClamp clamped_;
};

/// Makes room for the records of the pass: growing by and by would take twice as much.
void reserve(std::vector<RadianceRecord>& records, const SampleMap& paths, const FilmFormat& film,
             double per_path) {
  const double all = paths.mean() * static_cast<double>(film.bounds().area());
  records.reserve(std::min(PassRecords::kMax, static_cast<size_t>(all * 1.1 * per_path) + 64));
}

/// Room for what is to be measured, and `to` with it.
std::unique_ptr<PairFindings> findings(const PairPass& pass, const FilmFormat& film,
                                       const PairSamples& samples, const PairLearning& learning,
                                       Destinations& to) {
  auto found = std::make_unique<PairFindings>();
  if (learning.keeps_records) {
    reserve(found->records, samples.paths, film, learning.records_per_path);
    to.records = &found->records;
    to.records_per_path = learning.records_per_path;
  }
  if (learning.measures_variance) {
    PairFindings::Variance& variance = found->variance.emplace(film.bounds());
    to.paths = &variance.paths;
    if (pass.techniques.separates_chains) to.chains = &variance.chains;
  }
  return found;
}

void render_to(const PairRender& to, const PairPass& pass, Destinations destinations,
               EstimatorStatistics& statistics) {
  destinations.film = &to.film;
  destinations.adds_features = to.adds_features;
  const CameraSide camera{to.samples.paths, &to.samples.chains, to.samples.in_first_pass,
                          to.directions};
  PairRendering(pass, to.film.format(), camera, destinations).run(statistics);
  to.film.add_estimates(static_cast<int>(pass.owned.group), 1);
}

}  // namespace

void render(const PairPass& pass, const PairRender& to, EstimatorStatistics& statistics) {
  render_to(to, pass, {}, statistics);
}

std::unique_ptr<PairFindings> render(const PairPass& pass, const PairRender& to,
                                     const PairLearning& learning,
                                     EstimatorStatistics& statistics) {
  Destinations destinations;
  auto found = findings(pass, to.film.format(), to.samples, learning, destinations);
  render_to(to, pass, destinations, statistics);
  return found;
}

std::unique_ptr<PairFindings> measure(const PairPass& pass, const FilmFormat& film,
                                      const PairSamples& samples, const PairLearning& learning,
                                      EstimatorStatistics& statistics) {
  Destinations destinations;
  auto found = findings(pass, film, samples, learning, destinations);
  const CameraSide camera{samples.paths, &samples.chains, samples.in_first_pass};
  PairRendering(pass, film, camera, destinations).run(statistics);
  return found;
}

size_t try_out(const PairPass& pass, const FilmFormat& film, const PairTrial& trial,
               SampleVariance& variance, EstimatorStatistics& statistics) {
  std::vector<RadianceRecord> records;
  Destinations destinations{.paths = &variance, .measures_splats = true};
  if (trial.counts_records) {
    destinations.records = &records;
    destinations.records_per_path = trial.records_per_path;
  }
  PairRendering(pass, film, {trial.paths}, destinations).run(statistics);
  return records.size();
}

size_t pair_pass_bytes_per_pixel(size_t parts, size_t measured_samples, size_t clamped_samples) {
  return SplatBuffer::bytes_per_pixel(parts) + parts * sizeof(Rgb) + sizeof(float) +
         measured_samples * sizeof(MeasuredSamples::Sample) +
         (measured_samples > 0 ? 3 * SampleVariance::kBytesPerPixel : 0) +
         clamped_samples * (parts * sizeof(Rgb) + sizeof(float));
}

}  // namespace nephroid
