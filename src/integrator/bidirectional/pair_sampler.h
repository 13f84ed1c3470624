// Traces one sample of a pixel in a pass of path pairs: its camera path, its light path if the pass
// connects, and the photons merged. It must not know in which order pixels are sampled, or when
// they are complete.
#pragma once

#include "film/part_sums.h"
#include "integrator/bidirectional/light_batches.h"
#include "integrator/bidirectional/pair_pass.h"
#include "integrator/bidirectional/path_pair.h"
#include "integrator/estimator/lamp_counter.h"
#include "integrator/estimator/technique_counter.h"

namespace nephroid {

/// Number and guide of camera paths.
struct CameraSide {
  const SampleMap& paths;
  const SampleMap* chains = nullptr;  ///< null: separated specular chains are not rendered
  const RadianceGuide& directions = kNoRadiance;
};

/// The sum of all components.
inline float total_of(std::span<const Rgb> colors) {
  float sum = 0;
  for (const Rgb& color : colors) sum += color.r + color.g + color.b;
  return sum;
}

/// Records and counts of a slice of pixels.
struct PairRow {
  std::vector<RadianceRecord> records;
  uint64_t rays = 0, probes = 0;  ///< as in EyePathCounts
  uint64_t merged = 0, camera_paths = 0;
  TechniqueCounter::Row techniques;
};

/// Settings shared by all samples of a pass, and the way to trace one.
class PairSampler {
 public:
  /// `film` receives the light and `all_records` the records of camera paths; either may be null.
  PairSampler(const PairPass& pass, const FilmFormat& format, const CameraSide& camera, Film* film,
              std::vector<RadianceRecord>* all_records, double records_per_path);
  PairSampler(const PairSampler&) = delete;
  PairSampler& operator=(const PairSampler&) = delete;

  /// Sobol' index of the first of a pixel's `n` samples in this pass.
  uint32_t first_index(int n) const;

  /// State of one thread.
  struct Worker {
    LightSubpath path;
    PartSums light;
    PairRow& row;
    LampCounter::Slice lamps;
    bool sees = false;                 ///< its paths add features to the film
    PathRecorder* recorder = nullptr;  ///< null: paths are not recorded
    Worker(const PairSampler& sampler, PairRow& of_row);
  };
  /// Sums that receive the light of a sample.
  struct SampleSums {
    std::span<Rgb> values;  ///< [part] sums of the pixel, or of the sample alone if it waits
    float& bias;            ///< bias of the pixel
    bool waits = false;     ///< the sample waits for other batches and is clamped at the end
  };
  /// Light and cost of a sample.
  struct SampleLight {
    float mean = 0;            ///< mean of the components, as if it were the pixel's only sample
    float photon_squares = 0;  ///< sum of squares of that mean's terms, one per merged photon
    uint64_t rays = 0, merged = 0;
    double cost_of_merges() const { return kCostOfMerge * static_cast<double>(merged); }
    double cost() const {
      return static_cast<double>(rays) + cost_of_merges();
    }                  ///< total cost in rays
    float weight = 0;  ///< magnitude of the filter's weight, times the sample's share
    void add_to(SampleVariance& variance, int x, int y) const {
      variance.add(x, y, mean, cost());
      variance.add_photons(x, y, photon_squares);
    }
  };

  /// Traces sample `k` of a pixel's `samples`. A sample that does not wait is clamped at once.
  /// `merged` is that of EyePathExtras.
  SampleLight trace(int x, int y, int samples, int k, Worker& worker, const SampleSums& sums,
                    uint32_t* merged = nullptr);
  /// Adds the number of photons of a batch that the sample merges to `merged`.
  void count_merged(int x, int y, int samples, int k, Worker& worker, uint32_t& merged);
  /// Sorts photons, which are merged until they are forgotten. `media_distance` is that of
  /// PairMerging.
  void use(std::vector<Photon> photons, float media_distance);
  void forget_photons();
  size_t photon_bytes() const { return maps_ ? maps_->bytes() : 0; }
  size_t pixel_of(int x, int y) const {
    const PixelBounds& b = format.bounds();
    return static_cast<size_t>(y - b.y0) * b.width() + (x - b.x0);
  }

  const PairPass& in;
  const PairTechniques& techniques;
  const CameraSide& camera;
  const FilmFormat& format;
  Film* const film;
  TechniqueCounter counter;
  mutable LampCounter lamps;
  const PhotonPass photons;
  const size_t most;  ///< largest number of camera paths of a pixel
  PassRecords records;
  const SpecularTree tree;
  PairMerging merging;
  PairSettings settings;
  size_t parts = 1;

 private:
  /// Sobol' points of a pixel's sample.
  struct SamplePoints {
    SobolPoint eye, light;
  };
  SamplePoints sample_points(int n, int k) const;
  SpecularRoot::Leaves leaves_at(int x, int y) const;
  uint64_t seed_of(int x, int y, int k) const;
  CameraPath start(int x, int y, int k, PathSampler& sampler) const;

  const CameraView view_;
  std::optional<PhotonMaps> maps_;
  std::vector<std::vector<SamplePoints>> points_;  ///< [samples of the pixel - 1][sample]
};

}  // namespace nephroid
