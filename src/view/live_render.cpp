#include "view/live_render.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>

#include "core/errors.h"
#include "input/file_bytes.h"
#include "input/scene_files.h"
#include "integrator/presets/integrator_table.h"
#include "integrator/presets/route_presets.h"
#include "scene/scene_view.h"
#include "view/describe_render.h"
#include "view/live_requests.h"
#include "view/steady_seconds.h"
#include "view/thread_priority.h"

namespace nephroid {
namespace {

/// While the camera moves, the resolution is such that the first picture takes about so long.
constexpr double kPreviewSeconds = 0.035;
constexpr double kFirstPreviewEdge = 256, kMinPreviewEdge = 96;  ///< pixels of the longer side

/// True if the scene's camera can have this pose. Types differ in their parameters.
bool can_be_camera(SceneDescription trial, const CameraPose& pose) {
  try {
    set_camera(&trial, pose);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

ExitStatus status_of(const std::exception& error) {
  const auto* own = dynamic_cast<const Error*>(&error);
  return own != nullptr ? own->status() : ExitStatus::kRender;
}

}  // namespace

LiveRender::LiveRender(RenderRequest request) : preview_edge_(kFirstPreviewEdge) {
  state_.name = request.scene;
  edits_.request = std::move(request);
  state_.generation = edits_.generation;
  thread_ = std::thread([this] { work(); });
}

LiveRender::~LiveRender() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    signals_.stop = SIGINT;
  }
  changed_.notify_all();
  thread_.join();
}

LiveState LiveRender::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

uint64_t LiveRender::wait_for_news(uint64_t seen, double longest) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(longest),
                    [&] { return news_ != seen || is_ending_; });
  return news_;
}

bool LiveRender::is_edited() const {
  const std::lock_guard lock(mutex_);
  return edits_.is_edited;
}

FileStamps LiveRender::files() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

uint64_t LiveRender::note_edit() {
  is_paused_ = false;
  signals_.stop = SIGINT;
  // The status before was that of another generation.
  if (state_.status != LiveStatus::kLoading) state_.status = LiveStatus::kRendering;
  state_.message.clear();
  ++news_;
  changed_.notify_all();
  return state_.generation = ++edits_.generation;
}

uint64_t LiveRender::move_camera(const CameraChange& change) {
  const std::lock_guard lock(mutex_);
  if (!is_loaded_) throw UsageError("the scene is not loaded");
  CameraPose pose = change.applied_to(state_.camera);
  SceneDescription trial = camera_scene_;
  set_camera(&trial, pose);  // throws for a pose that is none
  state_.camera = pose;
  edits_.camera = std::move(pose);
  edits_.is_edited = true;
  edits_.is_moving = change.is_moving;
  edits_.moved_at = steady_seconds();
  return note_edit();
}

bool LiveRender::settle_camera(double seconds) {
  const std::lock_guard lock(mutex_);
  if (!edits_.is_moving || steady_seconds() - edits_.moved_at < seconds) return false;
  edits_.is_moving = false;
  note_edit();
  return true;
}

uint64_t LiveRender::change(const RenderChange& change) {
  if (change.integrator) plan_of_integrator(*change.integrator);  // throws for an unknown name
  // On the command line it may be a file, too; the page cannot ask for files.
  if (change.routes && !change.routes->empty() && !route_preset(*change.routes))
    throw UsageError("routes: '" + *change.routes + "' is not a preset");
  const std::lock_guard lock(mutex_);
  if (change.begins_anew()) {
    apply(change, &edits_.request);
    edits_.is_edited = edits_.is_edited || change.has_settings();
    edits_.is_moving = false;
    return note_edit();
  }
  if (change.action == RenderAction::kNone) throw UsageError("the request changes nothing");
  is_paused_ = change.action == RenderAction::kPause;
  signals_.write = true;
  changed_.notify_all();
  return state_.generation;
}

