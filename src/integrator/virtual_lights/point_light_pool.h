// Virtual point lights of a pass: vertices of light paths on rough surfaces, with their BSDFs, to
// which camera walks are connected (docs/estimators.md, section 18). It must not know films or
// cameras. Papers: Keller 1997, Instant radiosity; Dammertz, Keller & Lensch 2010.
#pragma once

#include <memory>
#include <vector>

#include "photon/photon_tracer.h"

namespace nephroid {

/// One virtual point light. It owns its BSDF and cannot be moved.
struct PointLight {
  SurfaceInteraction surface;
  const Material* material = nullptr;
  const Medium* medium = nullptr;  ///< medium of the light path on arrival
  Vec3f wo;                        ///< local direction back along the light path
  SampledSpectrum flux;            ///< flux of the light path over the number of paths
  LightState state = 0;            ///< state of the light side before this vertex
  int events = 0;                  ///< scattering events before this vertex
  /// The light path began with a delta light and a delta lobe, so no camera walk finds it.
  bool only_from_light = false;
  int left = kAllWavelengths;  ///< the hero's number if the path kept no other wavelength
  const Bsdf* bsdf = nullptr;  ///< BSDF in `arena`
  BsdfArena arena;

  PointLight() = default;
  PointLight(const PointLight&) = delete;
  PointLight& operator=(const PointLight&) = delete;
};

/// A chosen point light and W_y / m of [L2], which makes up for those that were not chosen.
struct ChosenLight {
  const PointLight* light = nullptr;
  float factor = 0;
};

/// Number of point lights that fit in the memory of so many photons, at least 1024.
int64_t point_lights_in_memory_of(int64_t photons);

class PointLightPool {
 public:
  /// Traces the light paths of a pass, with the pass's wavelengths. Keeps a point light at each
  /// surface vertex with a finite D or G lobe from which a path of the group can go on towards the
  /// eye. Thins them to `most` ([L5]) and holds up to a quarter more meanwhile. Light path j of
  /// pass i depends on the seed, i and j alone.
  PointLightPool(const Scene& scene, const OwnedRoutes& owned, const PhotonTraceSettings& settings,
                 int64_t most);

  size_t size() const { return lights_.size(); }
  const PointLight& operator[](size_t i) const { return *lights_[i]; }
  uint64_t rays() const { return rays_; }
  /// Light paths that left at least one point light.
  uint64_t useful_paths() const { return useful_paths_; }
  /// Peak memory.
  size_t bytes() const {
    return most_held_ * (sizeof(PointLight) + sizeof(lights_[0]) + sizeof(sums_[0]));
  }

  /// [L4] The k-th of `count` point lights chosen for one point with the number u in [0,1), by
  /// systematic sampling in proportion to flux. The pool must not be empty.
  ChosenLight choose(int k, int count, float u) const;

 private:
  void add_up(int64_t paths);

  std::vector<std::unique_ptr<PointLight>> lights_;
  std::vector<double> sums_;  ///< [light] sum of fluxes up to and including this light
  size_t most_held_ = 0;
  uint64_t rays_ = 0, useful_paths_ = 0;
};

}  // namespace nephroid
