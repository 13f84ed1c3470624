#include "integrator/bidirectional/pair_pass.h"

#include <numeric>
#include <vector>

#include "integrator/bidirectional/pair_sampler.h"
#include "integrator/bidirectional/samples_to_clamp.h"
#include "integrator/estimator/slice_loop.h"

namespace nephroid {

namespace {

constexpr size_t kSlicesWithRecords = 512;

/// Bytes for the pixels of the first lattice, each with `samples` that wait for other batches.
size_t bytes_of_measuring(size_t samples) {
  return PixelSlices::kMaxFirstPixels *
         (3 * SampleVariance::kBytesPerPixel + samples * sizeof(MeasuredSamples::Sample));
}

/// Destinations of a pass's results; null: not wanted.
struct Destinations {
  Film* film = nullptr;
  bool adds_features = false;
  SampleVariance* paths = nullptr;
  ChainVariance* chains = nullptr;
  std::vector<RadianceRecord>* records = nullptr;
  double records_per_path = PassRecords::kMaxPerPath;
};

class PairRendering {
 public:
  PairRendering(const PairPass& pass, const FilmFormat& format, const CameraSide& camera,
                const Destinations& to)
      : s_(pass, format, camera, to.film, to.records, to.records_per_path), to_(to) {}

  void run(EstimatorStatistics& statistics) {
    std::optional<SplatBuffer> buffer;
    if (to_.film && s_.merging.connects)
      buffer.emplace(*to_.film, static_cast<int>(s_.in.owned.group), *s_.in.scene.filter);
    const auto add_splats = [&](std::span<const Splat> splats) {
      const double share = 1.0 / static_cast<double>(s_.techniques.light_paths);
      s_.counter.add_splats(splats, share);
      s_.lamps.add_splats(splats, s_.format, share);
      if (buffer) buffer->add(splats);
    };
    std::optional<LightBatches> batches;
    const auto start_batches = [&] {
      batches.emplace(LightBatches::Config{.light_paths = s_.techniques.light_paths,
                                           .memory_photons = s_.in.options.memory_photons,
                                           .seed = s_.in.seed,
                                           .number_varies = s_.in.light_paths_vary},
                      s_.photons, s_.settings);
    };
    start_batches();
    std::vector<Photon> photons = batches->next(add_splats, statistics);
    media_distance_ = batches->media_distance();
    if (batches->empty() && !s_.merging.connects) {
      s_.use(std::move(photons), media_distance_);
      render_pixels(statistics);
      statistics.hold(s_.photon_bytes() + s_.records.bytes() + s_.camera.directions.bytes(),
                      to_.paths ? bytes_of_measuring(0) : 0);
    } else {
      make_room();
      if (batches->empty() || !s_.merging.merges_all_light()) {
        render_batch(std::move(photons), batches->empty(), statistics);
      } else {
        // Roulette needs the photons of all batches ([W12]), so these are traced twice.
        merged_.resize(s_.format.bounds().area() * s_.most);
        count_merged(std::move(photons), statistics);
        while (!batches->empty()) count_merged(batches->next(add_splats, statistics), statistics);
        start_batches();
      }
      while (!batches->empty()) {
        EstimatorStatistics again;
        photons = merged_.empty() ? batches->next(add_splats, statistics)
                                  : batches->next([](std::span<const Splat>) {}, again);
        statistics.rays += again.rays;
        statistics.batch_rays += again.rays;
        render_batch(std::move(photons), batches->empty(), statistics);
      }
      finish_batches(buffer ? &*buffer : nullptr);
    }
    s_.forget_photons();
    s_.counter.add_to(statistics.techniques);
    s_.lamps.add_to(statistics);
    statistics.photon_paths += s_.techniques.light_paths;
    statistics.radius_min_pixels = s_.merging.radius_pixels;
    statistics.radius_max_pixels = s_.merging.radius_pixels;
  }

