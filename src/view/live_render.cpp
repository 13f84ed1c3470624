#include "view/live_render.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <csignal>

#include "core/errors.h"
#include "input/scene_files.h"
#include "integrator/presets/integrator_table.h"
#include "integrator/presets/route_presets.h"
#include "scene/scene_view.h"
#include "view/describe_render.h"
#include "view/thread_priority.h"

namespace nephroid {
namespace {

/// Without a stop rule a view renders until it is closed.
constexpr uint32_t kEndlessPasses = 1u << 30;
constexpr double kLongestWaitForRest = 20;  ///< seconds
/// While the camera moves, the resolution is such that the first picture takes about so long.
constexpr double kPreviewSeconds = 0.035;
constexpr double kFirstPreviewEdge = 256, kMinPreviewEdge = 96;  ///< pixels of the longer side

double steady_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

ExitStatus status_of(const std::exception& error) {
  const auto* own = dynamic_cast<const Error*>(&error);
  return own != nullptr ? own->status() : ExitStatus::kRender;
}

std::chrono::duration<double> seconds(double value) {
  return std::chrono::duration<double>(value);
}

/// The request of an edit: endless unless a rule was given.
RenderRequest request_of(const RenderRequest& request) {
  RenderRequest result = request;
  RenderOptions& options = result.options;
  result.resume_from = options.output;
  options.output.clear();
  if (!options.last_pass && !(options.time_limit > 0) && !(options.noise_target > 0))
    options.last_pass = kEndlessPasses;
  return result;
}

/// A quick, coarse version of a request.
RenderRequest preview_of(const RenderRequest& request, const FilmDescription& full, double edge) {
  RenderRequest preview = request_of(request);
  const double scale = std::min(1.0, edge / std::max(full.width, full.height));
  preview.overrides.width = std::max(1, static_cast<int>(std::lround(full.width * scale)));
  preview.overrides.height = std::max(1, static_cast<int>(std::lround(full.height * scale)));
  // The crop of the full picture, whichever way it was given.
  preview.overrides.has_crop = true;
  const int crop[4] = {full.crop_x0, full.crop_x1, full.crop_y0, full.crop_y1};
  for (int i = 0; i < 4; ++i) {
    const int full_edge = i < 2 ? full.width : full.height;
    const int edge_now = i < 2 ? preview.overrides.width : preview.overrides.height;
    const double at = 1.0 * crop[i] / full_edge * edge_now;
    // Rounded outwards, so at least one pixel is left.
    const double pixel = i % 2 == 0 ? std::floor(at) : std::ceil(at);
    preview.overrides.crop[i] = static_cast<float>(pixel / edge_now);
  }
  preview.routes = {};
  preview.routes.integrator = "path";
  preview.reject_outliers = false;
  preview.options.show_error = false;
  preview.options.time_limit = preview.options.noise_target = 0;
  preview.options.last_pass = kEndlessPasses;
  return preview;
}

}  // namespace

LiveRender::LiveRender(RenderRequest request) : preview_edge_(kFirstPreviewEdge) {
  state_.name = request.scene;
  edits_.request = std::move(request);
  state_.generation = edits_.generation;
  files_ = {state_.name};
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
  changed_.wait_for(lock, seconds(longest), [&] { return news_ != seen || is_ending_; });
  return news_;
}

bool LiveRender::is_edited() const {
  const std::lock_guard lock(mutex_);
  return edits_.is_edited;
}

std::vector<std::string> LiveRender::files() const {
  const std::lock_guard lock(mutex_);
  return files_;
}

uint64_t LiveRender::note_edit() {
  is_paused_ = false;
  signals_.stop = SIGINT;
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
  return note_edit();
}

uint64_t LiveRender::change(const RenderChange& change) {
  if (change.integrator) plan_of_integrator(*change.integrator);  // throws for an unknown name
  // On the command line it may be a file, too; the page cannot ask for files.
  if (change.routes && !change.routes->empty() && !route_preset(*change.routes))
    throw UsageError("routes: '" + *change.routes + "' is not a preset");
  const std::lock_guard lock(mutex_);
  if (change.begins_anew()) {
    apply(change, &edits_.request);
    edits_.is_edited = edits_.is_edited || change.action != RenderAction::kRestart;
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
  edits_.is_moving = false;
  note_edit();
}

void LiveRender::at_rest(std::function<void(const RenderAtRest&)> run) {
  if (state().status == LiveStatus::kLoading) throw UsageError("the scene is being read");
  const auto ticket = tasks_.add(std::move(run));
  {
    const std::lock_guard lock(mutex_);
    signals_.write = true;
  }
  changed_.notify_all();
  ticket->wait(kLongestWaitForRest);
}

std::optional<std::string> LiveRender::frame(const std::vector<std::string>& layers,
                                             uint64_t generation, uint64_t since) {
  if (frames_.version() == 0) return std::nullopt;
  if (!frames_.want(layers, steady_seconds()) && state().status != LiveStatus::kFailed)
    at_rest([&](const RenderAtRest& rest) {
      const bool has_pixels = rest.render.film().can_be_shown();
      frames_.add(has_pixels ? &rest.render.film() : nullptr, rest.generation, layers);
    });
  return frames_.frame(layers, generation, since);
}

Vec2i LiveRender::pixel_of_render(const RenderAtRest& rest, int x, int y) const {
  const LiveSettings full = state().settings;
  const FilmSettings& film = rest.render.film().settings();
  return {static_cast<int>(int64_t{x} * film.width / std::max(1, full.width)),
          static_cast<int>(int64_t{y} * film.height / std::max(1, full.height))};
}

ProbedPixel LiveRender::probe(int x, int y) {
  ProbedPixel probed;
  at_rest([&](const RenderAtRest& rest) {
    const Film& film = rest.render.film();
    const Vec2i pixel = pixel_of_render(rest, x, y);
    check_pixel(pixel.x, pixel.y, film.bounds());
    probed.value = film.value(pixel.x, pixel.y);
    probed.standard_error = film.standard_error(pixel.x, pixel.y);
    probed.samples = film.samples(pixel.x, pixel.y);
  });
  return probed;
}

Picture LiveRender::colors(const LayerGains& gains) {
  Picture picture;
  with_picture(
      [&](const RenderAtRest& rest) { picture = mixed_colors(rest.render.film(), gains); });
  return picture;
}

void LiveRender::write(const std::string& exr_path) {
  with_picture([&](const RenderAtRest& rest) { rest.render.save(exr_path, false); });
}

void LiveRender::with_picture(std::function<void(const RenderAtRest&)> task) {
  at_rest([&task](const RenderAtRest& rest) {
    if (rest.is_preview) throw UsageError("the camera is moving, wait for the full picture");
    if (!rest.render.film().can_be_shown())
      throw UsageError("there is no picture yet, try again in a moment");
    task(rest);
  });
}

void LiveRender::publish(const std::function<void(LiveState&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(state_);
    ++news_;
  }
  changed_.notify_all();
}

LiveRender::Edits LiveRender::take_edits() {
  const std::lock_guard lock(mutex_);
  signals_.stop = is_ending_ ? SIGINT : 0;
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
    const Edits edits = take_edits();
    try {
      if (edits.reloads || !loaded_) load(edits);
      render(edits);
    } catch (const std::exception& error) {
      publish([&](LiveState& state) {
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

void LiveRender::load(const Edits& edits) {
  publish([](LiveState& state) {
    state.status = LiveStatus::kLoading;
    state.message.clear();
  });
  loaded_.reset();
  loaded_ = load_scene(edits.request);
  const SceneDescription& description = loaded_->description;
  own_camera_ = description.camera;
  const std::lock_guard lock(mutex_);
  if (!edits_.camera) state_.camera = camera_pose(description, *loaded_->scene);
  camera_scene_.camera = description.camera;
  camera_scene_.film = description.film;
  is_loaded_ = true;
  files_ = {edits.request.scene};
  const SceneFiles& files = *description.files;
  for (const std::string& name : files.names()) files_.push_back(files.path_of(name));
}

void LiveRender::render(const Edits& edits) {
  loaded_->description.camera = own_camera_;
  if (edits.camera) set_camera(&loaded_->description, *edits.camera);
  Diagnostics diagnostics;
  RenderRequest request = request_of(edits.request);
  renew_camera(*loaded_->scene, loaded_->description, scene_overrides(request), diagnostics);
  const FilmDescription full = loaded_->scene->film;
  if (edits.is_moving) {
    request = preview_of(edits.request, full, preview_edge_);
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
    state.status = LiveStatus::kRendering;
    state.message.clear();
    state.settings = settings_of(edits.request, render, *loaded_->scene, full);
    if (!edits.is_moving) state.warnings = texts;
  });
  connect(render, edits, std::max(kMinPreviewEdge, 1.0 * std::max(full.width, full.height)));
  const RenderResult result = render.run(signals_);
  const RenderAtRest rest{render, *loaded_, edits.generation, edits.is_moving, edits.is_edited};
  if (result.reason != StopReason::kSignal) {
    renew_report(render);
    publish([&](LiveState& state) {
      state.status = LiveStatus::kDone;
      state.message = stop_reason_text(result.reason);
    });
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
  publish([](LiveState& state) { state.status = LiveStatus::kPaused; });
  while (is_at_rest()) {
    tasks_.serve(rest);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !is_paused_ || must_stop() || !tasks_.empty(); });
  }
  paused_seconds_ += steady_seconds() - begin;
  publish([](LiveState& state) { state.status = LiveStatus::kRendering; });
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
