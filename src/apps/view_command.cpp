// `nephroid view`: serves a page that shows a scene while it renders.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>

#include "apps/commands.h"
#include "apps/messages.h"
#include "apps/render_request.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/image_io.h"
#include "session/checkpoint/checkpoint.h"
#include "session/checkpoint/picture_description.h"
#include "view/first_reading.h"
#include "view/live_render.h"
#include "view/picture_source.h"
#include "view/server.h"
#include "view/view_checkpoint.h"
#include "view/watched_files.h"

extern char** environ;  // NOLINT: POSIX has no header for it

namespace nephroid {
namespace {

constexpr std::chrono::milliseconds kPoll{50};
/// A camera that has not moved for so long has come to rest.
constexpr double kSecondsToSettle = 1;
constexpr int kPollsPerLook = 20;  ///< between two looks at the scene's files
/// A missing file is told before a browser opens; a large scene may take longer to read.
constexpr std::chrono::milliseconds kFirstLook{20};

/// Opens the page in the user's browser, if there is a screen. Ctrl-C does not reach the browser.
void open_browser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open", argument = url;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  pid_t child = 0;
  if (posix_spawnp(&child, "xdg-open", &actions, &attributes, arguments, environ) != 0)
    say("there is no xdg-open: open the address yourself\n");
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
}

void add_comparisons(const std::vector<std::string>& paths, Comparisons& comparisons) {
  for (const std::string& path : paths) {
    try {
      comparisons.add_file(color_picture(read_picture(path)),
                           std::filesystem::path(path).filename().string());
    } catch (const UsageError& error) {
      throw UsageError(path + ": " + error.what());
    }
  }
}

/// Throws IoError unless it is a directory.
void check_directory(const std::string& path) {
  if (!path.empty() && !std::filesystem::is_directory(path))
    throw IoError(path + ": is not a directory, expected one for --save-to");
}

/// Writes checkpoints of a view now and then, so that a killed one loses little.
class Checkpoints {
 public:
  Checkpoints(LiveRender* live, const std::string& output) : live_(live) {
    if (live != nullptr && !output.empty()) checkpoint_.emplace(output);
  }

  /// They take less than 2 % of the time. An edited view is written when the scene is read again,
  /// and at its end.
  void write_if_due() {
    if (!checkpoint_ || Clock::now() < next_ || live_->is_edited()) return;
    const Clock::time_point begin = Clock::now();
    write();
    const auto cost = Clock::now() - begin;
    next_ = Clock::now() + std::max<Clock::duration>(kInterval, kIdlePerWrite * cost);
  }

  /// Reading the scene again drops the picture.
  void write_before_reload() {
    if (checkpoint_) write();
  }

  /// False if the picture could not be written where it was wanted.
  bool write_last() {
    if (!checkpoint_) return true;
    wait_for_full_picture();
    try {
      say(checkpoint_->write_last(*live_) + "\n");
      return true;
    } catch (const IoError& error) {
      print_error(error.what());
      return false;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kInterval{60};
  static constexpr std::chrono::seconds kMaxWaitForPicture{5};
  static constexpr int kIdlePerWrite = 50;

  void write() {
    try {
      checkpoint_->write(*live_);
    } catch (const IoError& error) {
      print_warning(error.what());
    }
  }

  bool has_full_picture() {
    try {
      live_->with_picture([](const RenderAtRest&) {});
      return true;
    } catch (const UsageError&) {
      return false;
    }
  }

  /// The view may end while the camera moves.
  void wait_for_full_picture() {
    if (!live_->settle_camera(0)) return;
    const Clock::time_point end = Clock::now() + kMaxWaitForPicture;
    while (!has_full_picture() && Clock::now() < end) std::this_thread::sleep_for(kPoll);
  }

  LiveRender* live_;
  std::optional<ViewCheckpoint> checkpoint_;
  Clock::time_point next_ = Clock::now() + kInterval;
};

/// Says at the terminal why the scene cannot be read, once after each reading.
class FailureMessages {
 public:
  explicit FailureMessages(const LiveRender* live) : live_(live) {}

  /// Waits a moment for the end of the first reading.
  void wait_briefly() {
    const auto end = std::chrono::steady_clock::now() + kFirstLook;
    while (live_ != nullptr && live_->state().status == LiveStatus::kLoading &&
           std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    say_news();
  }

  /// Throws the error of the first reading if waiting cannot mend it.
  void say_news() {
    if (live_ == nullptr) return;
    const LiveState state = live_->state();
    if (state.status != LiveStatus::kFailed) return;
    const bool has_picture = state.version > 0;
    if (!has_picture && !can_be_mended(state.name, state.failure))
      throw Error(state.failure, state.message);
    // A reload counts as an edit.
    if (state.generation == said_generation_ && state.message == said_) return;
    said_generation_ = state.generation;
    said_ = state.message;
    print_error(said_);
    say("the view waits: it reads the scene again when its files change\n");
  }

 private:
  const LiveRender* live_;
  uint64_t said_generation_ = 0;
  std::string said_;
};

/// Waits for a signal; the scene is read again when its files change.
void wait_for_end(LiveRender* live, Checkpoints& checkpoints, FailureMessages& failures,
                  const SignalFlags& signals) {
  for (int poll = 0; signals.stop.load() == 0; ++poll) {
    std::this_thread::sleep_for(kPoll);
    failures.say_news();
    if (live == nullptr || poll % kPollsPerLook != 0) continue;
    live->settle_camera(kSecondsToSettle);
    if (have_changed(live->files())) {
      checkpoints.write_before_reload();
      live->reload();
    }
    checkpoints.write_if_due();
  }
}

int serve(ViewSource& source, const ViewCommand& command, const std::string& output,
          SignalListener& signals) {
  Comparisons comparisons;
  add_comparisons(command.comparisons, comparisons);
  ServerSettings settings{command.address, command.port, command.save_directory, {}};
  settings.on_new_url = [](const std::string& url) {
    say(fmt::format("for another browser: {}\n", url));
  };
  ViewServer server(source, comparisons, settings);
  if (command.address != "127.0.0.1" && command.address != "::1")
    print_warning(fmt::format(
        "--listen {}: whoever can reach this address and knows the token sees the scene; nothing "
        "is encrypted",
        command.address));
  FailureMessages failures(source.live());
  failures.wait_briefly();
  signals.note_stops(false);
  say(fmt::format("{}\n", server.url()));
  if (command.opens_browser) open_browser(server.url());
  Checkpoints checkpoints(source.live(), output);
  wait_for_end(source.live(), checkpoints, failures, signals.flags());
  // Reading a scene cannot be interrupted, and the picture before it was written.
  if (source.state().status == LiveStatus::kLoading) std::_Exit(0);
  const bool is_written = checkpoints.write_last();
  return static_cast<int>(is_written ? ExitStatus::kDone : ExitStatus::kInputOutput);
}

}  // namespace

int run_view(const ViewCommand& command, const RenderCommand& render) {
  SignalListener signals;
  const ThreadLimit threads(render.threads);
  limit_image_threads(render.threads);
  check_directory(command.save_directory);
  if (render.resume && render.output.empty())
    throw UsageError("--resume: expected --output, the picture to go on from");
  if (is_picture(render.scene)) {
    PictureSource picture(render.scene);
    return serve(picture, command, {}, signals);
  }
  if (!render.output.empty()) check_picture_can_be_written(render.output);
  LiveRender live(request_of(render));
  return serve(live, command, render.output, signals);
}

}  // namespace nephroid
