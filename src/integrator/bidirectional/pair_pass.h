// One pass of an estimator that pairs eye paths with light paths: photons are traced and merged,
// and where the pass connects, another set of light paths, one for each camera path, is connected
// to it. Wavelengths and time are the pass's; nothing is kept but photons, in batches that fit in
// memory. Who calls it: vcm, bpm and path+photons, which say how. It must not know passes before
// it.
#pragma once

#include "film/splats.h"
#include "integrator/estimator/estimator.h"
#include "integrator/learning/guided_walk.h"
#include "integrator/mixed/balance.h"
#include "photon/emission_guide.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// How a pass is rendered.
struct PairPass {
  int64_t light_paths = 1;     ///< that leave photons; 0: nothing is merged
  bool connects = true;        ///< false: nothing is connected but lights
  bool caustics_only = false;  ///< merges only photons whose light came by way of an S
  float window = 1;            ///< of roulette on camera paths
  bool adds_features = false;  ///< camera paths add what they see first to the film's features
  const EmissionGuide* guide = &kUnguided;
  const RadianceGuide* radiance = nullptr;  ///< of the directions of camera paths; null: of none
  /// Where what camera paths find behind their vertices goes as well, empty before.
  std::vector<RadianceRecord>* records = nullptr;
  double records_of_path = PassRecords::kMostOfPath;  ///< that a camera path leaves in the mean
  const SampleMap* samples = nullptr;                 ///< camera paths of each pixel; null: one
  /// Camera paths that each pixel has had before pass 1, whatever `samples` says: the numbers of
  /// the later ones follow on.
  uint32_t head = 0;
  SampleSpread* spread = nullptr;  ///< where what each camera path finds goes as well
  bool spreads_splats = false;     ///< of try_out: and what its pixel gets from light paths
  /// Light behind delta lobes alone is found by walks that look for nothing else; else camera
  /// paths find it, with trees if options ask for them.
  bool leaves_glints = false;
  /// These walks of each pixel: where there are none, camera paths find the light, without trees;
  /// null: nobody does.
  const SampleMap* glints = nullptr;
  SampleSpread *glint_spread = nullptr, *choice_spread = nullptr;  ///< as in GlintPass

  /// Renders the pass into the film, its number of estimates included.
  void render(const PassKey& key, const Scene& scene, Film& film, const OwnedRoutes& owned,
              const IntegratorOptions& options, EstimatorStatistics& statistics) const;
  /// Traces what a pass for a film like this one would, and adds nothing to it.
  void try_out(const PassKey& key, const Scene& scene, const Film& film, const OwnedRoutes& owned,
               const IntegratorOptions& options, EstimatorStatistics& statistics) const;

  /// What a camera path found.
  struct Found {
    float light = 0, rays = 0;
  };
  /// What a pass takes for each pixel, of which `spread_samples` samples at most are looked at for
  /// their spread, and `clamped_samples` at most are clamped.
  static constexpr size_t bytes_per_pixel(size_t parts, size_t spread_samples,
                                          size_t clamped_samples) {
    return SplatBuffer::bytes_per_pixel(parts) + parts * sizeof(Rgb) + sizeof(float) +
           spread_samples * sizeof(Found) +
           (spread_samples > 0 ? 3 * SampleSpread::kBytesPerPixel : 0) +
           clamped_samples * (parts * sizeof(Rgb) + sizeof(float));
  }
};

}  // namespace nephroid
