// The algorithms' options, set by defaults, the scene's Integrator line and -D key=value, in this
// order.
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <typeindex>

namespace nephroid {

/// Options that most estimators share (all those that trace or merge photons), and, by type, those
/// of single estimators: structs beside their classes, such as PpmOptions.
struct IntegratorOptions {
  int max_depth = 100;  ///< scattering events of a whole path, camera and light side together
  float radius = 0;     ///< first merge radius in pixel footprints; 0: the integrator's default
  int64_t photons_per_pass = 0;      ///< 0: chosen from the film's size
  float shrink_alpha = 2.0f / 3.0f;  ///< exponent α of [E1] and [E2]
  int camera_samples_per_pass = 0;   ///< 0: the integrator's default
  int64_t memory_photons =
      1 << 20;  ///< photons kept at once (kBytesPerPhoton each); a larger pass runs in batches

  /// Options of type T, for changes.
  template <class T>
  T& edit() {
    std::any& options = own_[typeid(T)];
    if (!options.has_value()) options = T{};
    return *std::any_cast<T>(&options);
  }
  /// Options of type T as they were set, else their defaults.
  template <class T>
  const T& own() const {
    static const T kDefaults;
    const auto at = own_.find(typeid(T));
    return at == own_.end() ? kDefaults : *std::any_cast<T>(&at->second);
  }

 private:
  std::map<std::type_index, std::any> own_;
};

}  // namespace nephroid
