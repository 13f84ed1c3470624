// A pipe that is ready takes PIPE_BUF bytes without blocking (POSIX), so pieces of that size never
// make a signal wait for a reader that does not read.
#include "apps/frame_stream.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "apps/messages.h"
#include "film/film_layers.h"

namespace nephroid {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "frames are little endian");

constexpr int kPollMilliseconds = 50;

/// The first bytes of a frame.
struct Prefix {
  char magic[4] = {'N', 'P', 'H', 'F'};
  uint32_t version = 1;
  uint64_t header_bytes = 0;
  uint64_t payload_bytes = 0;
};
static_assert(sizeof(Prefix) == 24);

const char* reason_name(StopReason reason) {
  switch (reason) {
    case StopReason::kPasses:
      return "passes";
    case StopReason::kTime:
      return "time";
    case StopReason::kNoise:
      return "noise";
    case StopReason::kSignal:
      break;
  }
  return "signal";
}

/// Texts may quote any file, and JSON holds UTF-8 only.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void FrameStream::picture(const ShownPicture& shown, const std::vector<std::string>& names) {
  const std::vector<FilmLayer> layers = film_layers(shown.film, names);
  const PixelBounds& window = shown.film.bounds();
  Json header{{"kind", "picture"},
              {"width", shown.film.settings().width},
              {"height", shown.film.settings().height},
              {"window", {window.x0, window.y0, window.x1, window.y1}},
              {"type", "float32"},
              {"seconds", shown.seconds},
              {"passes", shown.passes},
              {"last", shown.is_last},
              {"layers", Json::array()}};
  std::vector<float> values;
  for (const FilmLayer& layer : layers) {
    header["layers"].push_back({{"name", layer.name}, {"channels", layer.channels}});
    const std::vector<float> pixels = layer_pixels(shown.film, layer);
    values.insert(values.end(), pixels.begin(), pixels.end());
  }
  write_frame(text_of(header), std::as_bytes(std::span(values)));
}

void FrameStream::progress(const RenderProgress& progress) {
  Json header{{"kind", "progress"},
              {"seconds", progress.seconds},
              {"passes", progress.passes_done},
              {"fraction", progress.fraction}};
  if (progress.passes_wanted) header["passes_wanted"] = *progress.passes_wanted;
  if (progress.seconds_left) header["seconds_left"] = *progress.seconds_left;
  if (progress.error) header["error"] = *progress.error;
  write_frame(text_of(header));
}

void FrameStream::message(const std::string& kind, const std::string& text) {
  write_frame(text_of({{"kind", kind}, {"text", printable(text)}}));
}

void FrameStream::end(const RenderResult& result, const std::string& report) {
  Json header{{"kind", "end"},
              {"reason", reason_name(result.reason)},
              {"seconds", result.seconds},
              {"passes", result.passes_done},
              {"report", printable(report)}};
  if (result.error) header["error"] = *result.error;
  write_frame(text_of(header));
}

bool FrameStream::write_frame(const std::string& header, std::span<const std::byte> payload) {
  Prefix prefix;
  prefix.header_bytes = header.size();
  prefix.payload_bytes = payload.size();
  return write_all(std::as_bytes(std::span(&prefix, 1))) &&
         write_all(std::as_bytes(std::span(header))) && write_all(payload);
}

bool FrameStream::write_all(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    if (signals_.stop.load() != 0) return false;
    pollfd ready{descriptor_, POLLOUT, 0};
    if (::poll(&ready, 1, kPollMilliseconds) <= 0) continue;
    const ssize_t written =
        ::write(descriptor_, bytes.data(), std::min<size_t>(bytes.size(), PIPE_BUF));
    if (written > 0) {
      bytes = bytes.subspan(static_cast<size_t>(written));
    } else if (errno != EINTR && errno != EAGAIN) {
      signals_.stop.store(SIGPIPE);
    }
  }
  return true;
}

}  // namespace nephroid
