// Field by field.
#include "session/film_of_scene.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "core/errors.h"
#include "film/splats.h"

namespace nephroid {

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

void check_film_fits(const FilmDescription& description, const FilmLayout& layout,
                     size_t splatted_parts, bool size_is_an_option) {
  // The sums; everything else comes on top.
  const auto bytes_per_pixel = static_cast<double>(
      Film::bytes_per_pixel(layout, description.gbuffer != GBufferSpace::kNone) +
      SplatBuffer::bytes_per_pixel(splatted_parts));
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
