#include "bench/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/measure.h"
#include "film/film_output.h"
#include "options/options.h"
#include "session/checkpoint/version.h"
#include "session/film_of_scene.h"
#include "session/process_memory.h"
#include "session/render_session.h"
#include "session/report/noise.h"

namespace nephroid {
namespace {

/// Points of a curve are at passes that grow by this factor.
constexpr double kPointRatio = 1.25;

/// Seconds that can be stopped.
class Stopwatch {
 public:
  double seconds() const { return machine_seconds() - paused_; }
  /// Does what is not to be counted.
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

std::vector<EstimatorStatistics> statistics_of(const Preset& preset) {
  std::vector<EstimatorStatistics> result;
  for (const auto& estimator : preset.estimators) result.push_back(estimator->statistics());
  return result;
}

/// Measures the film at passes that grow by a factor, and at the end.
class Curve {
 public:
  Curve(const Film& film, const Preset& preset, const Picture* reference, const BenchScene& scene)
      : film_(film), preset_(preset), reference_(reference), scene_(scene) {
    // Runs have the layers in this order, and then those of shares.
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
    BenchPoint point{passes, seconds, totals_of(statistics_of(preset_)).emitted, {}, {}};
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
  const Preset& preset_;
  const Picture* reference_;
  const BenchScene& scene_;
  std::vector<Picture> reference_layers_;
  uint32_t next_ = 1;
  std::vector<BenchPoint> points_;
};

RenderOptions render_options(const BenchRender& render) {
  RenderOptions options;
  if (render.limit.passes > 0) options.last_pass = render.limit.passes - 1;
  options.time_limit = render.limit.seconds;
  options.seed = render.integrator->seed;
  options.show_error = false;
  return options;
}

void check_size(const Picture& reference, const Film& film) {
  const PixelBounds& b = film.bounds();
  if (reference.width() == b.width() && reference.height() == b.height()) return;
  throw UsageError(fmt::format(
      "the reference is {}x{} pixels and the scene's picture {}x{}, expected the same (the scene's "
      "\"resolution\" in the suite)",
      reference.width(), reference.height(), b.width(), b.height()));
}

Metadata metadata_of(const BenchRender& render, const RoutePlan& plan, const BenchRun& run) {
  RenderIdentity identity = RenderIdentity::of_this_program();
  identity.scene = render.scene->file;
  identity.integrator = run.integrator;
  identity.options = run.options;
  identity.routes = run.routes;
  identity.aovs = aovs_text(plan);
  identity.seed = fmt::format("{}", render.integrator->seed);
  if (render.integrator->reject_outliers) identity.outliers = "reject";
  Metadata metadata = identity.to_metadata();
  metadata.emplace_back(kPassesKey, fmt::format("0..{}", run.end().passes - 1));
  metadata.emplace_back(kSecondsKey, fmt::format("{:.3f}", run.end().seconds));
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
         a.specular_band.high == b.specular_band.high && a.texture_memory == b.texture_memory;
}

}  // namespace

const LoadedScene& SceneShelf::load(const BenchScene& scene, const SettingList& settings) {
  IntegratorOptions options;
  apply_settings(settings, &options);
  SceneOverrides overrides;
  overrides.width = scene.width;
  overrides.height = scene.height;
  overrides.specular_band = options.specular_band;
  overrides.texture_memory = static_cast<uint64_t>(options.texture_memory);
  if (loaded_.scene && name_ == scene.name && same(overrides, overrides_)) return loaded_;
  loaded_ = {};
  loaded_ = load_scene(scene.file, overrides);
  name_ = scene.name;
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
  const RouteChoice& choice = render.integrator->routes;
  RoutePlan plan = plan_of(choice, choice.integrator_or(kDefaultIntegrator));
  const auto add = [&](const BenchEnergy& e) {
    plan.aovs.push_back(parse_aov(e.name + "=" + e.expression));
  };
  for (const BenchEnergy& layer : render.scene->layers) add(layer);
  if (render.with_energy)
    for (const BenchEnergy& energy : render.scene->energy) add(energy);
  return plan;
}

std::optional<BenchRendered> render_for_bench(const BenchRender& render, const Picture* reference,
                                              SceneShelf& shelf, SignalFlags& signals) {
  const SettingList settings = settings_of(render);
  const LoadedScene& loaded = shelf.load(*render.scene, settings);
  const Scene& scene = *loaded.scene;
  const RoutePlan plan = plan_of(render);
  const IntegratorChoice choice =
      choose_integrator(render.integrator->routes.integrator_or(kDefaultIntegrator),
                        scene.integrator, scene.integrator_parameters, settings);
  restart_memory_peak();
  Preset preset = make_preset(plan, choice.options, scene);
  check_memory({scene.film, preset.layout, *preset.routes, render.integrator->reject_outliers},
               machine_memory(), false, render.scene->width > 0);
  Film film(film_settings(scene.film), preset.layout);
  if (render.integrator->reject_outliers)
    film.reject_outliers(outlier_settings(*preset.routes, choice.options, *scene.filter));
  if (reference != nullptr) check_size(*reference, film);

  Stopwatch watch;
  Curve curve(film, preset, reference, *render.scene);
  RenderSession session(scene, preset, film, render_options(render));
  session.use_clock([&] { return watch.seconds(); });
  if (reference != nullptr)
    session.on_progress([&](const RenderProgress& progress) {
      watch.pause_for([&] { curve.pass_is_done(progress.passes_done, progress.seconds); });
    });
  const RenderResult result = session.run(signals);
  if (result.reason == StopReason::kSignal) return std::nullopt;

  BenchRendered rendered;
  BenchRun& run = rendered.run;
  run.process_bytes = memory_peak();
  run.integrator = render.integrator->name;
  run.seed = render.integrator->seed;
  run.options = settings_text(choice.options);
  run.routes = routes_text(plan);
  run.points = curve.finish(result.passes_done, result.seconds);
  for (const std::vector<std::string>& warnings :
       {loaded.warnings, choice.warnings, preset.warnings})
    run.notes.insert(run.notes.end(), warnings.begin(), warnings.end());
  rendered.warnings = preset.warnings;
  fill_run(result, film, render, reference, &run);
  rendered.picture = film_picture(film, metadata_of(render, plan, run));
  return rendered;
}

}  // namespace nephroid
