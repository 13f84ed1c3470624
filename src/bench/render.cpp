#include "bench/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/measure.h"
#include "film/film_output.h"
#include "session/film_of_scene.h"
#include "session/process_memory.h"
#include "session/report/noise.h"

namespace nephroid {
namespace {

/// Factor of passes between the points of a curve.
constexpr double kPointRatio = 1.25;

/// A clock that can be paused.
class Stopwatch {
 public:
  double seconds() const { return machine_seconds() - paused_; }
  /// Runs `work` without counting its time.
  template <class Work>
  void pause_for(const Work& work) {
    const double begin = machine_seconds();
    work();
    paused_ += machine_seconds() - begin;
  }

 private:
  static double machine_seconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
  }
  double paused_ = 0;
};

struct Totals {
  uint64_t rays = 0, emitted = 0, stored = 0, bytes = 0, photon_bytes = 0, pixel_bytes = 0;
};
Totals totals_of(const std::vector<EstimatorStatistics>& statistics) {
  Totals t;
  for (const EstimatorStatistics& s : statistics) {
    t.rays += s.rays;
    t.emitted += s.photon_paths + s.light_paths;
    t.stored += s.photons_stored;
    t.bytes += s.bytes;
    t.photon_bytes += s.photon_bytes;
    t.pixel_bytes += s.pixel_bytes;
  }
  return t;
}

/// Measures the film at passes that grow by a factor, and at the end.
class Curve {
 public:
  Curve(const Film& film, const EstimatorSet& set, const Picture* reference,
        const BenchScene& scene)
      : film_(film), set_(set), reference_(reference), scene_(scene) {
    // The AOVs of runs are in this order, followed by those of shares.
    if (reference_ != nullptr)
      for (const BenchEnergy& layer : scene_.layers)
        reference_layers_.push_back(layer_of(*reference_, layer.name));
  }

  void pass_is_done(uint32_t passes, double seconds) {
    if (passes < next_) return;
    measure(passes, seconds);
    next_ = std::max(passes + 1, static_cast<uint32_t>(std::ceil(passes * kPointRatio)));
  }
  std::vector<BenchPoint> finish(uint32_t passes, double seconds) {
    if (points_.empty() || points_.back().passes != passes) measure(passes, seconds);
    return std::move(points_);
  }

 private:
  void measure(uint32_t passes, double seconds) {
    BenchPoint point{passes, seconds, totals_of(set_.statistics()).emitted, {}, {}};
    if (reference_ != nullptr)
      point.errors = measure_errors(*reference_, colors_of_film(film_), scene_.exposure);
    for (size_t i = 0; i < reference_layers_.size(); ++i)
      point.layers.emplace_back(
          scene_.layers[i].name,
          measure_errors(reference_layers_[i], colors_of_film(film_, static_cast<int>(i)),
                         scene_.exposure));
    points_.push_back(std::move(point));
  }