void LiveRender::reload() {
  const std::lock_guard lock(mutex_);
  edits_.reloads = true;
  files_.clear();
  edits_.is_moving = false;
  state_.status = LiveStatus::kLoading;
  note_edit();
}

void LiveRender::publish(const std::function<void(LiveState&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(state_);
    ++news_;
  }
  changed_.notify_all();
}

void LiveRender::publish_status(LiveStatus status, const std::string& message) {
  publish([&](LiveState& state) {
    if (must_stop()) return;
    state.status = status;
    state.message = message;
  });
}

LiveRender::Edits LiveRender::take_edits() {
  const std::lock_guard lock(mutex_);
  signals_.stop = is_ending_ ? SIGINT : 0;
  // The render before may have taken the request to pause.
  if (is_paused_) signals_.write = true;
  taken_generation_ = edits_.generation;
  Edits edits = edits_;
  edits_.reloads = false;
  return edits;
}

bool LiveRender::must_stop() const {
  return is_ending_ || edits_.generation != taken_generation_;
}

void LiveRender::work() {
  give_way_to_others();
  while (true) {
    Edits edits = take_edits();
    try {
      if (edits.reloads || !loaded_) load(edits);
      render(edits);
    } catch (const std::exception& error) {
      publish([&](LiveState& state) {
        if (must_stop()) return;
        state.status = LiveStatus::kFailed;
        state.message = error.what();
        state.failure = status_of(error);
      });
      refuse_tasks_until_edited(error.what());
    }
    const std::lock_guard lock(mutex_);
    if (is_ending_) break;
  }
  tasks_.refuse("the view is closed");
}

LoadedScene LiveRender::read_scene_of(const RenderRequest& request) {
  const std::string& name = request.scene;
  const bool can_be_read_again = name != kStandardInput && !is_stream(name);
  const std::shared_ptr<SceneFiles> files = files_of_scene(name);
  const auto watch_files = [&] {
    const std::lock_guard lock(mutex_);
    if (can_be_read_again) files_ = files->stamps();
  };
  try {
    LoadedScene loaded = load_scene(request, files);
    watch_files();
    return loaded;
  } catch (...) {
    watch_files();
    throw;
  }
}

void LiveRender::load(Edits& edits) {
  publish([this](LiveState& state) {
    state.status = LiveStatus::kLoading;
    state.message.clear();
    files_.clear();
  });
  loaded_.reset();
  loaded_ = read_scene_of(edits.request);
  const SceneDescription& description = loaded_->description;
  own_camera_ = description.camera;
  const std::lock_guard lock(mutex_);
  camera_scene_.camera = description.camera;
  camera_scene_.film = description.film;
  is_loaded_ = true;
  if (edits_.camera && !can_be_camera(camera_scene_, *edits_.camera)) {
    edits_.camera.reset();
    edits.camera.reset();
  }
  if (!edits_.camera) state_.camera = camera_pose(description, *loaded_->scene);
}

void LiveRender::render(const Edits& edits) {
  loaded_->description.camera = own_camera_;
  if (edits.camera) set_camera(&loaded_->description, *edits.camera);
  Diagnostics diagnostics;
  RenderRequest request = full_request(edits.request);
  renew_camera(*loaded_->scene, loaded_->description, scene_overrides(request), diagnostics);
  const FilmDescription full = loaded_->scene->film;
  if (edits.is_moving) {
    request = preview_request(edits.request, full, preview_edge_);
    renew_camera(*loaded_->scene, loaded_->description, scene_overrides(request), diagnostics);
  }

  request.resume = request.resume && !has_rendered_ && !edits.is_edited;
  RenderWarnings warnings;
  std::vector<std::string> texts;
  warnings.input =
      warnings.output = [&texts](const std::string& warning) { texts.push_back(warning); };
  Render render(request, *loaded_, warnings);
  has_rendered_ = true;
  publish([&](LiveState& state) {
    describe(render, *loaded_, edits.is_moving, &state);
    const std::string integrator = state.settings.integrator;
    state.settings = settings_of(edits.request, render, *loaded_->scene, full);
    // Previews have an integrator of their own.
    if (edits.is_moving) state.settings.integrator = edits.request.routes.integrator_or(integrator);
    if (!edits.is_moving) state.warnings = texts;
  });
  publish_status(LiveStatus::kRendering);
  connect(render, edits, std::max(kMinPreviewEdge, 1.0 * std::max(full.width, full.height)));
  const RenderResult result = render.run(signals_);
  const RenderAtRest rest{render, *loaded_, edits.generation, edits.is_moving, edits.is_edited};
  if (result.reason != StopReason::kSignal) {
    renew_report(render);
    publish_status(LiveStatus::kDone, stop_reason_text(result.reason));
  }
  rest_until_edited(rest);
}

