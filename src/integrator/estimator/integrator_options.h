// The numbers that a user may set of the algorithms, from defaults, the scene's Integrator line and
// -D key=value, in this order.
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <typeindex>

namespace nephroid {

/// Options that most estimators share (where photons are traced or merged, all of them do), and
/// those of one or a few: structs beside their classes, such as PpmOptions.
struct IntegratorOptions {
  int max_depth = 100;  ///< scattering events of the whole path, camera and light side together
  /// Pixel footprints of the first merge radius.
  float radius = 0;                  ///< 0: the default of the integrator
  int64_t photons_per_pass = 0;      ///< 0: chosen from the film's size
  float shrink_alpha = 2.0f / 3.0f;  ///< exponent α of [E1] and [E2]
  int camera_samples_per_pass = 0;   ///< 0: the default of the integrator
  int64_t memory_photons =
      1 << 20;  ///< photons kept at once (96 bytes each); a larger pass runs in batches

  /// Options of type T, to be changed.
  template <class T>
  T& edit() {
    std::any& options = own_[typeid(T)];
    if (!options.has_value()) options = T{};
    return *std::any_cast<T>(&options);
  }
  /// Options of type T as they were set; else their defaults.
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
