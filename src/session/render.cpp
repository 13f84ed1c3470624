// The steps of a render, in order.
#include "session/render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "core/counted.h"
#include "film/film_settings.h"
#include "input/scene_files.h"
#include "input/scene_reader.h"
#include "session/film_of_scene.h"
#include "session/process_memory.h"
#include "session/settings/short_paths.h"
#include "session/settings/unused_settings.h"

namespace nephroid {
namespace {

std::string no_picture_to_go_on_from(const std::string& path) {
  std::string text =
      fmt::format("--resume: there is no {} yet, the render starts at its first pass", path);
  if (const auto kept = kept_picture(path))
    text += fmt::format("; to go on from {}, stop, and give its files their old names", *kept);
  return text;
}

using Warn = std::function<void(const std::string&)>;

void warn_of(const std::vector<std::string>& warnings, const Warn& warn) {
  if (warn)
    for (const std::string& warning : warnings) warn(warning);
}

void check_fits_memory(const RenderRequest& request, const Scene& scene,
                       const IntegratorOptions& options, const EstimatorSet& set) {
  MemoryNeed need{scene.film, set.layout, *set.routes, options, scene.samples_per_pixel};
  need.rejects_outliers = request.reject_outliers;
  need.held = memory_in_use();
  need.textures = request.settings.scene.texture_memory / 4;
  need.writes = !request.options.output.empty();
  check_memory(need, request.memory > 0 ? request.memory : machine_memory(), request.memory > 0,
               request.overrides.width > 0);
}

/// Warnings about routes whose outliers are not rejected.
std::vector<std::string> rejection_warnings(const Routes& routes) {
  std::set<std::string> warnings;
  for (const RouteGroup& group : routes.groups()) {
    const EstimatorDescriptor& estimator = descriptor_of(group);
    if (estimator.outlier_warning != nullptr)
      warnings.insert(fmt::format("--outliers reject: routes of {} {}", estimator.traits.name,
                                  estimator.outlier_warning));
  }
  return {warnings.begin(), warnings.end()};
}

RenderIdentity identity_of(const RenderRequest& request, const LoadedScene& loaded,
                           const IntegratorChoice& choice, const RoutePlan& plan) {
  RenderIdentity identity = RenderIdentity::of_this_program();
  identity.scene = request.scene;
  identity.scene_hash = fmt::format("{:016x}", loaded.description.files->hash());
  identity.integrator = name_of(request.routes, choice.name);
  identity.options = settings_text(choice.settings);
  if (const std::string import = import_options_text(request.overrides.import); !import.empty())
    identity.options += " " + import;
  identity.routes = routes_text(plan);
  identity.aovs = aovs_text(plan);
  identity.layers_by_light = layers_by_light_text(layers_by_light(plan));
  return identity;
}

/// A warning if the picture has passes beside the wanted range: they stay in it, and no picture of
/// those can be merged with it.
std::vector<std::string> warnings_of_passes_beyond(const RenderOptions& options) {
  const PassRanges& done = options.begin_with.passes;
  if (!options.last_pass || done.empty()) return {};
  const uint32_t first = done.ranges().front().first, last = done.ranges().back().last;
  if (first >= options.first_pass && last <= *options.last_pass) return {};
  return {fmt::format("{} has passes {}, and --passes {}..{} are wanted; the others stay",
                      options.output, done.text(), options.first_pass, *options.last_pass)};
}

/// Throws SceneError with a line for each name of the scene that the format does not have.
void refuse_unknown_names(const LoadedScene& loaded, const IntegratorChoice& choice) {
  std::vector<std::string> names = loaded.unknown_names;
  names.insert(names.end(), choice.unknown_names.begin(), choice.unknown_names.end());
  if (names.empty()) return;
  throw SceneError({}, fmt::format("{}\n--strict: ", fmt::join(names, "\n")) +
                           counted(names.size(), "unknown name") +
                           " in the scene, expected names of its format");
}

/// Reads the state of an earlier run into film and estimators.
void resume(const std::string& from, RenderOptions& options, const Scene& scene, EstimatorSet& set,
            Film& film, const Warn& warn) {
  options.begin_with = go_on_from(from, options.identity, scene, set, film);
  warn_of(options.begin_with.warnings, warn);
  warn_of(warnings_of_passes_beyond(options), warn);
}

}  // namespace

SceneOverrides scene_overrides(const RenderRequest& request) {
  SceneOverrides overrides = request.overrides;
  overrides.specular_band = request.settings.scene.specular_band;
  overrides.texture_memory = request.settings.scene.texture_memory;
  return overrides;
}

LoadedScene load_scene(const RenderRequest& request, std::shared_ptr<SceneFiles> files) {
  return load_scene(request.scene, scene_overrides(request), std::move(files));
}

LoadedScene load_small_scene(const RenderRequest& request, int longest_side) {
  return load_small_scene(request.scene, scene_overrides(request), longest_side);
}

IntegratorChoice choose_integrator(const RenderRequest& request, const Scene& scene) {
  return choose_integrator(request.routes.integrator_or(kDefaultIntegrator), scene.integrator,
                           scene.integrator_parameters, request.settings,
                           is_pbrt_scene(request.scene));
}

Render::Render(const RenderRequest& request, const LoadedScene& loaded, RenderWarnings warnings)
    : scene_(*loaded.scene), notes_of_scene_(loaded.notes), warnings_(std::move(warnings)) {
  const Scene& scene = scene_;
  choice_ = choose_integrator(request, scene);
  warn_of(loaded.warnings, warnings_.input);
  if (request.strict) refuse_unknown_names(loaded, choice_);
  plan_ = plan_of(request.routes, choice_.name);
  add_layers(request.routes.layers, scene, &plan_);
  warn_of(choice_.warnings, warnings_.input);

  for (std::string& note : notes_of_short_paths(scene, choice_.settings))
    choice_.notes.push_back(std::move(note));

  const IntegratorOptions& integrator = choice_.settings.integrator;
  set_ = make_estimators(plan_, integrator, scene);
  warn_of(set_.warnings, warnings_.input);
  warn_of(unused_settings(request.settings.given, *set_.routes), warnings_.input);

  check_fits_memory(request, scene, integrator, set_);
  film_.emplace(film_settings(scene.film), set_.layout);
  if (request.reject_outliers) {
    film_->reject_outliers(outlier_settings(*set_.routes, integrator, *scene.filter,
                                            film_->format().picture_pixels(),
                                            choice_.settings.scene));
    warn_of(rejection_warnings(*set_.routes), warnings_.input);
  }

  RenderOptions options = request.options;
  seed_ = options.seed = request.seed.value_or(scene.scene_seed);
  options.notes = notes();
  options.quick_look_depth = integrator.max_depth;
  identity_ = identity_of(request, loaded, choice_, plan_);
  identity_.set_film(*film_, options.seed);
  options.identity = identity_;
  const std::string& saved = request.resume_from.empty() ? options.output : request.resume_from;
  if (request.resume &&
      (std::filesystem::exists(saved) || std::filesystem::exists(state_path_beside(saved))))
    resume(saved, options, scene, set_, *film_, warnings_.output);
  else if (request.resume)
    warn_of({no_picture_to_go_on_from(saved)}, warnings_.output);
  else if (const auto warning = warning_of_replacing(options.output, identity_))
    warn_of({*warning}, warnings_.output);

  has_resumed_ = !options.begin_with.passes.empty() || options.begin_with.open_pass;
  if (!request.learned_from.empty() && !options.begin_with.has_learned)
    warn_of(learn_from(request.learned_from, identity_, set_, *film_), warnings_.output);
  session_.emplace(scene, set_, *film_, std::move(options));
  if (warnings_.output) session_->on_warning(warnings_.output);
}

void Render::on_progress(std::function<void(const RenderProgress&)> callback) {
  session_->on_progress(std::move(callback));
}
void Render::on_picture(std::function<void(const ShownPicture&)> callback) {
  session_->on_picture(std::move(callback));
}
void Render::on_request(std::function<void()> callback) {
  session_->on_request(std::move(callback));
}
void Render::use_clock(std::function<double()> seconds) {
  session_->use_clock(std::move(seconds));
}

PixelInspection Render::inspect(int x, int y) {
  InspectionSettings settings;
  settings.seed = seed_;
  settings.options = choice_.settings.integrator;
  return inspect_pixel(scene_, set_, *film_, x, y, settings);
}

RenderResult Render::run(SignalFlags& signals) {
  return session_->run(signals);
}

std::vector<std::string> Render::notes() const {
  std::vector<std::string> notes = notes_of_scene_;
  notes.insert(notes.end(), set_.notes.begin(), set_.notes.end());
  notes.insert(notes.end(), choice_.notes.begin(), choice_.notes.end());
  return notes;
}

}  // namespace nephroid
