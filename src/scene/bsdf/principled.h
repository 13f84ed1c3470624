// The BSDF of the principled material: fuzz over a coat over a base of metal and dielectric. Below
// the dielectric boundary the base transmits, scatters diffusely, or lets light in to a subsurface
// event. It must not know textures. Models: OpenPBR 1.1; Walter et al. 2007 (facets).
#pragma once

#include <array>

#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/oren_nayar.h"
#include "scene/bsdf/principled_layers.h"

namespace nephroid {

/// Fuzz, diffuse lobes and subsurface events are D. Coat and base are S or G by their roughness.
/// Both sides scatter alike, except for the refracted share: inside, it meets the boundary from
/// below. Thin smooth walls transmit straight through. `layers` outlives the BSDF.
class PrincipledBsdf final : public Bsdf {
 public:
  PrincipledBsdf(const PrincipledLayers* layers, float specular_alpha);

  ClassMask classes() const override { return classes_; }
  ClassMask finite_classes() const override { return finite_classes_; }
  BsdfEval eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                ClassMask among) const override;
  std::optional<BsdfSample> sample(const Vec3f& wo, float uc, const Vec2f& u, TransportMode mode,
                                   ClassMask among) const override;
  std::optional<std::array<BsdfSample, 2>> delta_pair(const Vec3f& wo,
                                                      TransportMode mode) const override;
  float eta_between(const Vec3f& wo, const Vec3f& wi) const override;
  SampledSpectrum albedo(const Vec3f& wo) const override;

  /// Share of flux along wo that goes straight through.
  SampledSpectrum straight_transmittance(const Vec3f& wo) const;

 private:
  enum Lobe {
    kFuzz,
    kCoat,
    kFacets,    ///< reflection and transmission of the base's facets
    kMultiple,  ///< multiple reflections between metal facets
    kDiffuse,
    kDiffuseThrough,
    kSubsurface,
    kStraight,
    kLobes
  };
  using Shares = std::array<float, kLobes>;
  using Passed = PrincipledLayers::Passed;

  /// Quantities that do not depend on wi.
  struct View {
    Vec3f wo, up;  ///< `up` is wo, turned to the upper side
    Passed passed;
    SampledSpectrum base;  ///< reaches_base
    float side = 1;        ///< sign of wo.z
    bool inside = false;   ///< in the medium below a refracting boundary
    Shares shares{};       ///< probabilities of the lobes; all 0 if none is among those wanted
  };
  View view(const Vec3f& wo, ClassMask among) const;
  /// Approximate shares of flux: lobes of a class in `among`, and straight-through transmission.
  Shares energies(const View& v, ClassMask among) const;

  BsdfEval evaluate(const View& v, const Vec3f& wi, TransportMode mode, EventClass c) const;
  void add_reflection(const View& v, const Vec3f& up, EventClass c, BsdfEval& e) const;
  void add_facets(const View& v, const Vec3f& up, const Passed& passed, BsdfEval& e) const;
  void add_transmission(const View& v, const Vec3f& wi, TransportMode mode, EventClass c,
                        BsdfEval& e) const;
  void add_wall(const View& v, const Vec3f& up, BsdfEval& e) const;
  void add_refraction(const View& v, const Vec3f& wi, TransportMode mode, BsdfEval& e) const;

  /// Shares of flux that a facet at cosine `c` from wo reflects and transmits. `passed` is that of
  /// wi, `outside` that of the direction outside.
  SampledSpectrum facet_reflectance(const View& v, const Passed& passed, float c) const;
  SampledSpectrum facet_transmittance(const View& v, const Passed& outside, float c) const;
  /// Probability that sample() reflects at a facet at cosine `c` from wo.
  float reflection_share(const View& v, float c) const;
  /// Share of diffuse directions that are uniform: rough surfaces are bright at grazing angles.
  float uniform_share() const { return 0.4f * s_.diffuse_roughness; }
  /// Share of flux of the coat's delta lobe if it coincides with a smooth base's, else 0.
  float joined_coat(const View& v) const;

  /// Completes a finite sample with value and density. Empty if its density is 0.
  std::optional<BsdfSample> finish(const View& v, BsdfSample s, TransportMode mode) const;
  std::optional<BsdfSample> sample_facets(const View& v, float uc, const Vec2f& u,
                                          TransportMode mode) const;
  std::optional<BsdfSample> sample_mirror(const View& v, float uc, TransportMode mode) const;
  std::optional<Vec3f> sample_rough(const View& v, float uc, const Vec2f& u) const;
  std::optional<BsdfSample> sample_coat(const View& v, const Vec2f& u) const;
  BsdfSample enter(const View& v) const;
  BsdfSample go_straight(const View& v) const;

  const PrincipledLayers* layers_;
  const PrincipledSurface& s_;
  OrenNayar diffuse_;
  /// Shares of the lobes below the dielectric boundary; through_share_ includes its colour.
  SampledSpectrum diffuse_share_, through_share_, subsurface_share_;
  EventClass coat_class_, facet_class_;
  ClassMask classes_ = ClassMask::kNone, finite_classes_ = ClassMask::kNone;
  bool has_coat_, has_facets_;
  bool facets_transmit_;  ///< transmission is an event of class S or G
};

}  // namespace nephroid
