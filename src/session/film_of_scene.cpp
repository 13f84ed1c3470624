#include "session/film_of_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.h"
#include "film/exr_file.h"
#include "input/file_bytes.h"
#include "input/scene_files.h"
#include "integrator/presets/estimator_table.h"
#include "session/report/short_number.h"

namespace nephroid {
namespace {

/// Bytes of all estimators of a render. They render one after another, so pass memory is not
/// summed.
PixelBytes bytes_of_estimators(const MemoryNeed& need) {
  PixelBytes all;
  for (const RouteGroup& group : need.routes.groups()) {
    const PixelBytes bytes =
        descriptor_of(group).bytes_per_pixel({.parts = group.parts.size(),
                                              .options = need.options,
                                              .samples_per_pixel = need.samples_per_pixel,
                                              .clamps = need.film.max_component < kInfinity});
    all.kept += bytes.kept;
    all.of_pass = std::max(all.of_pass, bytes.of_pass);
  }
  return all;
}

size_t bytes_of_rejection(const Routes& routes) {
  size_t bytes = 0;
  for (const RouteGroup& group : routes.groups())
    bytes += OutlierRejection::bytes_per_pixel(group.parts.size());
  return bytes;
}

bool keeps_photons(const Routes& routes) {
  return std::ranges::any_of(
      routes.groups(), [](const RouteGroup& group) { return descriptor_of(group).keeps_photons; });
}

/// Number of channels of a picture in memory (film_output.cpp).
size_t channels_of_picture(const FilmLayout& layout, bool gbuffer) {
  constexpr size_t kCommonChannels = 20, kGbufferChannels = 16;
  return 3 * (layout.routes.size() + layout.aovs.size()) + kCommonChannels +
         (gbuffer ? kGbufferChannels : 0);
}

}  // namespace

OutlierSettings outlier_settings(const Routes& routes, const IntegratorOptions& options,
                                 const PixelFilter& filter, int64_t pixels,
                                 const SceneSettings& of_scene) {
  OutlierSettings settings;
  settings.neighbours = of_scene.outlier_neighbours;
  for (const RouteGroup& group : routes.groups())
    settings.exposed_pixels.push_back(descriptor_of(group).exposed_pixels(options, filter, pixels));
  return settings;
}

void check_memory(const MemoryNeed& need, uint64_t limit, bool limit_is_an_option,
                  bool size_is_an_option) {
  const FilmDescription& film = need.film;
  const int width = film.crop_x1 - film.crop_x0, height = film.crop_y1 - film.crop_y0;
  const double pixels = static_cast<double>(width) * height;
  const bool gbuffer = film.gbuffer != GBufferSpace::kNone;
  // Counted twice: writing makes a copy of the held estimates.
  const size_t of_rejection = need.rejects_outliers ? bytes_of_rejection(need.routes) : 0;
  const size_t of_film = Film::bytes_per_pixel(need.layout, gbuffer);
  const PixelBytes of_estimators = bytes_of_estimators(need);
  const size_t channels = channels_of_picture(need.layout, gbuffer);
  constexpr size_t kPngBytes = 3;
  const uint64_t of_encoder = encoder_bytes(width, channels);
  const auto of_pixels = [&](size_t bytes) { return pixels * static_cast<double>(bytes); };
  const struct {
    const char* what;
    double bytes;
  } rows[] = {
      {"what is read already", static_cast<double>(need.held)},
      {"the film", of_pixels(of_film + of_rejection)},
      {"passes", of_pixels(of_estimators.kept + of_estimators.of_pass)},
      {"photons", keeps_photons(need.routes) ? static_cast<double>(need.options.memory_photons) *
                                                   static_cast<double>(kBytesPerPhoton)
                                             : 0.0},
      {"textures", static_cast<double>(need.textures)},
      {"writing the picture",
       need.writes ? of_pixels(kPngBytes + PixelSums::kSavedCarryBytesPerPixel + of_rejection) +
                         static_cast<double>(of_encoder)
                   : 0.0},
  };
  double total = 0;
  std::string list;
  for (const auto& row : rows) {
    total += row.bytes;
    if (row.bytes > 0)
      list += fmt::format("{}{} {}", list.empty() ? "" : ", ", short_bytes(row.bytes), row.what);
  }
  if (total <= static_cast<double>(limit)) return;
  const std::string message = fmt::format(
      "{:.0f} pixels ({} x {}) need about {} ({}), {} {}, expected {}a smaller "
      "resolution, a crop window or fewer routes and AOVs",
      pixels, width, height, short_bytes(total), list,
      limit_is_an_option ? "the limit is" : "this machine has",
      short_bytes(static_cast<double>(limit)), limit_is_an_option ? "a higher one, " : "");
  if (limit_is_an_option) throw UsageError("--memory: " + message);
  if (size_is_an_option) throw UsageError("--resolution: " + message);
  throw SceneError(film.where, message);
}

std::string default_output(const FilmDescription& film, const std::string& scene_file) {
  std::filesystem::path stem = std::filesystem::path(film.filename).stem();
  if (stem.empty()) {
    const bool is_file = scene_file != kStandardInput && !is_stream(scene_file);
    stem = is_file ? std::filesystem::path(scene_file).filename() : "nephroid";
    if (stem.extension() == ".gz") stem = stem.stem();
    stem = stem.stem();
  }
  return stem.string() + ".exr";
}

}  // namespace nephroid
