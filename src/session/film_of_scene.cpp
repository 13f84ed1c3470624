// Field by field.
#include "session/film_of_scene.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.h"
#include "film/splats.h"
#include "integrator/bidirectional.h"
#include "integrator/gather.h"
#include "integrator/merge_pass.h"
#include "integrator/pair_pass.h"
#include "integrator/path_and_photons.h"
#include "integrator/photon_map.h"
#include "integrator/ppm.h"
#include "integrator/sppm.h"

namespace nephroid {
namespace {

/// For each pixel: what estimators keep from pass to pass, and what the pass that needs most does;
/// they render one after another.
size_t bytes_of_estimators(const Routes& routes, int hit_points, bool clamps) {
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
      pass = PairPass::bytes_per_pixel(parts, 0, clamps ? 1 : 0);
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
  return kept + most;
}

size_t bytes_of_rejection(const Routes& routes) {
  size_t bytes = 0;
  for (const RouteGroup& group : routes.groups())
    bytes += OutlierRejection::bytes_per_pixel(group.parts.size());
  return bytes;
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

FilmSettings film_settings(const FilmDescription& description) {
  FilmSettings settings;
  settings.width = description.width;
  settings.height = description.height;
  settings.crop = {description.crop_x0, description.crop_y0, description.crop_x1,
                   description.crop_y1};
  settings.imaging_ratio = description.imaging_ratio;
  settings.max_component = description.max_component;
  settings.color_space = description.color_space;
  settings.filename = description.filename;
  settings.diagonal_mm = description.diagonal_mm;
  settings.white_balance = description.white_balance;
  settings.gbuffer = description.gbuffer != GBufferSpace::kNone;
  return settings;
}

OutlierSettings outlier_settings(const Routes& routes, const IntegratorOptions& options,
                                 const PixelFilter& filter) {
  OutlierSettings settings;
  settings.neighbours = options.outlier_neighbours;
  for (const RouteGroup& group : routes.groups())
    settings.exposed_pixels.push_back(exposed_pixels(group.estimator, options, filter));
  return settings;
}

void check_film_fits(const FilmDescription& description, const FilmLayout& layout,
                     const Routes& routes, bool size_is_an_option, bool rejects_outliers,
                     int hit_points) {
  // What there is of each pixel; everything else comes on top.
  const auto bytes_per_pixel = static_cast<double>(
      Film::bytes_per_pixel(layout, description.gbuffer != GBufferSpace::kNone) +
      bytes_of_estimators(routes, hit_points, description.max_component < kInfinity) +
      (rejects_outliers ? bytes_of_rejection(routes) : 0));
  constexpr double kGiB = 1 << 30;
  const double pixels = static_cast<double>(description.crop_x1 - description.crop_x0) *
                        (description.crop_y1 - description.crop_y0);
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  if (pixels * bytes_per_pixel <= memory) return;
  const char* remedy = layout.parts.size() > 2
                           ? "a smaller resolution, a crop window or fewer routes and AOVs"
                           : "a smaller resolution or a crop window";
  const std::string message = fmt::format(
      "{:.0f} pixels ({} x {}) need more than {:.0f} GiB of memory and this machine has {:.0f}, "
      "expected {}",
      pixels, description.crop_x1 - description.crop_x0, description.crop_y1 - description.crop_y0,
      pixels * bytes_per_pixel / kGiB, memory / kGiB, remedy);
  if (size_is_an_option) throw UsageError("--resolution: " + message);
  throw SceneError(description.where, message);
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
