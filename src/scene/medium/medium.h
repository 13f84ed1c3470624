// The interface of participating media, world space. One family a file; medium_table.cpp maps the
// scene format's names to factories. Media tell their properties at a point and bound their
// extinction along a ray; how a ray is tracked through them is transport's business.
// Who calls it: transport. It must not know walks, routes or lights. pbrt-v4 chapter 11.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/spectra.h"
#include "input/scene_description.h"
#include "scene/medium/phase_function.h"

namespace nephroid {

/// A medium at one point.
struct MediumProperties {
  SampledSpectrum sigma_a, sigma_s;  ///< 1/length in world units
  SampledSpectrum le;  ///< emitted radiance per unit of absorption: sigma_a * le is emitted
  HenyeyGreenstein phase;
};

/// A piece of a ray along which the extinction sigma_a + sigma_s stays at or below `sigma_maj`.
struct MajorantSegment {
  float t_min = 0, t_max = 0;  ///< in units of the ray's direction, which is of unit length
  SampledSpectrum sigma_maj;   ///< 1/length
};

/// Walks through the cells of a grid of majorants along a ray: a 3D DDA (Amanatides & Woo 1987).
/// A medium without a grid has one segment. A value type, no allocation.
class MajorantIterator {
 public:
  /// Nothing at all: the ray misses the medium's bounds.
  MajorantIterator() = default;
  /// One segment.
  explicit MajorantIterator(const MajorantSegment& segment)
      : t_(segment.t_min), t_end_(segment.t_max), sigma_(segment.sigma_maj) {}
  /// A grid of `resolution` cells over the unit cube: cell (x, y, z) has majorant
  /// sigma_t * scales[x + nx (y + ny z)]. `o` and `d` are the ray in the cube's space (t as on
  /// the world ray), valid for t_min <= t < t_max, where it lies inside the cube. `scales` outlive
  /// the iterator.
  MajorantIterator(const Vec3d& o, const Vec3d& d, float t_min, float t_max,
                   const SampledSpectrum& sigma_t, const float* scales, const int resolution[3]);
  /// The next piece, front to back; empty behind the last. Pieces are contiguous, none is empty,
  /// and together they are the whole of [t_min, t_max); neighbouring cells with the same majorant
  /// make one piece.
  std::optional<MajorantSegment> next();

 private:
  /// Where the ray leaves the cell along an axis; `moves` is false if it runs across that axis.
  void set_crossing(int axis, bool moves);
  float scale_here() const {
    return scales_[cell_[0] +
                   size_t(resolution_[0]) * (cell_[1] + size_t(resolution_[1]) * cell_[2])];
  }

  float t_ = 0, t_end_ = -1;
  SampledSpectrum sigma_;
  const float* scales_ = nullptr;  ///< null: one segment
  int resolution_[3] = {1, 1, 1}, cell_[3] = {0, 0, 0}, step_[3] = {0, 0, 0};
  double origin_[3] = {0, 0, 0};         ///< of the ray
  double per_cell_[3] = {0, 0, 0};       ///< change of t from one wall of cells to the next, signed
  double next_crossing_[3] = {0, 0, 0};  ///< t
};

class Medium {
 public:
  virtual ~Medium() = default;

  /// Place in Scene::media, which stands for its label in light path expressions; -1 outside of a
  /// scene.
  int index() const { return index_; }
  void set_index(int index) { index_ = index; }

  /// True if it may emit anywhere.
  virtual bool is_emissive() const = 0;
  /// True if it scatters nowhere and at no wavelength: light is only dimmed by it.
  virtual bool is_purely_absorbing() const = 0;
  /// sigma_a + sigma_s where they are the same everywhere: the transmittance is then known in
  /// closed form. Empty for media that vary in space.
  virtual std::optional<SampledSpectrum> uniform_extinction(const SampledWavelengths&) const {
    return std::nullopt;
  }
  /// At a point of a ray's majorants; beyond the medium's bounds there may still be something.
  virtual MediumProperties at(const Vec3f& p, const SampledWavelengths& lambda) const = 0;
  /// Majorants along a ray of unit direction from its origin to t_max (which may be infinite).
  virtual MajorantIterator majorants(const Ray& ray, float t_max,
                                     const SampledWavelengths& lambda) const = 0;

 private:
  int index_ = -1;
};
using MediumPtr = std::shared_ptr<const Medium>;

/// Makes all media of a description, in its order. Throws SceneError or IoError.
std::vector<MediumPtr> make_media(const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace nephroid
