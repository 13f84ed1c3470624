#include "integrator/estimator/technique_counter.h"

#include <algorithm>
#include <cmath>

namespace nephroid {

namespace {

/// The first passes suffice, and later ones are not slowed down.
constexpr uint32_t kPassesOfTechniques = 8;

double total(const Rgb& color) {
  return static_cast<double>(color.r) + color.g + color.b;
}

}  // namespace

TechniqueCounter::TechniqueCounter(const FilmFormat& film, size_t group, uint32_t pass)
    : film_(film), group_(group) {
  if (pass < kPassesOfTechniques) parts_.resize(film.parts_of(static_cast<int>(group)).size());
}

TechniqueCounter::Row TechniqueCounter::start_row(PartSums& light) const {
  if (!parts_.empty()) light.tell_techniques_apart();
  return Row(parts_.size());
}

void TechniqueCounter::join(const Row& row, Row& into) {
  for (size_t i = 0; i < row.size(); ++i)
    for (size_t t = 0; t < kTechniqueCount; ++t) into[i][t] += row[i][t];
}

void TechniqueCounter::add_splats(std::span<const Splat> splats, double share) {
  if (parts_.empty()) return;
  const PixelBounds& b = film_.bounds();
  const auto within = [](float x, int begin, int end) {
    return x >= static_cast<float>(begin) && x < static_cast<float>(end);
  };
  for (const Splat& splat : splats)
    if (within(splat.film.x, b.x0, b.x1) && within(splat.film.y, b.y0, b.y1) &&
        std::isfinite(total(splat.value)))
      parts_[splat.part][static_cast<size_t>(Technique::kMeetCamera)] += share * total(splat.value);
}

void TechniqueCounter::add_to(std::vector<RouteTechniques>& all) const {
  if (parts_.empty()) return;
  const FilmLayout& layout = film_.layout();
  const std::vector<int>& parts = film_.parts_of(static_cast<int>(group_));
  for (size_t i = 0; i < parts.size(); ++i) {
    const std::string& route = layout.routes[layout.parts[parts[i]].route];
    auto it = std::find_if(all.begin(), all.end(),
                           [&](const RouteTechniques& r) { return r.route == route; });
    if (it == all.end()) it = all.insert(it, {route, {}});
    for (size_t t = 0; t < kTechniqueCount; ++t) it->light[t] += parts_[i][t];
  }
}

}  // namespace nephroid
