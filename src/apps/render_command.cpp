// `nephroid render`: runs session/render.h with output on a terminal.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "apps/commands.h"
#include "apps/frame_stream.h"
#include "apps/messages.h"
#include "apps/progress_display.h"
#include "apps/render_report.h"
#include "apps/render_request.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/film_layers.h"
#include "film/film_output.h"
#include "session/film_of_scene.h"
#include "session/process_memory.h"
#include "session/render.h"

namespace nephroid {
namespace {

constexpr int kSignalStatus = 128;

/// With --quiet, only warnings about the output file are printed. With --stream, all are frames.
RenderWarnings warnings_of(const RenderCommand& command, ProgressDisplay& display,
                           FrameStream& stream) {
  RenderWarnings warnings;
  if (!command.stream.empty()) {
    warnings.input = warnings.output = [&stream](const std::string& warning) {
      stream.message("warning", warning);
    };
    return warnings;
  }
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

/// Throws UsageError for a layer that the film does not have.
void check_layers(const std::vector<std::string>& names, const Film& film) {
  const std::vector<FilmLayer> layers = film_layers(film);
  const auto known_name = [](const FilmLayer& layer) { return layer.name; };
  std::vector<std::string> known;
  std::ranges::transform(layers, std::back_inserter(known), known_name);
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      throw UsageError(fmt::format("--stream: there is no layer '{}', expected some of: {}", name,
                                   fmt::join(known, ", ")));
}

/// Connects a render with its parent process.
void connect(Render& render, const RenderCommand& command, FrameStream& stream) {
  check_layers(command.stream, render.film());
  for (const std::string& note : render.notes()) stream.message("note", note);
  render.on_progress([&stream](const RenderProgress& progress) { stream.progress(progress); });
  render.on_picture([&](const ShownPicture& shown) { stream.picture(shown, command.stream); });
}

/// Connects a render with the terminal.
void connect(Render& render, ProgressDisplay& display) {
  // Printed before the first ray, so that the user need not wait for them.
  print_notes(render.notes());
  render.on_progress([&display](const RenderProgress& progress) { display.show(progress); });
}

int render_with(const RenderCommand& command, SignalListener& signals, FrameStream& stream) {
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
  const bool is_streamed = !command.stream.empty();
  if (command.output.empty() && !is_streamed)
    request.options.output = default_output(loaded.scene->film, command.scene);

  ProgressDisplay display;
  Render render(request, loaded, warnings_of(command, display, stream));
  if (is_streamed)
    connect(render, command, stream);
  else if (!command.quiet)
    connect(render, display);
  signals.note_stops(!command.quiet && !is_streamed);
  const RenderResult result = render.run(signals.flags());
  const std::string& output = request.options.output;
  if (is_streamed) {
    stream.end(result, render_report(result, render.film(), output));
  } else if (!command.quiet) {
    display.clear();
    say(render_report(result, render.film(), output));
  }
  return exit_status(command, result);
}

}  // namespace

int run_render(const RenderCommand& command) {
  // If SIGUSR1 comes while the scene is read, the picture is written after the first pass.
  SignalListener signals;
  FrameStream stream(STDOUT_FILENO, signals.flags());
  try {
    return render_with(command, signals, stream);
  } catch (const Error& error) {
    if (!command.stream.empty()) stream.message("error", error.what());
    throw;
  }
}

}  // namespace nephroid
