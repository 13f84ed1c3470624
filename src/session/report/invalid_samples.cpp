#include "session/report/invalid_samples.h"

#include <fmt/format.h>

#include "core/counted.h"
#include "scene/camera/camera.h"

namespace nephroid {
namespace {

/// The material and point that the ray through the middle of a pixel hits first.
std::string seen_at(const Scene& scene, int x, int y) {
  const auto ray = scene.camera->generate_ray(
      {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, {0.5f, 0.5f}, 0.5f);
  SurfaceInteraction hit;
  if (!ray || !scene.intersect(ray->ray, hit)) return "nothing";
  return fmt::format("material {} at ({:.4g} {:.4g} {:.4g})", scene.material_labels[hit.material],
                     hit.p.x, hit.p.y, hit.p.z);
}

std::vector<std::string> report(const Scene* scene, const Film& film) {
  std::vector<std::string> lines;
  const FilmLayout& layout = film.layout();
  for (size_t r = 0; r < layout.routes.size(); ++r) {
    const BadEstimates& bad = film.bad_estimates(static_cast<int>(r));
    if (bad.count == 0) continue;
    const std::string were = in_number(bad.count, "was", "were");
    std::string line = fmt::format("{} of route {} {} not finite and {} left out",
                                   counted(bad.count, "estimate"), layout.routes[r], were, were);
    const PixelBounds& crop = film.bounds();
    // Out of range if there is none, or if it comes from a wrong file.
    if (bad.first_pixel < static_cast<uint64_t>(crop.area())) {
      const uint64_t width = crop.width();
      const int x = crop.x0 + static_cast<int>(bad.first_pixel % width);
      const int y = crop.y0 + static_cast<int>(bad.first_pixel / width);
      line += fmt::format("; first at pixel {},{}", x, y);
      if (scene != nullptr) line += ", where the camera sees " + seen_at(*scene, x, y);
    }
    lines.push_back(line);
  }
  if (film.saturated_values() > 0)
    lines.push_back(
        fmt::format("{} (light, features or error estimates) reached the limit of a sum or {} not "
                    "finite",
                    counted(film.saturated_values(), "pixel value"),
                    in_number(film.saturated_values(), "was", "were")));
  return lines;
}

}  // namespace

std::vector<std::string> invalid_samples(const Scene& scene, const Film& film) {
  return report(&scene, film);
}
std::vector<std::string> invalid_samples(const Film& film) {
  return report(nullptr, film);
}

}  // namespace nephroid
