// The interface of participating media, world space (pbrt-v4 chapter 11): properties at a point,
// and bounds of the extinction along a ray. Tracking is left to transport. One family per file;
// medium_table.cpp maps the scene format's names to factories. It must not know walks, routes or
// lights.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/spectra.h"
#include "input/scene_description.h"
#include "scene/medium/phase_function.h"

namespace nephroid {

/// The properties of a medium at one point.
struct MediumProperties {
  SampledSpectrum sigma_a, sigma_s;  ///< 1/length in world units
  SampledSpectrum le;  ///< emitted radiance per unit of absorption: sigma_a * le is emitted
  HenyeyGreenstein phase;
};

/// A segment of a ray along which the extinction sigma_a + sigma_s is at most `sigma_maj`.
struct MajorantSegment {
  float t_min = 0, t_max = 0;  ///< in units of the ray's direction, which is of unit length
  SampledSpectrum sigma_maj;   ///< 1/length
};

/// Walks through the cells of a majorant grid along a ray by 3D DDA (Amanatides & Woo 1987). A
/// medium without a grid has one segment. A value type, without allocation.
class MajorantIterator {
 public:
  /// No segment: the ray misses the medium's bounds.
  MajorantIterator() = default;
  /// One segment.
  explicit MajorantIterator(const MajorantSegment& segment)
      : t_(segment.t_min), t_end_(segment.t_max), sigma_(segment.sigma_maj) {}
  /// A grid of `resolution` cells over the unit cube: cell (x, y, z) has majorant sigma_t *
  /// scales[x + nx (y + ny z)]. `o` and `d` are the ray in the cube's space, with t as on the world
  /// ray. It lies inside the cube for t_min <= t < t_max. `scales` outlive the iterator.
  MajorantIterator(const Vec3d& o, const Vec3d& d, float t_min, float t_max,
                   const SampledSpectrum& sigma_t, const float* scales, const int resolution[3]);
  /// The next segment, front to back; empty after the last. Segments are contiguous and not empty,
  /// and cover all of [t_min, t_max). Neighbouring cells with the same majorant form one segment.
  std::optional<MajorantSegment> next();

 private:
  /// Computes where the ray leaves the cell along an axis. `moves` is false if the ray is
  /// perpendicular to it.
  void set_crossing(int axis, bool moves);
  float scale_here() const {
    return scales_[cell_[0] +
                   size_t(resolution_[0]) * (cell_[1] + size_t(resolution_[1]) * cell_[2])];
  }

  float t_ = 0, t_end_ = -1;
  SampledSpectrum sigma_;
  const float* scales_ = nullptr;  ///< null: one segment
  int resolution_[3] = {1, 1, 1}, cell_[3] = {0, 0, 0}, step_[3] = {0, 0, 0};
  double origin_[3] = {0, 0, 0};         ///< the ray's origin
  double per_cell_[3] = {0, 0, 0};       ///< signed change of t between cell walls
  double next_crossing_[3] = {0, 0, 0};  ///< t of the next wall
};

class Medium {
 public:
  virtual ~Medium() = default;

  /// Index in Scene::media, from which light path expressions get its label; -1 outside of a scene.
  int index() const { return index_; }
  void set_index(int index) { index_ = index; }

  /// True if it can emit somewhere.
  virtual bool is_emissive() const = 0;
  /// True if it scatters nowhere and at no wavelength: it only attenuates light.
  virtual bool is_purely_absorbing() const = 0;
  /// sigma_a + sigma_s where it is the same everywhere, so that transmittance has a closed form.
  /// Empty for media that vary in space.
  virtual std::optional<SampledSpectrum> uniform_extinction(const SampledWavelengths&) const {
    return std::nullopt;
  }
  /// Properties at a point within a ray's majorants, which can extend beyond the medium's bounds.
  virtual MediumProperties at(const Vec3f& p, const SampledWavelengths& lambda) const = 0;
  /// Majorants along a ray of unit direction, from its origin to t_max (which can be infinite).
  virtual MajorantIterator majorants(const Ray& ray, float t_max,
                                     const SampledWavelengths& lambda) const = 0;

 private:
  int index_ = -1;
};
using MediumPtr = std::shared_ptr<const Medium>;

/// Makes all media of a description, in its order. Throws SceneError or IoError.
std::vector<MediumPtr> make_media(const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace nephroid
