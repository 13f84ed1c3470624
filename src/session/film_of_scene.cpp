// Memory is added up by what takes it.
#include "session/film_of_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.h"
#include "film/exr_file.h"
#include "film/splats.h"
#include "integrator/bidirectional/bidirectional.h"
#include "integrator/bidirectional/pair_pass.h"
#include "integrator/mixed/path_and_photons.h"
#include "integrator/photon_mapping/photon_map.h"
#include "integrator/photon_mapping/ppm.h"
#include "integrator/photon_mapping/sppm.h"
#include "integrator/photons/gather.h"
#include "integrator/photons/merge_pass.h"
#include "session/report/short_number.h"

namespace nephroid {
namespace {

/// For each pixel.
struct BytesOfEstimators {
  size_t kept = 0;     ///< from pass to pass
  size_t of_pass = 0;  ///< of the one that needs most; they render one after another
};

BytesOfEstimators bytes_of_estimators(const Routes& routes, int hit_points, bool clamps) {
  size_t kept = 0, most = 0;
  for (const RouteGroup& group : routes.groups()) {
    const size_t parts = group.parts.size();
    const EstimatorType& type = estimator_type(group.estimator);
    const bool splats = type.connects || group.estimator == EstimatorKind::kMetropolis ||
                        group.estimator == EstimatorKind::kPrimarySpace;
    size_t pass = splats ? SplatBuffer::bytes_per_pixel(parts) : 0;
    if (group.estimator == EstimatorKind::kSppm) {
      kept += Sppm::bytes_kept(parts);
      pass += Sppm::bytes_of_pass(parts);
    } else if (group.estimator == EstimatorKind::kBidirectional) {
      pass = Bidirectional::bytes_per_pixel(parts);
    } else if (group.estimator == EstimatorKind::kVcm || group.estimator == EstimatorKind::kBpm) {
      pass = pair_pass_bytes_per_pixel(parts, 0, clamps ? 1 : 0);
    } else if (group.estimator == EstimatorKind::kPathAndPhotons) {
      pass = PathAndPhotons::bytes_per_pixel(parts, clamps);
    } else if (group.estimator == EstimatorKind::kPpm) {
      kept += static_cast<size_t>(hit_points) * Ppm::bytes_kept(parts);
      pass += static_cast<size_t>(hit_points) * Ppm::bytes_of_pass(parts);
    } else if (group.estimator == EstimatorKind::kPhotonMap) {
      pass += Gathered::bytes_per_walk(parts);
    } else if (type.merges) {
      pass += MergePass::bytes_per_pixel(parts);
    }
    most = std::max(most, pass);
  }
  return {kept, most};
}

size_t bytes_of_rejection(const Routes& routes) {
  size_t bytes = 0;
  for (const RouteGroup& group : routes.groups())
    bytes += OutlierRejection::bytes_per_pixel(group.parts.size());
  return bytes;
}

bool keeps_photons(const Routes& routes) {
  return std::ranges::any_of(routes.groups(), [](const RouteGroup& group) {
    return estimator_type(group.estimator).merges ||
           group.estimator == EstimatorKind::kPathAndPhotons ||
           group.estimator == EstimatorKind::kVcm || group.estimator == EstimatorKind::kBpm ||
           group.estimator == EstimatorKind::kForecast ||
           group.estimator == EstimatorKind::kPointLights;
  });
}

/// Of a picture in memory, see film_output.cpp.
size_t channels_of_picture(const FilmLayout& layout, bool gbuffer) {
  constexpr size_t kCommonChannels = 20, kGbufferChannels = 16;
  return 3 * (layout.routes.size() + layout.aovs.size()) + kCommonChannels +
         (gbuffer ? kGbufferChannels : 0);
}

/// a of [O2], the pixels that one light path exposes in a pass: a photon those within the first
/// merge radius, a splat those whose filter reaches it, a path from the eye its own.
float exposed_pixels(EstimatorKind kind, const IntegratorOptions& options,
                     const PixelFilter& filter) {
  const auto within = [](float radius) { return std::max(1.0f, kPi * sqr(radius)); };
  const float splatted = std::max(1.0f, 4 * filter.radius().x * filter.radius().y);
  switch (kind) {
    case EstimatorKind::kPhotons:
    case EstimatorKind::kBpm:
      return within(first_radius(options));
    case EstimatorKind::kSppm:
    case EstimatorKind::kPpm:
      return within(Sppm::first_radius(options));
    case EstimatorKind::kPhotonMap:
      return within(PhotonMap::largest_radius(options));
    case EstimatorKind::kPhotonsAndLight:
    case EstimatorKind::kPathAndPhotons:
    case EstimatorKind::kVcm:
      return std::max(within(first_radius(options)), splatted);
    case EstimatorKind::kLightTrace:
    case EstimatorKind::kBidirectional:
    case EstimatorKind::kMetropolis:
    case EstimatorKind::kPrimarySpace:
      return splatted;
    case EstimatorKind::kPath:
    case EstimatorKind::kPointLights:
    case EstimatorKind::kForecast:
      break;
  }
  return 1;
}

}  // namespace

OutlierSettings outlier_settings(const Routes& routes, const IntegratorOptions& options,
                                 const PixelFilter& filter, const SceneSettings& of_scene) {
  OutlierSettings settings;
  settings.neighbours = of_scene.outlier_neighbours;
  for (const RouteGroup& group : routes.groups())
    settings.exposed_pixels.push_back(exposed_pixels(group.estimator, options, filter));
  return settings;
}

void check_memory(const MemoryNeed& need, uint64_t limit, bool limit_is_an_option,
                  bool size_is_an_option) {
  const FilmDescription& film = need.film;
  const int width = film.crop_x1 - film.crop_x0, height = film.crop_y1 - film.crop_y0;
  const double pixels = static_cast<double>(width) * height;
  const bool gbuffer = film.gbuffer != GBufferSpace::kNone;
  // A copy of what is held is written.
  const size_t of_rejection = need.rejects_outliers ? bytes_of_rejection(need.routes) : 0;
  const size_t of_film = Film::bytes_per_pixel(need.layout, gbuffer);
  const BytesOfEstimators of_estimators =
      bytes_of_estimators(need.routes, need.hit_points, film.max_component < kInfinity);
  const size_t channels = channels_of_picture(need.layout, gbuffer);
  constexpr size_t kPngBytes = 3;
  const uint64_t of_encoder =
      encoder_bytes(width, channels, (of_film + of_estimators.kept) / sizeof(uint32_t));
  const auto of_pixels = [&](size_t bytes) { return pixels * static_cast<double>(bytes); };
  const struct {
    const char* what;
    double bytes;
  } rows[] = {
      {"what is read already", static_cast<double>(need.held)},
      {"the film", of_pixels(of_film + of_rejection)},
      {"passes", of_pixels(of_estimators.kept + of_estimators.of_pass)},
      {"photons", keeps_photons(need.routes)
                      ? static_cast<double>(need.photons) * double{kBytesPerPhoton}
                      : 0.0},
      {"textures", static_cast<double>(need.textures)},
      {"writing the picture", need.writes
                                  ? of_pixels(sizeof(float) * channels + kPngBytes + of_rejection) +
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
    stem = std::filesystem::path(scene_file).filename();
    if (stem.extension() == ".gz") stem = stem.stem();
    stem = stem.stem();
  }
  return stem.string() + ".exr";
}

}  // namespace nephroid
