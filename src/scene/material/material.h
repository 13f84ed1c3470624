// Materials: textures evaluated at a point and turned into a BSDF. One family a file; table.cpp
// maps the scene format's names to factories. Who calls it: Scene and transport. It must not know
// integrators or lights.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/bssrdf.h"
#include "scene/texture/texture.h"

namespace nephroid {

class Material {
 public:
  virtual ~Material() = default;

  /// The BSDF at a point, in `arena`; microfacet lobes with alpha up to `specular_alpha` are of
  /// class S, rougher ones of class G. May drop secondary wavelengths (dispersion). Never null for
  /// a surface; null means that the surface is not there ("interface"). The point's shading frame
  /// has been bumped already.
  virtual const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                                float specular_alpha, BsdfArena& arena) const = 0;

  /// Place in Scene::materials, which stands for its label in light path expressions; -1 outside of
  /// a scene.
  int index() const { return index_; }
  void set_index(int index) { index_ = index; }

  /// The material that stands for this one at a point: itself, or for `mix` the one that is chosen
  /// by a hash of the point (pbrt-v4 section 10.5.1).
  virtual const Material* resolve(const SurfaceInteraction&) const { return this; }

  /// The materials that `mix` chooses among, which may be mixes themselves; empty for all others.
  virtual std::span<const std::shared_ptr<const Material>> choices() const { return {}; }
  /// True if others stand for this material everywhere: no event is its own.
  bool is_mix() const { return !choices().empty(); }

  /// What lies under a surface whose BSDF samples `subsurface` events, in `arena`; nullptr for all
  /// other materials. `lambda` has passed make_bsdf already.
  virtual const Bssrdf* make_bssrdf(const SurfaceInteraction&, const SampledWavelengths&,
                                    BsdfArena&) const {
    return nullptr;
  }

  /// True if make_bssrdf gives one.
  virtual bool has_bssrdf() const { return false; }

  /// False where photons cannot be merged (hair, whose width is below any merge radius): its events
  /// are H, whatever their lobes.
  virtual bool merges_photons() const { return true; }
  /// The classes of possible_classes() in which photons may be merged, in any guise.
  virtual ClassMask merging_classes() const {
    return merges_photons() ? possible_classes() : ClassMask::kNone;
  }

  /// Moves the shading frame by the bump or normal map, if there is one.
  virtual void bump(SurfaceInteraction&) const {}
  virtual bool has_bump() const { return false; }

  /// Of what is inside over what is outside, at 550 nm; empty if no light is refracted.
  virtual std::optional<float> refractive_index() const { return std::nullopt; }
  /// True if light passes by way of events of class S or G, in and out again of a closed body.
  bool refracts() const { return refractive_index().has_value(); }
  /// True for "interface" (no surface at all).
  virtual bool is_interface() const { return false; }
  /// True if light may pass straight through without a letter (thin dielectrics): shadow rays then
  /// ask straight_transmittance.
  virtual bool transmits_straight() const { return is_interface(); }
  /// Weight of a ray that goes straight through, for shadow rays.
  virtual SampledSpectrum straight_transmittance(const SurfaceInteraction&,
                                                 const SampledWavelengths&) const {
    return SampledSpectrum(is_interface() ? 1.0f : 0.0f);
  }
  /// Probability that resolve() finds a surface here and not an interface.
  virtual float presence(const SurfaceInteraction&) const { return is_interface() ? 0.0f : 1.0f; }
  /// Classes that any lobe of this material may have at any point and with any threshold in the
  /// band (a conservative answer: what paths can occur, "why is there no caustic").
  virtual ClassMask possible_classes() const = 0;
  /// The larger alpha of its microfacets, of two layers that of the smoother; empty if there are
  /// none or they vary.
  virtual std::optional<float> facet_alpha() const { return std::nullopt; }

 private:
  int index_ = -1;
};
using MaterialPtr = std::shared_ptr<const Material>;

/// Options of the scene that change how materials become lobes.
struct MaterialSettings {
  SpecularBand specular_band;
  bool force_diffuse = false;  ///< every surface is Lambertian
};

/// Makes all materials of a description, in its order (index = MaterialReference::index). Names are
/// resolved for `mix`. Throws SceneError for unknown types or names; what cannot be rendered yet is
/// a located error or warning.
std::vector<MaterialPtr> make_materials(const SceneDescription& description,
                                        const TextureLibrary& textures,
                                        const MaterialSettings& settings, Diagnostics& diagnostics);

}  // namespace nephroid
