// Describes an estimator to the rest of the program. Each has one, beside its class, and one row
// in the table of estimators (integrator/presets/estimator_table.cpp); nothing else switches on
// which estimator it has.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "integrator/estimator/integrator_options.h"
#include "route/estimator_traits.h"
#include "route/scene_symbols.h"

namespace nephroid {

class Estimator;
class PixelFilter;

struct Capabilities {
  bool independent_passes = true;  ///< passes may be rendered anywhere, in any order, and added up
  bool per_pixel_state = false;    ///< keeps more than the film does (E1)
  bool consistent = true;          ///< tends to the truth as passes are added; else an error stays
  /// The learned value carries light, as a photon map does: pictures of two seeds that share it
  /// are not independent.
  bool learned_is_light = false;
};

/// A key of -D that only some estimators look at.
struct EstimatorSetting {
  const char* key;
  const char* value;  ///< placeholder of the value in help: "N", "X"
  const char* default_text;
  const char* unit;  ///< empty if it has none
  const char* help;
  /// Parses and stores; throws UsageError.
  void (*apply)(IntegratorOptions& options, const std::string& text);
  /// The stored value as metadata have it.
  std::string (*print)(const IntegratorOptions& options);
};

/// Input of EstimatorDescriptor::bytes_per_pixel.
struct PixelMemoryInput {
  size_t parts = 1;  ///< parts of the picture owned by the estimator
  const IntegratorOptions& options;
  int samples_per_pixel = 1;  ///< as the scene has them
  bool clamps = false;        ///< the film has a maxcomponentvalue
};

/// Memory for each pixel.
struct PixelBytes {
  size_t kept = 0;     ///< bytes kept between passes
  size_t of_pass = 0;  ///< bytes while a pass is rendered
};

struct EstimatorDescriptor {
  EstimatorTraits traits = {};
  Capabilities capabilities = {};
  std::span<const EstimatorSetting* const> settings = {};
  bool merges_with_radius = false;  ///< its independent passes have the bias of a merge radius
  bool keeps_photons = false;       ///< it takes memory for IntegratorOptions::memory_photons
  PixelBytes (*bytes_per_pixel)(const PixelMemoryInput& need) = [](const PixelMemoryInput&) {
    return PixelBytes{};
  };
  /// a of [O2], the pixels that one path exposes in a pass, of a film of `pixels`: of a path from
  /// the eye, its own.
  float (*exposed_pixels)(const IntegratorOptions& options, const PixelFilter& filter,
                          int64_t pixels) = [](const IntegratorOptions&, const PixelFilter&,
                                               int64_t) { return 1.0f; };
  /// Why --outliers reject does not do all it should for its routes, in words that follow "routes
  /// of NAME "; null if it does.
  const char* outlier_warning = nullptr;
  std::unique_ptr<Estimator> (*make)(OwnedRoutes owned, const IntegratorOptions& options) = nullptr;
};

/// For EstimatorDescriptor::make.
template <class T>
std::unique_ptr<Estimator> make_estimator(OwnedRoutes owned, const IntegratorOptions& options) {
  return std::make_unique<T>(std::move(owned), options);
}

}  // namespace nephroid