 private:
  /// Renders pixels with all photons in the grid: a pixel is complete once its paths are traced.
  void render_pixels(EstimatorStatistics& statistics) {
    const int group = static_cast<int>(s_.in.owned.group);
    const PixelSlices all_slices(s_.format.bounds());
    std::optional<SlicesOfPass> of_film;
    std::vector<size_t> slices = wanted_slices(all_slices);
    if (to_.film) {
      of_film.emplace(SlicesOfPass{*to_.film, group, 1, to_.adds_features ? uint64_t{1} : 0});
      slices = of_film->missing();
    }
    std::optional<SpecularChainPass> chains;
    SpecularChainPass::Points chain_points;
    if (s_.techniques.separates_chains && s_.camera.chains) {
      chains.emplace(chain_pass());
      chain_points = chains->points([this](int n) { return s_.first_index(n); });
    }
    const auto render_slice = [&](PairRow& row, size_t slice) {
      PairSampler::Worker worker(s_, row);
      worker.sees = sees(slice);
      std::optional<SpecularChainPass::Walker> walker;
      if (chains) walker.emplace(*chains);
      std::vector<Rgb> values(s_.parts);
      const PixelSlices::Run run = all_slices.at(slice);
      for (int i = 0; i < run.count; ++i) {
        const int x = run.x + i * run.step;
        std::ranges::fill(values, Rgb{});
        float bias = 0;
        render_pixel(x, run.y, worker, {values, bias});
        if (chains)
          chains->look(x - s_.format.bounds().x0, run.y - s_.format.bounds().y0, chain_points,
                       values, *walker);
        if (!to_.film) continue;
        to_.film->add(group, x, run.y, values);
        to_.film->add_bias(group, x, run.y, bias);
      }
      if (walker) {
        row.rays += walker->rays;
        TechniqueCounter::join(walker->techniques, row.techniques);
      }
      if (of_film) of_film->finish(slice);
    };
    for_each_slice_with_records(slices, render_slice, statistics);
    if (of_film) of_film->finish_pass();
  }

  /// Traces the camera paths of a pixel.
  void render_pixel(int x, int y, PairSampler::Worker& worker,
                    const PairSampler::SampleSums& sums) {
    const PixelBounds& b = s_.format.bounds();
    const int samples = s_.camera.paths.at(x - b.x0, y - b.y0);
    for (int k = 0; k < samples; ++k) {
      const PairSampler::SampleLight found = s_.trace(x, y, samples, k, worker, sums);
      if (to_.paths) found.add_to(*to_.paths, x - b.x0, y - b.y0);
    }
  }

  /// Allocates memory for values that wait for other batches and for splats.
  void make_room() {
    values_.resize(s_.format.bounds().area() * s_.parts);
    if (to_.film) bias_.resize(s_.format.bounds().area());
    if (to_.paths) measured_.emplace(s_.format, s_.most);
  }

  /// Merges one batch of photons in all pixels.
  void render_batch(std::vector<Photon> photons, bool is_last, EstimatorStatistics& statistics) {
    if (clamps() && clamped_.empty() && !is_last && !s_.settings.merges_only)
      clamped_.resize(s_.format.bounds().area() * s_.most, s_.parts);
    s_.use(std::move(photons), media_distance_);
    trace_eye_paths(statistics);
    statistics.hold(
        s_.photon_bytes() + s_.records.bytes() + s_.camera.directions.bytes(),
        s_.format.bounds().area() * pair_pass_bytes_per_pixel(
                                        s_.parts, merged_.empty() && clamped_.empty() ? 0 : s_.most,
                                        !clamped_.empty(), s_.merging.connects) +
            (measured_ ? bytes_of_measuring(s_.most) : 0));
    if (s_.techniques.separates_chains && s_.camera.chains && !s_.settings.merges_only) {
      const SpecularChainPass pass = chain_pass();
      statistics.rays +=
          pass.render(values_, pass.points([this](int n) { return s_.first_index(n); }));
    }
    s_.forget_photons();
    s_.settings.merges_only = true;
  }

  void finish_batches(SplatBuffer* buffer) {
    if (!clamped_.empty()) clamp_samples();
    if (measured_) measured_->add_to(*to_.paths, s_.camera.paths);
    if (!to_.film) return;
    if (buffer)
      buffer->finish(1.0 / static_cast<double>(s_.techniques.light_paths), values_);
    else
      add_values();
    const int group = static_cast<int>(s_.in.owned.group);
    to_.film->add_bias(group, bias_);
    to_.film->add_estimates(group, 1);
    if (to_.adds_features) to_.film->add_feature_estimates(1);
  }

  void trace_eye_paths(EstimatorStatistics& statistics) {
    const PixelSlices slices(s_.format.bounds());
    const auto trace_slice = [&](PairRow& row, size_t slice) {
      PairSampler::Worker worker(s_, row);
      worker.sees = sees(slice);
      for_each_sample(slices.at(slice), [&](int x, int y, int samples, int k) {
        trace_waiting(x, y, samples, k, worker);
      });
      if (worker.sees) to_.film->finish_feature_slice(slice, 1);
    };
    for_each_slice_with_records(wanted_slices(slices), trace_slice, statistics);
  }

  /// Counts the photons of a batch that each sample merges, for [W12].
  void count_merged(std::vector<Photon> photons, EstimatorStatistics& statistics) {
    s_.use(std::move(photons), media_distance_);
    s_.settings.merges_only = true;
    const PixelSlices slices(s_.format.bounds());
    const auto count_slice = [&](PairRow& row, size_t slice) {
      PairSampler::Worker worker(s_, row);
      for_each_sample(slices.at(slice), [&](int x, int y, int samples, int k) {
        s_.count_merged(x, y, samples, k, worker, merged_[s_.pixel_of(x, y) * s_.most + k]);
      });
    };
    for_each_slice<PairRow>(s_.in.control, wanted_slices(slices), count_slice, [&](PairRow&& row) {
      statistics.rays += row.rays;
      statistics.batch_rays += row.rays;
    });
    statistics.hold(s_.photon_bytes(), merged_.size() * sizeof(uint32_t));
    s_.forget_photons();
    s_.settings.merges_only = false;
  }

  /// Calls `trace(x, y, samples of the pixel, k)`.
  template <class Trace>
  void for_each_sample(const PixelSlices::Run& run, const Trace& trace) const {
    for (int i = 0; i < run.count; ++i) {
      const int x = run.x + i * run.step;
      const int samples =
          s_.camera.paths.at(x - s_.format.bounds().x0, run.y - s_.format.bounds().y0);
      for (int k = 0; k < samples; ++k) trace(x, run.y, samples, k);
    }
  }

  /// All slices of the film; without a film those of the first lattice.
  std::vector<size_t> wanted_slices(const PixelSlices& of_film) const {
    std::vector<size_t> slices(to_.film ? of_film.count() : of_film.count_of_levels(1));
    std::iota(slices.begin(), slices.end(), size_t{0});
    return slices;
  }

  /// True if camera paths add features and a stopped pass has not added them before.
  bool sees(size_t slice) const {
    return to_.adds_features && !s_.settings.merges_only &&
           !to_.film->has_slice(s_.format.layout().group_count(), slice);
  }

  /// Runs slices in groups: records are held twice, but only those of one group at a time.
  template <class Work>
  void for_each_slice_with_records(std::span<const size_t> slices, const Work& work,
                                   EstimatorStatistics& statistics) {
    const size_t at_once = to_.records ? kSlicesWithRecords : slices.size();
    while (!slices.empty()) {
      const std::span<const size_t> some = slices.first(std::min(at_once, slices.size()));
      for_each_slice<PairRow>(s_.in.control, some, work, [&](PairRow&& row) {
        statistics.rays += row.rays + row.probes;
        statistics.batch_rays += row.probes + (s_.settings.merges_only ? row.rays : 0);
        statistics.camera_paths += row.camera_paths;
        statistics.photons_merged += row.merged;
        s_.records.take(row.records, s_.settings.merges_only);
        s_.counter.add(row.techniques);
      });
      slices = slices.subspan(some.size());
    }
  }

  /// Traces a sample whose pixel is complete only once all batches are merged.
  void trace_waiting(int x, int y, int samples, int k, PairSampler::Worker& worker) {
    const size_t pixel = s_.pixel_of(x, y), sample = pixel * s_.most + k;
    const bool waits = !clamped_.empty();
    float unused = 0;
    const PairSampler::SampleLight found = s_.trace(
        x, y, samples, k, worker,
        {waits ? clamped_.sums(sample) : std::span(values_).subspan(pixel * s_.parts, s_.parts),
         to_.film ? bias_[pixel] : unused, waits},
        merged_.empty() ? nullptr : &merged_[sample]);
    if (measured_) {
      const size_t measured = measured_->sample(x, y, k);
      measured_->add_light(measured, found.mean, found.photon_squares);
      measured_->add_cost(measured,
                          s_.settings.merges_only ? found.cost_of_merges() : found.cost());
    }
    if (waits && !s_.settings.merges_only) clamped_.weights[sample] = found.weight;
  }

  SpecularChainPass chain_pass() {
    return {.scene = s_.in.scene,
            .film = s_.format,
            .owned = s_.in.owned,
            .tree = s_.tree,
            .walks = *s_.camera.chains,
            .seed = s_.in.seed,
            .specular_alpha = s_.settings.specular_alpha,
            .measured = to_.chains,
            .techniques = &s_.counter,
            .lamps = &s_.lamps,
            .control = s_.in.control};
  }

