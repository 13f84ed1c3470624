#include "integrator/photon_mapping/sppm.h"

#include <algorithm>
#include <cmath>

#include "integrator/estimator/exposed_pixels.h"
#include "integrator/photons/gather.h"
#include "integrator/photons/merge_radius.h"
#include "integrator/photons/missing_caustics.h"

namespace nephroid {

namespace {

constexpr uint64_t kSppmStream = 0x7370706d;  // "sppm"
constexpr float kDefaultSppmRadius = 2.0f;

}  // namespace

constinit const EstimatorDescriptor Sppm::kDescriptor = {
    .traits = {.name = "sppm",
               .help = "stochastic progressive photon mapping with a radius for each pixel",
               .merges = true,
               .starts_at_lights = true},
    .capabilities = {.independent_passes = false, .per_pixel_state = true},
    .keeps_photons = true,
    .bytes_per_pixel =
        [](const PixelMemoryInput& need) {
          return PixelBytes{.kept = bytes_kept(need.parts), .of_pass = bytes_of_pass(need.parts)};
        },
    .exposed_pixels = pixels_of_first_radius,
    .outlier_warning = kNoEstimatesToHold,
    .make = make_estimator<Sppm>,
};

Sppm::Sppm(OwnedRoutes owned, const IntegratorOptions& options)
    : owned_(std::move(owned)), options_(options) {}

float Sppm::first_radius(const IntegratorOptions& options, int64_t pixels) {
  return options.radius > 0 ? options.radius : kDefaultSppmRadius * radius_growth(pixels);
}

size_t Sppm::bytes_of_pass(size_t parts) {
  return Gathered::bytes_per_walk(parts) + sizeof(uint64_t);
}

float Sppm::pixels_of_first_radius(const IntegratorOptions& options, const PixelFilter&,
                                   int64_t pixels) {
  return pixels_within(first_radius(options, pixels));
}

std::span<const SobolPoint> Sppm::points(const PhotonPass& pass, const Scene&) {
  return {&pass.point, 1};
}

void Sppm::start_regions(const Scene& scene, size_t pixels, size_t parts) {
  regions_in_pixel_ = regions_per_pixel(scene);
  regions_.resize(pixels * regions_in_pixel_);
  flux_.resize(regions_.size() * parts);
  footprint_.resize(regions_.size());
}

void Sppm::render_pass(const PassKey& key, const Learned*, const Scene& scene, Film& film,
                       PassControl& control) {
  const PixelBounds& b = film.bounds();
  const size_t parts = film.parts_of(static_cast<int>(owned_.group)).size();
  const PhotonPass pass = start_photon_pass(key, scene, film.format(), options_, control);
  const int64_t photons = pass.trace.photons_per_pass;
  const double first = first_radius(options_, film.format().picture_pixels());
  start_regions(scene, b.area(), parts);

  // The radius is constant until the pass is complete.
  Gathered gathered(regions_.size(), parts);
  std::vector<uint64_t> counts(regions_.size());
  for (int64_t begin = 0; begin < photons;) {
    PhotonTrace trace = trace_batch(scene, owned_, pass.trace, options_.memory_photons, begin);
    count_photons(trace, statistics_);
    const PhotonGrid grid(std::move(trace.photons));
    statistics_.hold(grid.bytes(), regions_.size() * (bytes_kept(parts) + bytes_of_pass(parts)));
    gather(
        scene, b, owned_, options_.max_depth, pass,
        {points(pass, scene), hash_combine(key.seed, kSppmStream)}, gathered,
        [&](size_t i, const CameraPath&, const Walk& walk, const MergePoint& at, PartSums& sums) {
          const float width = pass.footprint.width(walk.length);
          SharedStatistics& region = regions_[i];
          if (!(region.radius_squared > 0)) {
            region.radius_squared = sqr(first * width);
            footprint_[i] = width;
          }
          const uint64_t found =
              merge_photons(grid, owned_, at, options_.max_depth,
                            static_cast<float>(std::sqrt(region.radius_squared)), sums);
          counts[i] += found;
          return found;
        });
  }
  statistics_.rays += gathered.rays;
  totals_.found += gathered.found;
  statistics_.camera_paths += regions_.size();
  update(gathered, counts, film, static_cast<double>(photons));
}

void Sppm::update(Gathered& gathered, std::span<const uint64_t> counts, Film& film,
                  double photons) {
  const int group = static_cast<int>(owned_.group);
  const PixelBounds& b = film.bounds();
  const size_t parts = film.parts_of(group).size();
  film.set_estimates(group, 1);
  totals_.emitted += photons;
  std::vector<std::array<double, 3>> sums(parts);
  std::vector<Rgb> values(parts);
  float smallest = kInfinity, largest = 0;
  for (size_t first = 0; first < regions_.size(); first += regions_in_pixel_) {
    sums.assign(parts, {});
    const int index = static_cast<int>(first / regions_in_pixel_);
    const Vec2i pixel(b.x0 + index % b.width(), b.y0 + index / b.width());
    for (size_t i = first; i < first + regions_in_pixel_; ++i) {
      SharedStatistics& region = regions_[i];
      if (!(region.radius_squared > 0)) continue;
      // A pass's estimate is clamped like samples of other integrators, then weighed by the filter.
      const double area_of_pass = photons * static_cast<double>(kPi) * region.radius_squared;
      const std::span<Rgb> estimate = gathered.of_walk(i);
      PartSums::clamp_total(estimate,
                            film.settings().max_component * static_cast<float>(area_of_pass));
      // A non-finite value would stay in the sum for ever; count it as if no photon was found.
      const auto bad = std::ranges::find_if_not(estimate, &Rgb::is_finite);
      if (bad != estimate.end()) {
        film.count_bad(group, bad - estimate.begin(), pixel);
        std::ranges::fill(estimate, Rgb{});
      }
      const double found = bad == estimate.end() ? static_cast<double>(counts[i]) : 0.0;
      const double kept = region.update(found, options_.shrink_alpha);
      const double scale = 1.0 / (totals_.emitted * static_cast<double>(kPi) *
                                  region.radius_squared * static_cast<double>(regions_in_pixel_));
      for (size_t k = 0; k < parts; ++k) {
        std::array<double, 3>& tau = flux_[i * parts + k];
        const Rgb add = estimate[k] * gathered.filter_weights[i];
        for (int c = 0; c < 3; ++c) {
          const size_t channel = c;
          tau[channel] = (tau[channel] + add[c]) * kept;
          sums[k][channel] += tau[channel] * scale;
        }
      }
      const float r = static_cast<float>(std::sqrt(region.radius_squared)) / footprint_[i];
      smallest = std::min(smallest, r);
      largest = std::max(largest, r);
    }
    for (size_t k = 0; k < parts; ++k)
      values[k] = {static_cast<float>(sums[k][0]), static_cast<float>(sums[k][1]),
                   static_cast<float>(sums[k][2])};
    film.replace(group, pixel.x, pixel.y, values);
  }
  statistics_.radius_min_pixels = largest > 0 ? smallest : 0;
  statistics_.radius_max_pixels = largest;
}

void Sppm::add_state(const Scene& scene, const Film& film, RenderState& state) {
  const size_t parts = film.parts_of(static_cast<int>(owned_.group)).size();
  start_regions(scene, film.bounds().area(), parts);
  const std::string name = "group." + std::to_string(owned_.group);
  state.add(name + ".regions", std::span(regions_), regions_in_pixel_);
  state.add(name + ".flux", std::span(flux_), regions_in_pixel_ * parts);
  state.add(name + ".footprint", std::span(footprint_), regions_in_pixel_);
  state.add(name + ".totals", std::span(&totals_, 1));
}

EstimatorStatistics Sppm::statistics() const {
  EstimatorStatistics s = statistics_;
  explain_darkness(owned_, totals_.found, s);
  return s;
}

}  // namespace nephroid
