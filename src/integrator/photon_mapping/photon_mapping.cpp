#include "integrator/photon_mapping/photon_mapping.h"

#include "integrator/estimator/path_tally.h"
#include "integrator/estimator/pixel_pass.h"
#include "integrator/learning/guiding_options.h"
#include "integrator/learning/photon_guiding.h"
#include "integrator/photons/merge_pass.h"
#include "integrator/photons/merge_radius.h"
#include "integrator/photons/missing_caustics.h"
#include "transport/path_points.h"

namespace nephroid {

namespace {

constexpr const EstimatorSetting* kPhotonMappingSettings[] = {&kGuideSetting};
constexpr uint64_t kPixelStream = 0x706978656c;  // "pixel"

}  // namespace

constinit const EstimatorDescriptor PhotonMapping::kDescriptor = {
    .traits = {.name = "photons",
               .help = "photons merged with a radius that shrinks from pass to pass",
               .merges = true,
               .starts_at_lights = true},
    .settings = kPhotonMappingSettings,
    .merges_with_radius = true,
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.of_pass = MergePass::bytes_per_pixel(need.parts)};
        },
    .exposed_pixels = pixels_of_merging,
    .make = make_estimator<PhotonMapping>,
};

PhotonMapping::PhotonMapping(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options), photons_can_count_(photons_can_count(owned_)) {}

std::shared_ptr<const Learned> PhotonMapping::learn(const Scene& scene, const FilmFormat& film,
                                                    uint64_t seed, PassControl& control) const {
  return std::make_shared<LearnedPhotons>(
      guide_photons(seed, scene, film, owned_, options_, true, control));
}

std::shared_ptr<const Learned> PhotonMapping::read_learned(ByteReader& from,
                                                           const FilmFormat&) const {
  GuidedPhotons photons;
  from(photons);
  expect_sound(photons.guide.starts.fits(owned_.symbols->lights()));
  return std::make_shared<LearnedPhotons>(std::move(photons));
}

void PhotonMapping::render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                                Film& film, PassControl& control) {
  const int group = static_cast<int>(owned_.group);
  if (!photons_can_count_) {
    film.add_estimates(group, 1);
    return;
  }
  const PhotonGuide& guide = static_cast<const LearnedPhotons*>(learned)->guide();
  const MergePass pass = merge_pass(
      key, scene, film, owned_, options_, guide,
      radius_of_pass(options_, film.format().picture_pixels(), key.pass), {}, statistics_, control);
  const PixelBounds& b = film.bounds();
  const size_t parts = film.parts_of(group).size();
  const Rgb* estimate = pass.values.data();
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x, estimate += parts) film.add(group, x, y, {estimate, parts});
  film.add_bias(group, pass.bias);
  film.add_estimates(group, 1);
  found_ += pass.found;
}

void PhotonMapping::record_pixel(const PixelPass& pixel, const Learned* learned,
                                 PathTally& tally) const {
  if (!photons_can_count_) return;
  const Scene& scene = pixel.scene;
  PhotonPass pass = start_photon_pass(pixel.key, scene, pixel.film, options_);
  const int64_t paths = std::min(pass.trace.photons_per_pass, pixel.light_paths);
  pass.trace.photons_per_pass = paths;
  pass.trace.guide = &static_cast<const LearnedPhotons*>(learned)->guide();
  PhotonHistories photons(
      paths,
      [&](int64_t j, std::vector<Photon>& into) {
        trace_photons_of_path(scene, owned_, pass.trace, j, into);
      },
      [&](int64_t j) { return record_photon_path(scene, owned_, pass.trace, j); });
  tally.use(photons);
  const float radius_pixels =
      radius_of_pass(options_, pixel.film.picture_pixels(), pixel.radius_pass);
  PartSums sums(*owned_.routes, owned_.group);
  auto merge = [&](const Walk& walk, MergePoint at) {
    const float r = radius_pixels * pass.footprint.width(walk.length);
    if (!(r > 0.0f)) return;
    at.throughput = at.throughput / (static_cast<float>(paths) * kPi * r * r);
    merge_photons(photons.maps().surfaces(), owned_, at, options_.max_depth, r, sums, &tally);
  };
  for (int k = 0; k < pixel.camera_paths; ++k) {
    const SobolPoint point =
        eye_point(pixel.key.pass * static_cast<uint32_t>(pixel.camera_paths) + k);
    PathSampler sampler(point, hash_combine(pixel.key.seed, kPixelStream, pixel.x, pixel.y));
    CameraPath path = start_merging_path(scene, pixel.x, pixel.y, sampler, pass, k);
    tally.begin(path.walk.ray.o);
    RecordingVisitor visitor(MergeWalkVisitor(owned_, merge), tally.walk);
    if (path.camera_weight > 0)
      random_walk(scene, TransportMode::kRadiance, options_.max_depth, path.walk, sampler, visitor);
    tally.end(pass.weights, path.camera_weight, pixel.film.settings().max_component,
              path.filter_weight / static_cast<float>(pixel.camera_paths));
    sums.clear();
  }
}

EstimatorStatistics PhotonMapping::statistics() const {
  EstimatorStatistics s = statistics_;
  explain_darkness(owned_, found_, s);
  return s;
}

}  // namespace nephroid
