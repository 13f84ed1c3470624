// Trial passes of `path+photons` over the first lattice of a film: variance and cost of a choice of
// techniques (docs/estimators.md, section 21). It must not know which choice is made.
#pragma once

#include <span>

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/mixed/balance.h"

namespace nephroid {

/// [A6] The variance of one camera path of a pass by cause, in units of [A1].
struct TrialNoise {
  double of_camera = 0;   ///< variance given the photons
  double of_photons = 0;  ///< variance due to the photons, which all paths of the pass share
  double light = 0;       ///< mean of the picture
  /// The same two, not divided by brightness: variances of a pixel, in units of light squared.
  double variance_of_camera = 0, variance_of_photons = 0;
};
/// Computes it from passes that share nothing but wavelengths and time. Each has `samples` (at
/// least 2) independent camera paths per pixel in the tiles where `tiles` is not 0.
TrialNoise split_noise(std::span<const SampleVariance> passes, const SampleMap& tiles, int samples);

/// The first merge radius, in footprints, in a picture of so many pixels. It is wider if photons of
/// all light are merged, most of which is smooth.
float first_radius_of_film(const PairTechniques& techniques, const IntegratorOptions& options,
                           int64_t pixels);

/// A choice of techniques and its trial results.
struct Candidate {
  PairTechniques techniques;
  Trial trial;
  Balance balance;  ///< balance for passes of the film
};

/// Keeps references to its arguments.
class Trials {
 public:
  Trials(uint64_t seed, const Scene& scene, const FilmFormat& film, const OwnedRoutes& owned,
         const IntegratorOptions& options, PassControl& control);

  /// Runs trial passes; their light is thrown away.
  Candidate run(const PairTechniques& techniques, const EmissionGuide& emission);
  /// Rays and memory of all trials.
  const EstimatorStatistics& costs() const { return costs_; }

 private:
  float photons_for_one(const PairTechniques& techniques) const;
  Trial trial_of(const TrialNoise& noise, const EstimatorStatistics& counts,
                 const PairTechniques& techniques, double records) const;

  const uint64_t seed_;
  const Scene& scene_;
  const FilmFormat& film_;
  const OwnedRoutes& owned_;
  const IntegratorOptions& options_;
  PassControl& control_;
  const int spacing_;    ///< spacing of the lattice in pixels
  const double pixels_;  ///< pixels of the lattice
  const SampleMap tiles_;
  EstimatorStatistics costs_;
};

}  // namespace nephroid
