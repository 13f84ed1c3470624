// The materials "mix", which is one of two others at each point, and "interface", which is no
// surface. It must not know the materials that it mixes.
#include <algorithm>
#include <bit>
#include <string>

#include "core/counted.h"
#include "core/sampler.h"
#include "scene/material/inputs.h"
#include "scene/material/table.h"

namespace nephroid {
namespace {

class MixMaterial final : public Material {
 public:
  MixMaterial(const MaterialDescription& d, const MaterialContext& c)
      : amount_(c.textures.float_texture(d.parameters, "amount", 0.5f)), salt_(c.index) {
    const Parameter* names = d.parameters.find("materials", {"string"});
    if (!names || names->strings.size() != 2)
      throw SceneError(names ? names->where : d.where,
                       "\"mix\" has " + counted(names ? names->strings.size() : 0, "name") +
                           " in \"string materials\", expected two");
    for (int i = 0; i < 2; ++i) {
      materials_[i] = c.named(names->strings[i], names->where);
      if (const auto* mix = dynamic_cast<const MixMaterial*>(materials_[i].get()))
        depth_ = std::max(depth_, mix->depth_ + 1);
    }
    if (depth_ > kDeepestMixture) refuse_deep_mixture(names->where);
  }

  const Material* resolve(const SurfaceInteraction& point) const override {
    const float amount = amount_.at(point);
    if (amount <= 0.0f) return materials_[0]->resolve(point);
    if (amount >= 1.0f) return materials_[1]->resolve(point);
    return materials_[hash(point) < amount ? 1 : 0]->resolve(point);
  }
  std::span<const MaterialPtr> choices() const override { return materials_; }
  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                        float specular_alpha, BsdfArena& arena) const override {
    return resolve(point)->make_bsdf(point, lambda, specular_alpha, arena);
  }
  void bump(SurfaceInteraction& point) const override { resolve(point)->bump(point); }
  bool has_bump() const override { return materials_[0]->has_bump() || materials_[1]->has_bump(); }
  bool is_interface() const override {
    return materials_[0]->is_interface() && materials_[1]->is_interface();
  }
  bool transmits_straight() const override {
    return materials_[0]->transmits_straight() || materials_[1]->transmits_straight();
  }
  SampledSpectrum straight_transmittance(const SurfaceInteraction& point,
                                         const SampledWavelengths& lambda) const override {
    return resolve(point)->straight_transmittance(point, lambda);
  }
  float presence(const SurfaceInteraction& point) const override {
    const float amount = std::clamp(amount_.at(point), 0.0f, 1.0f);
    return (1.0f - amount) * materials_[0]->presence(point) +
           amount * materials_[1]->presence(point);
  }
  ClassMask possible_classes() const override {
    return materials_[0]->possible_classes() | materials_[1]->possible_classes();
  }
  ClassMask merging_classes() const override {
    return materials_[0]->merging_classes() | materials_[1]->merging_classes();
  }

 private:
  float hash(const SurfaceInteraction& s) const {
    uint64_t h = salt_;
    for (const float x : {s.p.x, s.p.y, s.p.z, s.wo.x, s.wo.y, s.wo.z})
      h = hash_combine(h, std::bit_cast<uint32_t>(x));
    return bits_to_unit_float(static_cast<uint32_t>(h >> 32));
  }

  FloatInput amount_;
  MaterialPtr materials_[2];
  int depth_ = 1;  ///< nesting depth of mixes
  uint64_t salt_;  ///< decorrelates the choices of nested mixes
};

class InterfaceMaterial final : public Material {
 public:
  const Bsdf* make_bsdf(const SurfaceInteraction&, SampledWavelengths&, float,
                        BsdfArena&) const override {
    return nullptr;
  }
  bool is_interface() const override { return true; }
  ClassMask possible_classes() const override { return ClassMask::kNone; }
};

}  // namespace

void refuse_deep_mixture(const SourceLocation& where) {
  throw SceneError(where, "materials \"mix\" are nested more than " +
                              std::to_string(kDeepestMixture) +
                              " levels deep, expected fewer levels");
}

NewMaterial make_mix(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<MixMaterial>(d, c);
}

NewMaterial make_interface(const MaterialDescription&, const MaterialContext&) {
  return std::make_shared<InterfaceMaterial>();
}

}  // namespace nephroid
