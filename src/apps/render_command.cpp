// `nephroid render`: runs session/render.h with output on a terminal.
#include <fmt/format.h>

#include <filesystem>

#include "apps/commands.h"
#include "apps/messages.h"
#include "apps/progress_display.h"
#include "apps/render_report.h"
#include "core/parallel.h"
#include "film/film_output.h"
#include "session/film_of_scene.h"
#include "session/process_memory.h"
#include "session/render.h"

namespace nephroid {
namespace {

constexpr int kSignalStatus = 128;

RenderRequest request_of(const RenderCommand& command) {
  RenderRequest request;
  request.scene = command.scene;
  request.overrides = command.overrides;
  request.routes = command.routes;
  request.settings = render_settings(command.settings, command.memory);
  request.reject_outliers = command.reject_outliers;
  request.memory = command.memory;
  request.seed = command.seed;
  request.resume = command.resume;
  request.strict = command.strict;
  RenderOptions& options = request.options;
  if (command.passes) {
    options.first_pass = command.passes->first;
    options.last_pass = command.passes->second;
  }
  options.time_limit = command.time_limit;
  options.noise_target = command.noise_target;
  options.output = command.output;
  options.checkpoint_interval = command.checkpoint_interval;
  options.keeps_state = command.keeps_state;
  options.layer_precision = command.layer_precision;
  std::error_code no_temporary_directory;
  options.rescue_directory = std::filesystem::temp_directory_path(no_temporary_directory).string();
  return request;
}

/// With --quiet, only warnings about the output file are printed.
RenderWarnings warnings_of(const RenderCommand& command, ProgressDisplay& display) {
  RenderWarnings warnings;
  if (!command.quiet) warnings.input = print_warning;
  warnings.output = [&display](const std::string& warning) {
    display.clear();
    print_warning(warning);
  };
  return warnings;
}

int exit_status(const RenderCommand& command, const RenderResult& result) {
  if (result.reason == StopReason::kSignal) return kSignalStatus + result.signal;
  if (!command.strict || result.faults.empty()) return static_cast<int>(ExitStatus::kDone);
  print_error("--strict: " + result.faults[0]);
  return static_cast<int>(ExitStatus::kRender);
}

}  // namespace

int run_render(const RenderCommand& command) {
  // If SIGUSR1 comes while the scene is read, the picture is written after the first pass.
  SignalListener signals;
  const ThreadLimit threads(command.threads);
  limit_image_threads(command.threads);
  // Checked first, since scene files may take long to read.
  if (!command.output.empty()) check_picture_can_be_written(command.output);
  RenderRequest request = request_of(command);

  const uint64_t memory = command.memory > 0 ? command.memory : machine_memory();
  MemoryLimit limit;
  limit.set(memory, bytes_of_stacks_to_come(command.threads));
  const LoadedScene loaded = load_scene(request);
  limit.set(memory, bytes_of_stacks_to_come(command.threads));
  if (command.output.empty())
    request.options.output = default_output(loaded.scene->film, command.scene);

  ProgressDisplay display;
  Render render(request, loaded, warnings_of(command, display));
  if (!command.quiet) {
    // Printed before the first ray, so that the user need not wait for them.
    for (const std::string& note : render.notes()) say("note: " + note + "\n");
    render.on_progress([&](const RenderProgress& progress) { display.show(progress); });
  }
  signals.note_stops(!command.quiet);
  const RenderResult result = render.run(signals.flags());
  if (!command.quiet) {
    display.clear();
    say(render_report(result, render.film(), request.options.output));
  }
  return exit_status(command, result);
}

}  // namespace nephroid