  bool clamps() const { return s_.format.settings().max_component < kInfinity; }

  /// Clamps each sample before the filter's weight and scales its measured light accordingly.
  void clamp_samples() {
    const PixelBounds& b = s_.format.bounds();
    for (size_t sample = 0; sample < clamped_.weights.size(); ++sample) {
      const std::span<Rgb> sums = clamped_.sums(sample);
      const float before = total_of(sums);
      PartSums::clamp_total(sums, s_.format.settings().max_component * clamped_.weights[sample]);
      const size_t pixel = sample / s_.most;
      if (measured_ && before != 0)
        measured_->scale_light(measured_->sample(b.x0 + static_cast<int>(pixel % b.width()),
                                                 b.y0 + static_cast<int>(pixel / b.width()),
                                                 static_cast<int>(sample % s_.most)),
                               total_of(sums) / before);
      for (size_t i = 0; i < s_.parts; ++i) {
        Rgb& value = values_[pixel * s_.parts + i];
        value = value + sums[i];
      }
    }
  }

  /// Adds the values to the film if there are no splats.
  void add_values() {
    const PixelBounds& b = s_.format.bounds();
    const int group = static_cast<int>(s_.in.owned.group);
    size_t first = 0;
    for (int y = b.y0; y < b.y1; ++y)
      for (int x = b.x0; x < b.x1; ++x, first += s_.parts)
        to_.film->add(group, x, y, std::span(values_).subspan(first, s_.parts));
  }

  PairSampler s_;
  const Destinations& to_;
  float media_distance_ = 0;  ///< as in PairMerging
  std::vector<Rgb> values_;   ///< [pixel * parts + part]
  std::vector<float> bias_;   ///< [pixel] bias of [E4]
  std::optional<MeasuredSamples> measured_;
  /// [pixel * most + sample] photons merged from all batches; empty if there is one batch.
  std::vector<uint32_t> merged_;
  /// [pixel * most + sample]; empty unless the film clamps and photons come in batches.
  SamplesToClamp clamped_;
};

/// Allocates the findings.
PairFindings findings(const FilmFormat& film, const PairSamples& samples,
                      const PairLearning& learning) {
  PairFindings found;
  // Step by step, growth would take twice as much memory.
  if (learning.keeps_records)
    found.records.reserve(std::min(
        PassRecords::kMax,
        static_cast<size_t>(samples.paths.mean() * 1.1 * learning.records_per_path *
                            static_cast<double>(PixelSlices(film.bounds()).first_pixels())) +
            64));
  if (learning.measures_variance)
    found.variance.emplace(film.bounds(), PixelSlices(film.bounds()).spacing(1));
  return found;
}

}  // namespace

void render(const PairPass& pass, const PairRender& to, EstimatorStatistics& statistics) {
  const Destinations destinations{.film = &to.film, .adds_features = to.adds_features};
  const CameraSide camera{to.samples.paths, &to.samples.chains, to.directions};
  PairRendering(pass, to.film.format(), camera, destinations).run(statistics);
}

PairFindings measure(const PairPass& pass, const FilmFormat& film, const PairSamples& samples,
                     const PairLearning& learning, EstimatorStatistics& statistics) {
  PairFindings found = findings(film, samples, learning);
  Destinations destinations{.records_per_path = learning.records_per_path};
  if (found.variance) {
    destinations.paths = &found.variance->paths;
    if (pass.techniques.separates_chains) destinations.chains = &found.variance->chains;
  }
  if (learning.keeps_records) destinations.records = &found.records;
  PairRendering(pass, film, {samples.paths, &samples.chains}, destinations).run(statistics);
  return found;
}

size_t run_trial(const PairPass& pass, const FilmFormat& film, const PairTrial& trial,
                 SampleVariance& variance, EstimatorStatistics& statistics) {
  std::vector<RadianceRecord> records;
  Destinations destinations{.paths = &variance};
  if (trial.counts_records) destinations.records = &records;
  PairRendering(pass, film, {trial.paths}, destinations).run(statistics);
  return records.size();
}

size_t pair_pass_bytes_per_pixel(size_t parts, size_t samples, bool clamps, bool splats) {
  return (splats ? SplatBuffer::bytes_per_pixel(parts) : 0) + parts * sizeof(Rgb) + sizeof(float) +
         samples * sizeof(uint32_t) +
         (clamps ? samples * (parts * sizeof(Rgb) + sizeof(float)) : 0);
}

}  // namespace nephroid
