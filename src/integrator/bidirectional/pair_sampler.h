// How a pass of pairs traces one sample of a pixel: its camera path, the light path that goes with
// it where the pass connects, and the photons that are merged. It must not know in which order
// pixels are sampled, or when they are complete.
#pragma once

#include "film/part_sums.h"
#include "integrator/bidirectional/light_batches.h"
#include "integrator/bidirectional/pair_pass.h"
#include "integrator/bidirectional/path_pair.h"
#include "integrator/estimator/lamp_counter.h"
#include "integrator/estimator/technique_counter.h"

namespace nephroid {

/// How many camera paths there are, and where they go.
struct CameraSide {
  const SampleMap& paths;
  const SampleMap* chains = nullptr;  ///< null: nobody looks for specular chains if they are apart
  const RadianceGuide& directions = kNoRadiance;
};

/// The sum of the components.
inline float total_of(std::span<const Rgb> colors) {
  float sum = 0;
  for (const Rgb& color : colors) sum += color.r + color.g + color.b;
  return sum;
}

/// Records and counts of a slice of pixels.
struct PairRow {
  std::vector<RadianceRecord> records;
  uint64_t rays = 0, probes = 0;  ///< EyePathCounts
  uint64_t merged = 0, camera_paths = 0;
  TechniqueCounter::Row techniques;
};

/// What all samples of a pass share.
class PairSampler {
 public:
  /// `film` is where the light goes, or null; records of camera paths go to `all_records`, or null.
  PairSampler(const PairPass& pass, const FilmFormat& format, const CameraSide& camera, Film* film,
              std::vector<RadianceRecord>* all_records, double records_per_path);
  PairSampler(const PairSampler&) = delete;
  PairSampler& operator=(const PairSampler&) = delete;

  /// Number of a pixel's first sample of `n` in this pass.
  uint32_t first_index(int n) const;

  /// What one thread works with.
  struct Worker {
    LightSubpath path;
    PartSums light;
    PairRow& row;
    LampCounter::Slice lamps;
    bool sees = false;  ///< adds features to the film
    Worker(const PairSampler& sampler, PairRow& of_row);
  };
  /// Where the light of a sample goes.
  struct SampleSums {
    std::span<Rgb> values;  ///< [part], of the pixel, or of the sample alone if it waits
    float& bias;            ///< of the pixel
    bool waits = false;     ///< for other batches, and is clamped at the end
  };
  /// What a sample found.
  struct SampleLight {
    float mean = 0;  ///< of the components, as if the pixel had no other sample
    uint64_t rays = 0, merged = 0;
    double cost_of_merges() const { return kCostOfMerge * static_cast<double>(merged); }
    double cost() const {
      return static_cast<double>(rays) + cost_of_merges();
    }                  ///< total, in rays
    float weight = 0;  ///< of its light in the pixel
  };

  /// Where nothing waits the sample is clamped as it is. `merged`: EyePathExtras.
  SampleLight trace(int x, int y, int samples, int k, Worker& worker, const SampleSums& sums,
                    uint32_t* merged = nullptr);
  /// Adds the photons of a batch to `merged`.
  void count_merged(int x, int y, int samples, int k, Worker& worker, uint32_t& merged);
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
  const size_t most;  ///< camera paths of a pixel
  PassRecords records;
  const SpecularTree tree;
  PairMerging merging;
  PairSettings settings;
  size_t parts = 1;

 private:
  /// The numbers of a pixel's sample `k` of `n` in this pass.
  struct SamplePoints {
    SobolPoint eye, light;
  };
  SamplePoints sample_points(int n, int k) const;
  SpecularRoot::Leaves leaves_at(int x, int y) const;
  uint64_t seed_of(int x, int y, int k) const;
  CameraPath start(int x, int y, int k, PathSampler& sampler) const;

  const CameraView view_;
  std::vector<std::vector<SamplePoints>> points_;  ///< [samples of a pixel - 1][sample]
};

}  // namespace nephroid