void LiveRender::connect(Render& render, const Edits& edits, double longest_edge) {
  paused_seconds_ = 0;
  render.use_clock([this] { return steady_seconds() - paused_seconds_; });
  const double begin = steady_seconds();
  bool is_first = true;
  render.on_picture(
      [this, &edits, is_first, begin, longest_edge](const ShownPicture& shown) mutable {
        if (is_first && edits.is_moving) {
          // The next preview takes about the wanted time.
          const double took = std::max(1e-3, steady_seconds() - begin);
          const double edge = preview_edge_ * std::sqrt(kPreviewSeconds / took);
          preview_edge_ = std::clamp(edge, std::max(kMinPreviewEdge, preview_edge_ / 2),
                                     std::min(preview_edge_ * 1.25, longest_edge));
        }
        is_first = false;
        FrameInfo info;
        info.generation = edits.generation;
        info.is_preview = edits.is_moving;
        info.seconds = shown.seconds;
        info.passes = shown.passes;
        const uint64_t version = frames_.update(shown.film, info, steady_seconds());
        publish([version](LiveState& state) { state.version = version; });
      });
  render.on_progress([this, &render, &edits](const RenderProgress& progress) {
    publish([&](LiveState& state) { state.progress = progress; });
    if (!edits.is_moving && !progress.within_pass && std::has_single_bit(progress.passes_done))
      renew_report(render);
  });
  render.on_request([this, &render, &edits] {
    const RenderAtRest rest{render, *loaded_, edits.generation, edits.is_moving, edits.is_edited};
    tasks_.serve(rest);
    rest_while_paused(rest);
  });
}

void LiveRender::renew_report(Render& render) {
  std::vector<std::string> lines = lines_of(render.report());
  publish([&lines](LiveState& state) { state.report = std::move(lines); });
}

void LiveRender::rest_while_paused(const RenderAtRest& rest) {
  const auto is_at_rest = [this] {
    const std::lock_guard lock(mutex_);
    return is_paused_ && !must_stop();
  };
  if (!is_at_rest()) return;
  const double begin = steady_seconds();
  publish_status(LiveStatus::kPaused);
  while (is_at_rest()) {
    tasks_.serve(rest);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !is_paused_ || must_stop() || !tasks_.empty(); });
  }
  paused_seconds_ += steady_seconds() - begin;
  publish_status(LiveStatus::kRendering);
}

void LiveRender::rest_until_edited(const RenderAtRest& rest) {
  while (true) {
    tasks_.serve(rest);
    std::unique_lock lock(mutex_);
    if (must_stop()) return;
    changed_.wait(lock, [this] { return must_stop() || !tasks_.empty(); });
  }
}

void LiveRender::refuse_tasks_until_edited(const std::string& why) {
  while (true) {
    tasks_.refuse(why);
    std::unique_lock lock(mutex_);
    if (must_stop()) return;
    changed_.wait(lock, [this] { return must_stop() || !tasks_.empty(); });
  }
}

}  // namespace nephroid
