// Answers of a live render: it pauses between two chunks of pixels to give them.
#include <algorithm>

#include "core/errors.h"
#include "view/describe_render.h"
#include "view/live_render.h"
#include "view/live_requests.h"
#include "view/steady_seconds.h"

namespace nephroid {
namespace {

constexpr double kMaxWaitForRest = 20;  ///< seconds

}  // namespace

void LiveRender::at_rest(std::function<void(const RenderAtRest&)> run) {
  if (state().status == LiveStatus::kLoading) throw UsageError("the scene is being read");
  std::shared_ptr<RestTasks::Ticket> ticket;
  {
    // Once the task has begun, the render may end: only the ticket is touched after this lock.
    const std::lock_guard lock(mutex_);
    ticket = tasks_.add(std::move(run));
    signals_.write = true;
    changed_.notify_all();
  }
  ticket->wait(kMaxWaitForRest);
}

std::optional<std::string> LiveRender::frame(const std::vector<std::string>& names,
                                             uint64_t generation, uint64_t since) {
  if (frames_.version() == 0) return std::nullopt;
  // Others would be asked for at rest, and remembered as wanted.
  const std::vector<std::string> layers = known_layers(state().layers, names);
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

}  // namespace nephroid