  const Film& film_;
  const EstimatorSet& set_;
  const Picture* reference_;
  const BenchScene& scene_;
  std::vector<Picture> reference_layers_;
  uint32_t next_ = 1;
  std::vector<BenchPoint> points_;
};

void check_size(const Picture& reference, const Film& film) {
  const PixelBounds& b = film.bounds();
  if (reference.width() == b.width() && reference.height() == b.height()) return;
  throw UsageError(fmt::format(
      "the reference is {}x{} pixels and the scene's picture {}x{}, expected the same (the scene's "
      "\"resolution\" in the suite)",
      reference.width(), reference.height(), b.width(), b.height()));
}

Metadata metadata_of(RenderIdentity identity, const BenchRun& run) {
  identity.integrator = run.integrator;
  Metadata metadata = identity.to_metadata();
  Checkpoint progress;
  progress.passes = PassRanges(PassRange{0, run.end().passes - 1});
  progress.seconds = run.end().seconds;
  add_progress(progress, &metadata);
  return metadata;
}

void fill_run(const RenderResult& result, const Film& film, const BenchRender& render,
              const Picture* reference, BenchRun* run) {
  const Totals totals = totals_of(result.statistics);
  run->rays = totals.rays;
  run->emitted = totals.emitted;
  run->photons_stored = totals.stored;
  run->bytes = totals.bytes;
  run->photon_bytes = totals.photon_bytes;
  run->pixel_bytes = totals.pixel_bytes;
  run->first_pass_bytes = totals_of(result.first_pass_statistics).bytes;
  for (const EstimatorStatistics& s : result.statistics)
    run->notes.insert(run->notes.end(), s.notes.begin(), s.notes.end());
  if (render.with_energy) {
    const std::vector<double> shares = energy_shares(film).aovs;
    const std::vector<BenchEnergy>&layers = render.scene->layers, &energy = render.scene->energy;
    for (size_t i = 0; i < shares.size(); ++i)
      run->energy.emplace_back(i < layers.size() ? layers[i].name : energy[i - layers.size()].name,
                               shares[i]);
  }
  if (reference == nullptr) return;
  const Picture colors = colors_of_film(film);
  for (const BenchRegion& region : render.scene->regions)
    run->regions.emplace_back(region.name,
                              measure_errors(part_of(*reference, region), part_of(colors, region),
                                             render.scene->exposure));
}

bool same(const SceneOverrides& a, const SceneOverrides& b) {
  return a.width == b.width && a.height == b.height && a.specular_band.low == b.specular_band.low &&
         a.specular_band.high == b.specular_band.high && a.texture_memory == b.texture_memory &&
         a.import == b.import;
}

/// The routes of a render and the AOVs that its shares of light need.
RouteChoice routes_of(const BenchRender& render) {
  RouteChoice routes = render.integrator->routes;
  const auto add = [&](const BenchEnergy& e) {
    routes.aovs.push_back(parse_aov(e.name + "=" + e.expression));
  };
  for (const BenchEnergy& layer : render.scene->layers) add(layer);
  if (render.with_energy)
    for (const BenchEnergy& energy : render.scene->energy) add(energy);
  return routes;
}

RenderRequest request_of(const BenchRender& render) {
  RenderRequest request;
  request.scene = render.scene->file;
  request.overrides.width = render.scene->width;
  request.overrides.height = render.scene->height;
  request.routes = routes_of(render);
  request.settings = render_settings(settings_of(render));
  request.reject_outliers = render.integrator->reject_outliers;
  request.seed = render.integrator->seed;
  if (render.limit.passes > 0) request.options.last_pass = render.limit.passes - 1;
  request.options.time_limit = render.limit.seconds;
  request.options.show_error = false;
  return request;
}

}  // namespace

const LoadedScene& SceneShelf::load(const BenchRender& render) {
  const RenderRequest request = request_of(render);
  const SceneOverrides overrides = scene_overrides(request);
  if (loaded_.scene && name_ == render.scene->name && same(overrides, overrides_)) return loaded_;
  loaded_ = {};
  loaded_ = load_scene(request);
  name_ = render.scene->name;
  overrides_ = overrides;
  return loaded_;
}

SettingList settings_of(const BenchRender& render) {
  SettingList settings = render.scene->options;
  const SettingList& own = render.integrator->options;
  settings.insert(settings.end(), own.begin(), own.end());
  return settings;
}

RoutePlan plan_of(const BenchRender& render) {
  const RouteChoice routes = routes_of(render);
  return plan_of(routes, routes.integrator_or(kDefaultIntegrator));
}

std::optional<BenchRendered> render_for_bench(const BenchRender& wanted, const Picture* reference,
                                              SceneShelf& shelf, SignalFlags& signals) {
  const LoadedScene& loaded = shelf.load(wanted);
  restart_memory_peak();
  Render render(request_of(wanted), loaded);
  const Film& film = render.film();
  if (reference != nullptr) check_size(*reference, film);

  Stopwatch watch;
  Curve curve(film, render.estimators(), reference, *wanted.scene);
  render.use_clock([&] { return watch.seconds(); });
  if (reference != nullptr)
    render.on_progress([&](const RenderProgress& progress) {
      if (progress.within_pass) return;
      watch.pause_for([&] { curve.pass_is_done(progress.passes_done, progress.seconds); });
    });
  const RenderResult result = render.run(signals);
  if (result.reason == StopReason::kSignal) return std::nullopt;

  BenchRendered rendered;
  BenchRun& run = rendered.run;
  run.process_bytes = memory_peak();
  run.integrator = wanted.integrator->name;
  run.seed = wanted.integrator->seed;
  run.options = settings_text(render.integrator().settings);
  run.routes = routes_text(render.plan());
  run.points = curve.finish(result.passes_done, result.seconds);
  rendered.warnings = render.estimators().warnings;
  for (const std::vector<std::string>& warnings :
       {loaded.warnings, loaded.notes, render.integrator().warnings, rendered.warnings})
    run.notes.insert(run.notes.end(), warnings.begin(), warnings.end());
  fill_run(result, film, wanted, reference, &run);
  rendered.picture = film_picture(film, metadata_of(render.identity(), run));
  return rendered;
}

}  // namespace nephroid
