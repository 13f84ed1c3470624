// Materials: textures evaluated at a point and turned into a BSDF. One family per file; table.cpp
// maps the scene format's names to factories. It must not know integrators or lights.
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

  /// Makes the BSDF at a point, in `arena`. Microfacet lobes with alpha up to `specular_alpha` are
  /// of class S, rougher ones of class G. Can terminate secondary wavelengths (dispersion). Null
  /// means no surface ("interface"). The point's shading frame already includes bump().
  virtual const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                                float specular_alpha, BsdfArena& arena) const = 0;

  /// Index in Scene::materials, from which light path expressions get its label; -1 outside of a
  /// scene.
  int index() const { return index_; }
  void set_index(int index) { index_ = index; }

  /// The material in effect at a point: this one, or for `mix` the one chosen by a hash of the
  /// point (pbrt-v4 section 10.5.1).
  virtual const Material* resolve(const SurfaceInteraction&) const { return this; }

  /// The materials that `mix` chooses among, which can be mixes themselves. Empty for all others.
  virtual std::span<const std::shared_ptr<const Material>> choices() const { return {}; }
  /// True if other materials replace this one everywhere, so that it has no events of its own.
  bool is_mix() const { return !choices().empty(); }

  /// The BSSRDF of a surface whose BSDF samples `subsurface` events, in `arena`. Null for all other
  /// materials. `lambda` has passed make_bsdf already.
  virtual const Bssrdf* make_bssrdf(const SurfaceInteraction&, const SampledWavelengths&,
                                    BsdfArena&) const {
    return nullptr;
  }

  /// True if make_bssrdf returns one.
  virtual bool has_bssrdf() const { return false; }

  /// False where photons cannot be merged (hair, which is thinner than any merge radius). Its
  /// events are H, whatever their lobes.
  virtual bool merges_photons() const { return true; }
  /// The classes of possible_classes() in which photons can be merged, by any of choices().
  virtual ClassMask merging_classes() const {
    return merges_photons() ? possible_classes() : ClassMask::kNone;
  }

  /// Perturbs the shading frame by the bump or normal map, if there is one.
  virtual void bump(SurfaceInteraction&) const {}
  virtual bool has_bump() const { return false; }

  /// Relative index, inside over outside, at 550 nm. Empty if no light is refracted.
  virtual std::optional<float> refractive_index() const { return std::nullopt; }
  /// True if light can enter and leave a closed body by events of class S or G.
  bool refracts() const { return refractive_index().has_value(); }
  /// True for "interface" (no surface at all).
  virtual bool is_interface() const { return false; }
  /// True if light can pass straight through without an event (thin dielectrics). Shadow rays then
  /// call straight_transmittance.
  virtual bool transmits_straight() const { return is_interface(); }
  /// Transmittance of a ray that goes straight through, for shadow rays.
  virtual SampledSpectrum straight_transmittance(const SurfaceInteraction&,
                                                 const SampledWavelengths&) const {
    return SampledSpectrum(is_interface() ? 1.0f : 0.0f);
  }
  /// Probability that resolve() returns a surface here, not an interface.
  virtual float presence(const SurfaceInteraction&) const { return is_interface() ? 0.0f : 1.0f; }
  /// Classes that any lobe of this material can have at any point and with any threshold in the
  /// band. Conservative: it tells which paths can occur ("why is there no caustic").
  virtual ClassMask possible_classes() const = 0;
  /// The larger alpha of its microfacets, of two layers that of the smoother. Empty if there are
  /// none or they vary.
  virtual std::optional<float> facet_alpha() const { return std::nullopt; }

 private:
  int index_ = -1;
};
using MaterialPtr = std::shared_ptr<const Material>;

/// Scene options that change how materials become lobes.
struct MaterialSettings {
  SpecularBand specular_band;
  bool force_diffuse = false;  ///< every surface is Lambertian
};

/// Makes all materials of a description, in its order (index = MaterialReference::index), and
/// resolves the names of `mix`. Throws SceneError for unknown types or names. Unsupported features
/// are located errors or warnings.
std::vector<MaterialPtr> make_materials(const SceneDescription& description,
                                        const TextureLibrary& textures,
                                        const MaterialSettings& settings, Diagnostics& diagnostics);

}  // namespace nephroid
