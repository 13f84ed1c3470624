// `nephroid view`: serves a page that shows a scene while it renders.
#include <fmt/format.h>
#include <spawn.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "apps/commands.h"
#include "apps/messages.h"
#include "apps/render_request.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/image_io.h"
#include "film/state_file.h"
#include "session/checkpoint/picture_description.h"
#include "session/film_of_scene.h"
#include "view/live_render.h"
#include "view/picture_source.h"
#include "view/server.h"
#include "view/watched_files.h"

extern char** environ;  // NOLINT: POSIX has no header for it

namespace nephroid {
namespace {

constexpr std::chrono::milliseconds kPoll{50};
constexpr int kPollsPerLook = 20;  ///< between two looks at the scene's files

/// Opens the page in the user's browser, if there is a screen.
void open_browser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open", argument = url;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 01, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 01, 0);
  pid_t child = 0;
  if (posix_spawnp(&child, "xdg-open", &actions, nullptr, arguments, environ) != 0)
    say("there is no xdg-open: open the address yourself\n");
  posix_spawn_file_actions_destroy(&actions);
}

void add_comparisons(const std::vector<std::string>& paths, Comparisons& comparisons) {
  for (const std::string& path : paths)
    comparisons.add_file(color_picture(read_picture(path)),
                         std::filesystem::path(path).filename().string());
}

/// Throws IoError unless it is a directory.
void check_directory(const std::string& path) {
  if (!path.empty() && !std::filesystem::is_directory(path))
    throw IoError(path + ": is not a directory, expected one for --save-to");
}

/// Waits for a signal; the scene is read again when its files change.
void wait_for_end(LiveRender* live, const SignalFlags& signals) {
  WatchedFiles watched;
  for (int poll = 0; signals.stop.load() == 0; ++poll) {
    std::this_thread::sleep_for(kPoll);
    if (live != nullptr && poll % kPollsPerLook == 0 && watched.have_changed(live->files()))
      live->reload();
  }
}

/// Writes the picture, and its state if `render --resume` or another view can go on from it: not
/// with a camera that the scene's file does not have.
void leave_checkpoint(LiveRender& live, const std::string& output) {
  try {
    live.at_rest([&](const RenderAtRest& rest) {
      if (rest.is_preview || !rest.render.film().can_be_shown()) return;
      rest.render.save(output, rest.has_own_camera);
      say(rest.has_own_camera
              ? fmt::format("wrote {} and {}, with which --resume goes on\n", output,
                            state_path_beside(output))
              : fmt::format("wrote {}; its camera is not the scene's, so it cannot be resumed\n",
                            output));
    });
  } catch (const UsageError&) {
    // Nothing was rendered.
  }
}

int serve(ViewSource& source, const ViewCommand& command, SignalListener& signals) {
  Comparisons comparisons;
  add_comparisons(command.comparisons, comparisons);
  ViewServer server(source, comparisons, {command.address, command.port, command.save_directory});
  if (command.address != "127.0.0.1" && command.address != "::1")
    print_warning(fmt::format(
        "--listen {}: whoever can reach this address and knows the token sees the scene; nothing "
        "is encrypted",
        command.address));
  signals.note_stops(false);
  say(fmt::format("{}\n", server.url()));
  if (command.opens_browser) open_browser(server.url());
  wait_for_end(source.live(), signals.flags());
  return 0;
}

}  // namespace

int run_view(const ViewCommand& command, const RenderCommand& render) {
  SignalListener signals;
  const ThreadLimit threads(render.threads);
  limit_image_threads(render.threads);
  check_directory(command.save_directory);
  if (is_picture(render.scene)) {
    PictureSource picture(render.scene);
    return serve(picture, command, signals);
  }
  RenderRequest request = request_of(render);
  const std::string output = render.output;
  if (!output.empty()) check_picture_can_be_written(output);
  LiveRender live(std::move(request));
  const int status = serve(live, command, signals);
  if (!output.empty()) leave_checkpoint(live, output);
  return status;
}

}  // namespace nephroid
