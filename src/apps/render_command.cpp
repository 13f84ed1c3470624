// `nephroid render`: scene, integrator, film and session put together.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "apps/commands.h"
#include "apps/messages.h"
#include "apps/progress_display.h"
#include "apps/render_report.h"
#include "core/parallel.h"
#include "film/atomic_file.h"
#include "film/film_output.h"
#include "input/scene_files.h"
#include "integrator/ppm.h"
#include "session/checkpoint/version.h"
#include "session/film_of_scene.h"
#include "session/process_memory.h"
#include "session/render_session.h"
#include "session/scene_loading.h"
#include "session/settings/unused_settings.h"

namespace nephroid {
namespace {

constexpr int kSignalStatus = 128;

RenderIdentity identity_of(const RenderCommand& command, const SceneFiles& files,
                           const IntegratorChoice& choice, const RoutePlan& plan) {
  RenderIdentity identity = RenderIdentity::of_this_program();
  identity.scene = command.scene;
  identity.scene_hash = fmt::format("{:016x}", files.hash());
  identity.integrator = name_of(command.routes, choice.name);
  identity.options = settings_text(choice.options);
  identity.routes = routes_text(plan);
  identity.aovs = aovs_text(plan);
  return identity;
}

/// What a picture has beside the wanted passes stays in it, and no picture of those can be merged
/// with it.
void warn_of_passes_beyond(const RenderOptions& options, const std::string& output) {
  const PassRanges& done = options.begin_with.passes;
  if (!options.last_pass || done.empty()) return;
  const uint32_t first = done.ranges().front().first, last = done.ranges().back().last;
  if (first < options.first_pass || last > *options.last_pass)
    print_warning(
        fmt::format("{} has passes {}, of which --passes {}..{} are wanted; the others stay",
                    output, done.text(), options.first_pass, *options.last_pass));
}

/// A picture of this render that would not have to be rendered again.
void warn_of_what_is_replaced(const std::string& output, const RenderIdentity& here) {
  const PassRanges passes = passes_to_go_on_from(output, here);
  if (!passes.empty())
    print_warning(
        fmt::format("{} has passes {} of this very render and will be replaced; --resume "
                    "goes on with it",
                    output, passes.text()));
}

void warn_of_what_is_not_rejected(const Routes& routes) {
  const auto warn = [&](EstimatorKind kind, const char* what) {
    if (std::ranges::any_of(routes.groups(),
                            [&](const RouteGroup& group) { return group.estimator == kind; }))
      print_warning(std::string("--outliers reject: routes of ") + estimator_type(kind).name +
                    what);
  };
  for (const EstimatorKind kind : {EstimatorKind::kSppm, EstimatorKind::kPpm})
    warn(kind, " keep theirs, they have no estimates that could be held");
  warn(EstimatorKind::kPhotonMap,
       " show theirs after some passes, which read the same photons again and so confirm them");
}

/// The user's, over what a limit of memory leaves room for.
SettingList settings_of(const RenderCommand& command) {
  SettingList settings;
  if (command.memory > 0) settings = settings_within(command.memory);
  settings.insert(settings.end(), command.settings.begin(), command.settings.end());
  return settings;
}

RenderOptions render_options(const RenderCommand& command, const Scene& scene,
                             const std::string& output, RenderIdentity identity) {
  RenderOptions options;
  if (command.passes) {
    options.first_pass = command.passes->first;
    options.last_pass = command.passes->second;
  }
  options.time_limit = command.time_limit;
  options.noise_target = command.noise_target;
  options.seed = command.seed.value_or(scene.scene_seed);
  options.output = output;
  options.checkpoint_interval = command.checkpoint_interval;
  options.keeps_state = command.keeps_state;
  std::error_code no_temporary_directory;
  options.rescue_directory = std::filesystem::temp_directory_path(no_temporary_directory).string();
  options.identity = std::move(identity);
  return options;
}

}  // namespace

int run_render(const RenderCommand& command) {
  // A picture that is asked for while the scene is read is written after the first pass.
  SignalListener signals;
  const ThreadLimit threads(command.threads);
  limit_image_threads(command.threads);
  // A name that cannot be written is said before the scene is read, which may take long.
  if (!command.output.empty()) {
    check_file_can_be_written(command.output);
    check_file_can_be_written(png_path_beside(command.output));
  }
  const uint64_t memory = command.memory > 0 ? command.memory : machine_memory();
  MemoryLimit limit;
  limit.set(memory, bytes_of_stacks_to_come(command.threads));
  const SettingList settings = settings_of(command);
  SceneOverrides overrides = command.overrides;
  IntegratorOptions of_settings;
  apply_settings(settings, &of_settings);
  overrides.texture_memory = static_cast<uint64_t>(of_settings.texture_memory);
  const LoadedScene loaded = load_scene(command.scene, overrides);
  if (!command.quiet) print_warnings(loaded.warnings);
  const Scene& scene = *loaded.scene;

  const IntegratorChoice choice =
      choose_integrator(command.routes.integrator_or(kDefaultIntegrator), scene.integrator,
                        scene.integrator_parameters, settings);
  const RoutePlan plan = plan_of(command.routes, choice.name);
  if (!command.quiet)
    for (const std::string& warning : choice.warnings) print_warning(warning);
  Preset preset = make_preset(plan, choice.options, scene);
  if (!command.quiet)
    for (const std::string& warning : preset.warnings) print_warning(warning);
  if (!command.quiet) print_warnings(unused_settings(command.settings, *preset.routes));
  check_memory({scene.film, preset.layout, *preset.routes, command.reject_outliers,
                Ppm::hit_points(choice.options, scene.samples_per_pixel),
                choice.options.memory_photons, memory_in_use(), overrides.texture_memory / 4, true},
               memory, command.memory > 0, command.overrides.width > 0);
  limit.set(memory, bytes_of_stacks_to_come(command.threads));
  Film film(film_settings(scene.film), preset.layout);
  if (command.reject_outliers) {
    film.reject_outliers(outlier_settings(*preset.routes, choice.options, *scene.filter));
    if (!command.quiet) warn_of_what_is_not_rejected(*preset.routes);
  }
  const std::string output =
      command.output.empty() ? default_output(scene.film, command.scene) : command.output;
  RenderOptions options = render_options(
      command, scene, output, identity_of(command, *loaded.description.files, choice, plan));
  options.identity.set_film(film, options.seed);
  if (std::filesystem::exists(output)) {
    const RenderIdentity& here = options.identity;
    if (command.resume) {
      options.begin_with = go_on_from(output, here, scene, preset, film);
      print_warnings(options.begin_with.warnings);
      warn_of_passes_beyond(options, output);
    } else {
      warn_of_what_is_replaced(output, here);
    }
  }
  std::vector<std::string> notes = preset.notes;
  options.notes = notes;
  notes.insert(notes.end(), choice.notes.begin(), choice.notes.end());
  RenderSession session(scene, preset, film, std::move(options));

  ProgressDisplay display;
  if (!command.quiet)
    session.on_progress([&](const RenderProgress& progress) { display.show(progress); });
  session.on_warning([&](const std::string& warning) {
    if (!command.quiet) display.clear();
    print_warning(warning);
  });
  signals.note_stops(!command.quiet);
  const RenderResult result = session.run(signals.flags());
  if (!command.quiet) {
    display.clear();
    say(render_report(result, film, output, notes));
  }
  if (command.strict && !result.faults.empty() && result.reason != StopReason::kSignal) {
    print_error("--strict: " + result.faults[0]);
    return static_cast<int>(ExitStatus::kRender);
  }
  return result.reason == StopReason::kSignal ? kSignalStatus + result.signal
                                              : static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid
