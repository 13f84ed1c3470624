// Virtual point lights of a pass: places on rough surfaces where light paths landed, with what
// scatters there, so that camera walks can be connected to them (docs/estimators.md, section 18).
// It must not know films or cameras. Papers: Keller 1997, Instant radiosity; Dammertz, Keller &
// Lensch 2010.
#pragma once

#include <memory>
#include <vector>

#include "photon/photon_tracer.h"

namespace nephroid {

/// One virtual point light. It holds its BSDF, so it stays where it was made.
struct PointLight {
  SurfaceInteraction surface;
  const Material* material = nullptr;
  const Medium* medium = nullptr;  ///< around the light path that came here
  Vec3f wo;                        ///< local, back along the light path
  SampledSpectrum flux;            ///< of one light path, divided by their number
  LightState state = 0;            ///< of the light side, this vertex excluded
  int events = 0;                  ///< scattering events before this vertex
  /// The light path began with a delta light and a delta lobe: no walk from the eye finds it.
  bool only_from_light = false;
  int left = kAllWavelengths;  ///< or the hero's number, if it kept no other wavelength
  const Bsdf* bsdf = nullptr;  ///< in `arena`
  BsdfArena arena;

  PointLight() = default;
  PointLight(const PointLight&) = delete;
  PointLight& operator=(const PointLight&) = delete;
};

/// A point light and the factor by which its light counts, because others were not chosen.
struct ChosenLight {
  const PointLight* light = nullptr;
  float factor = 0;
};

/// How many point lights have room in the memory of so many photons, at least a thousand.
int64_t point_lights_in_memory_of(int64_t photons);

class PointLightPool {
 public:
  /// Traces light paths of a pass, with the pass's wavelengths, and keeps a point light at each
  /// surface vertex with a finite lobe of class D or G from which a word of the group can go on
  /// towards the eye; of more than `most` it chooses, and holds a quarter more while it does
  /// ([L5]). Deterministic: light path j of pass i depends on the seed, i and j alone.
  PointLightPool(const Scene& scene, const OwnedRoutes& owned, const PhotonTraceSettings& settings,
                 int64_t most);

  size_t size() const { return lights_.size(); }
  const PointLight& operator[](size_t i) const { return *lights_[i]; }
  uint64_t rays() const { return rays_; }
  /// Light paths that left a point light at least.
  uint64_t useful_paths() const { return useful_paths_; }
  /// The most that was held at once.
  size_t bytes() const {
    return most_held_ * (sizeof(PointLight) + sizeof(lights_[0]) + sizeof(sums_[0]));
  }

  /// The k-th of `count` point lights that are chosen for one point with the number u in [0,1), by
  /// systematic sampling with probabilities proportional to their flux. The pool is not empty.
  ChosenLight choose(int k, int count, float u) const;

 private:
  void add_up(int64_t paths);

  std::vector<std::unique_ptr<PointLight>> lights_;
  std::vector<double> sums_;  ///< of fluxes up to and including each light
  size_t most_held_ = 0;
  uint64_t rays_ = 0, useful_paths_ = 0;
};

}  // namespace nephroid
