// EstimatorDescriptor: all that the rest of the program knows of an estimator. Each estimator has
// one, beside its class, and one row in integrator/presets/estimator_table.cpp. No other code
// branches on which estimator it has.
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
  bool independent_passes = true;  ///< passes can be rendered anywhere, in any order, and added up
  bool per_pixel_state = false;    ///< state of each pixel beside the film, as in [E1]
  bool consistent = true;          ///< the error tends to zero as passes are added
  /// The learned value carries light, as a photon map does. Two pictures that share it are not
  /// independent, even if their seeds differ.
  bool learned_is_light = false;
};

/// A key of -D that only some estimators use.
struct EstimatorSetting {
  const char* key;
  const char* value;  ///< placeholder of the value in help: "N", "X"
  const char* default_text;
  const char* unit;  ///< empty: no unit
  const char* help;
  /// Parses and stores; throws UsageError.
  void (*apply)(IntegratorOptions& options, const std::string& text);
  /// The stored value, as written to metadata.
  std::string (*print)(const IntegratorOptions& options);
};

/// Input of EstimatorDescriptor::bytes_per_pixel.
struct PixelMemoryInput {
  size_t parts = 1;  ///< parts of the picture that the estimator owns
  const IntegratorOptions& options;
  int samples_per_pixel = 1;  ///< the scene's pixel samples
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
  bool merges_with_radius = false;  ///< a merge radius biases its independent passes
  bool keeps_photons = false;       ///< needs memory for IntegratorOptions::memory_photons
  PixelBytes (*bytes_per_pixel)(const PixelMemoryInput& need) = [](const PixelMemoryInput&) {
    return PixelBytes{};
  };
  /// a of [O2]: the number of pixels that one path exposes in a pass, on a film of `pixels`. A
  /// camera path exposes its own pixel only.
  float (*exposed_pixels)(const IntegratorOptions& options, const PixelFilter& filter,
                          int64_t pixels) = [](const IntegratorOptions&, const PixelFilter&,
                                               int64_t) { return 1.0f; };
  /// Why --outliers reject works only in part for its routes, worded to follow "routes of NAME ".
  /// Null if it works.
  const char* outlier_warning = nullptr;
  std::unique_ptr<Estimator> (*make)(OwnedRoutes owned, const IntegratorOptions& options) = nullptr;
};

/// A value for EstimatorDescriptor::make.
template <class T>
std::unique_ptr<Estimator> make_estimator(OwnedRoutes owned, const IntegratorOptions& options) {
  return std::make_unique<T>(std::move(owned), options);
}

}  // namespace nephroid
