#include "integrator/path/specular_chain_pass.h"

#include "core/parallel.h"
#include "transport/camera_path.h"

namespace nephroid {

namespace {

constexpr uint64_t kGlintStream = 0x676c696e74;  // "glint"

/// Σ value² / chance over (Σ value)²: the second moment of a walk that finds each light with its
/// chance, over the square of its mean.
double rarity(const std::vector<SpecularTree::Light>& found) {
  double sum = 0, squares = 0;
  for (const SpecularTree::Light& l : found) {
    const double value = l.value.average();
    sum += value;
    squares += value * value / l.chance;
  }
  return sum > 0 ? squares / (sum * sum) : 0;
}

}  // namespace

SpecularChainPass::Walker::Walker(const SpecularChainPass& pass)
    : light(*pass.owned.routes, pass.owned.group), lamps(pass.lamps, light) {
  if (pass.techniques) techniques = pass.techniques->start_row(light);
}

void SpecularChainPass::look(int x, int y, const Points& points, std::span<Rgb> values,
                             Walker& walker) const {
  const PixelBounds& b = film.bounds();
  const FilmSettings& settings = film.settings();
  PartSums& light = walker.light;
  const std::vector<SobolPoint>& of_pixel = points[walks.at(x, y)];
  const float share = 1.0f / static_cast<float>(of_pixel.size());
  for (const SobolPoint& point : of_pixel) {
    PathSampler sampler(point, hash_combine(seed, kGlintStream, b.x0 + x, b.y0 + y));
    sampler.start_dimension(dimensions::kWavelength);
    const SampledWavelengths lambda =
        SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
    sampler.start_dimension(dimensions::kTime);
    CameraPath path =
        start_camera_path(scene, b.x0 + x, b.y0 + y, sampler, lambda, sampler.get_1d());
    path.walk.specular_alpha = specular_alpha;
    path.walk.per_wavelength = true;
    light.clear();
    walker.found.clear();
    if (walker.recorder != nullptr) walker.recorder->begin(path.walk.ray.o);
    const uint64_t took =
        path.camera_weight > 0 ? tree.look(path.walk, sampler, walker.found, walker.recorder) : 0;
    walker.rays += took;
    for (const SpecularTree::Light& l : walker.found) l.add_to(light);
    double seen = 0;
    if (!walker.found.empty()) {
      const SensorWeights weights = sensor_weights(lambda, *settings.color_space,
                                                   settings.imaging_ratio, settings.white_balance);
      const std::span<const Rgb> colors =
          light.colors(weights, path.camera_weight, settings.max_component, path.filter_weight);
      const double factor = static_cast<double>(path.camera_weight) * path.filter_weight * share;
      light.add_techniques_to(walker.techniques, weights, factor);
      walker.lamps.take(weights, factor);
      if (walker.recorder != nullptr)
        walker.recorder->end(weights, path.camera_weight, settings.max_component,
                             path.filter_weight * share);
      for (size_t i = 0; i < values.size(); ++i) {
        values[i] = values[i] + colors[i] * share;
        seen += static_cast<double>(colors[i].r + colors[i].g + colors[i].b) / 3;
      }
    }
    if (measured) {
      measured->walks.add(x, y, seen, static_cast<double>(took));
      measured->choice.add(x, y, seen, 0, seen * seen * rarity(walker.found));
    }
  }
}

uint64_t SpecularChainPass::render(std::span<Rgb> values, const Points& points) const {
  const PixelBounds& b = film.bounds();
  const size_t parts = owned.routes->groups()[owned.group].parts.size();
  struct Row {
    uint64_t rays = 0;
    TechniqueCounter::Row techniques;
  };
  const auto look_along_row = [&](Row& row, int64_t y, int64_t) {
    Walker walker(*this);
    for (int x = 0; x < b.width(); ++x)
      look(x, static_cast<int>(y), points, values.subspan((y * b.width() + x) * parts, parts),
           walker);
    row = {walker.rays, std::move(walker.techniques)};
  };
  uint64_t all_rays = 0;
  ordered_reduce<Row>(control, b.height(), 1, look_along_row, [&](Row&& row) {
    all_rays += row.rays;
    if (techniques) techniques->add(row.techniques);
  });
  return all_rays;
}

}  // namespace nephroid
