#include "integrator/bidirectional/pair_sampler.h"

#include <cassert>
#include <cmath>

#include "integrator/estimator/features.h"
#include "integrator/path/path_options.h"

namespace nephroid {

namespace {

constexpr uint64_t kVcmEyeStream = 0x76636d65;  // "vcme"
constexpr uint64_t kPairStream = 0x76636d70;    // "vcmp"

/// Number of pixels: all of the film; without a film those of the first lattice.
size_t pixels_of(const FilmFormat& format, const Film* film) {
  return film != nullptr ? format.bounds().area() : PixelSlices(format.bounds()).first_pixels();
}

}  // namespace

PairSampler::PairSampler(const PairPass& pass, const FilmFormat& of_film, const CameraSide& side,
                         Film* to, std::vector<RadianceRecord>* all_records,
                         double records_per_path)
    : in(pass),
      techniques(pass.techniques),
      camera(side),
      format(of_film),
      film(to),
      counter(to != nullptr ? TechniqueCounter(of_film, pass.owned.group, pass.key.pass)
                            : TechniqueCounter(of_film)),
      lamps(*pass.owned.symbols, pass.key.pass, to != nullptr),
      photons(start_photon_pass(pass.key, pass.scene, of_film, pass.options, pass.control)),
      most(side.paths.most()),
      records(all_records, pixels_of(of_film, to) * most, records_per_path),
      tree(pass.scene, pass.owned, pass.options.max_depth),
      settings{.scene = pass.scene,
               .owned = pass.owned,
               .technique = pass.technique,
               .guide = pass.emission,
               .radiance = side.directions.guides() ? &side.directions : nullptr,
               .tree = techniques.separates_chains || techniques.follows_chains ||
                               pass.options.own<PathOptions>().specular_trees
                           ? &tree
                           : nullptr},
      view_(pass.scene, of_film.bounds()) {
  merging.rule = CasterRule(techniques.casters);
  assert(!techniques.connects || techniques.merges_all_light());
  merging.photons = static_cast<double>(techniques.light_paths);
  merging.radius_pixels = pass.radius_pixels;
  merging.photons_for_one = pass.photons_for_one;
  merging.corrects_edges = pass.corrects_edges;
  merging.footprint = photons.footprint;
  merging.eye = pass.scene.camera->camera_to_world(photons.trace.time).point(Vec3f(0, 0, 0));
  merging.connects = techniques.connects;
  merging.gathers_in_media = techniques.gathers_in_media;
  settings.view = pass.scene.camera->connects() && merging.connects ? &view_ : nullptr;
  settings.specular_alpha = photons.trace.specular_alpha;
  settings.max_depth = pass.options.max_depth;
  settings.light_paths = static_cast<double>(techniques.light_paths);
  settings.merging = &merging;
  parts = format.parts_of(static_cast<int>(pass.owned.group)).size();
  points_.resize(most);
  for (int n = 1; n <= static_cast<int>(most); ++n)
    if (camera.paths.has(n))
      for (int k = 0; k < n; ++k) points_[n - 1].push_back(sample_points(n, k));
}

PairSampler::Worker::Worker(const PairSampler& sampler, PairRow& of_row)
    : light(*sampler.in.owned.routes, sampler.in.owned.group),
      row(of_row),
      lamps(&sampler.lamps, light) {
  row.techniques = sampler.counter.start_row(light);
  if (sampler.film == nullptr) light.measure_photons(sampler.photons.weights);
}

uint32_t PairSampler::first_index(int n) const {
  return in.key.pass * n;
}

PairSampler::SamplePoints PairSampler::sample_points(int n, int k) const {
  const uint32_t index = first_index(n) + k;
  return {eye_point(index, kEyePathDimensions),
          techniques.connects ? light_point(index) : SobolPoint(index, 1)};
}

SpecularRoot::Leaves PairSampler::leaves_at(int x, int y) const {
  if (!techniques.separates_chains) return SpecularRoot::Leaves::kBranches;
  return camera.chains && camera.chains->at(x, y) == 0 ? SpecularRoot::Leaves::kNothing
                                                       : SpecularRoot::Leaves::kAll;
}

uint64_t PairSampler::seed_of(int x, int y, int k) const {
  const uint64_t of_pixel = hash_combine(in.seed, kVcmEyeStream, x, y);
  return in.independent_samples ? hash_combine(of_pixel, k) : of_pixel;
}

CameraPath PairSampler::start(int x, int y, int k, PathSampler& sampler) const {
  CameraPath path = start_merging_path(in.scene, x, y, sampler, photons, k);
  path.walk.roulette_threshold = techniques.roulette_threshold;
  return path;
}

void PairSampler::use(std::vector<Photon> photons_of_pass, float media_distance) {
  merging.media_distance = media_distance;
  maps_.emplace(std::move(photons_of_pass),
                [&](const Vec3f& p) { return merging.radius_in_media_at(p); });
  merging.merge(*maps_);
}

void PairSampler::forget_photons() {
  merging.forget_photons();
  maps_.reset();
}

void PairSampler::count_merged(int x, int y, int samples, int k, Worker& worker, uint32_t& merged) {
  PathSampler sampler(points_[samples - 1][k].eye, seed_of(x, y, k));
  CameraPath path = start(x, y, k, sampler);
  worker.light.clear();
  worker.row.rays += trace_eye_path(settings, worker.path, path, sampler, worker.light,
                                    {.merged = &merged, .counts_merged = true})
                         .rays;
}

PairSampler::SampleLight PairSampler::trace(int x, int y, int samples, int k, Worker& worker,
                                            const SampleSums& sums, uint32_t* merged) {
  const PixelBounds& b = format.bounds();
  const SamplePoints& points = points_[samples - 1][k];
  PairRow& row = worker.row;
  PartSums& light = worker.light;
  const uint64_t rays_before = row.rays;
  PathSampler sampler(points.eye, seed_of(x, y, k));
  CameraPath path = start(x, y, k, sampler);
  if (merging.connects && !settings.merges_only) {
    // A light path of its own: those that leave photons run through one sequence, of which a pixel
    // would see the same part in all passes.
    PathSampler own(points.light, hash_combine(in.seed, kPairStream, x, y));
    row.rays += trace_light_path(settings, path.walk.lambda, photons.u_time, own, &worker.path,
                                 nullptr, nullptr, kEyePathDimensions)
                    .rays;
  }
  light.clear();
  if (worker.recorder != nullptr) worker.recorder->begin(path.walk.ray.o);
  Features features;
  const bool sees = worker.sees && k == 0;
  const EyePathCounts counts =
      trace_eye_path(settings, worker.path, path, sampler, light,
                     {.features = sees ? &features : nullptr,
                      .records = records.of_path(pixel_of(x, y), k, row.records),
                      .leaves = leaves_at(x - b.x0, y - b.y0),
                      .merged = merged,
                      .recorder = worker.recorder});
  row.rays += counts.rays;
  row.probes += counts.probes;
  row.merged += counts.merged;
  if (sees) features.add_to(*film, x, y, in.scene, path, photons.weights);
  const float share = 1.0f / static_cast<float>(samples);
  sums.bias += light.bias(photons.weights) * path.camera_weight * path.filter_weight * share;
  const double factor = static_cast<double>(path.camera_weight) * path.filter_weight * share;
  light.add_techniques_to(row.techniques, photons.weights, factor);
  worker.lamps.take(photons.weights, factor);
  const float limit = sums.waits ? kInfinity : format.settings().max_component;
  const std::span<const Rgb> colors =
      light.colors(photons.weights, path.camera_weight, limit, path.filter_weight * share);
  if (worker.recorder != nullptr)
    worker.recorder->end(photons.weights, path.camera_weight, limit, path.filter_weight * share);
  for (size_t i = 0; i < parts; ++i) sums.values[i] = sums.values[i] + colors[i];
  if (!settings.merges_only) ++row.camera_paths;
  const double seen = total_of(colors);
  return {static_cast<float>(seen / (3.0 * share)),
          static_cast<float>(light.photon_squares() * sqr(factor / share)), row.rays - rays_before,
          counts.merged, std::abs(path.filter_weight) * share};
}

}  // namespace nephroid
