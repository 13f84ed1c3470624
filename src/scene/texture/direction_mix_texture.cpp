// Texture class "directionmix": the first texture where the surface faces a direction or its
// opposite, the second where it is perpendicular, mixed by the cosine.
#include "scene/texture/texture_table.h"

namespace nephroid {

namespace {

/// |cosine| between the geometric normal and the direction "dir" of the texture's frame.
class FacingWeight {
 public:
  explicit FacingWeight(const TextureDescription& description) {
    const ParameterSet& p = description.parameters;
    // Textures do not move: an animated transform is used at its start.
    const Vec3f dir = p.get_vector3("dir").value_or(Vec3f(0, 1, 0));
    direction_ = normalize(Transform(description.transform.start).vector(dir));
    if (!is_finite(direction_) || !(max_component(abs(direction_)) > 0.0f))
      throw SceneError(p.find("dir") ? p.find("dir")->where : description.where,
                       "\"vector3 dir\" of texture \"" + description.name +
                           "\" has no direction, expected a vector of finite length above 0");
  }
  float operator()(const TextureContext& context) const {
    return std::abs(dot(context.n, direction_));
  }

 private:
  Vec3f direction_;
};

class DirectionMixFloatTexture final : public FloatTexture {
 public:
  DirectionMixFloatTexture(FacingWeight weight, FloatTexturePtr facing, FloatTexturePtr across)
      : weight_(weight), facing_(std::move(facing)), across_(std::move(across)) {}
  float eval(const TextureContext& context) const override {
    const float w = weight_(context);
    // A texture of weight 0 is not evaluated: it can be expensive or not finite.
    if (w == 0.0f) return across_->eval(context);
    if (w == 1.0f) return facing_->eval(context);
    return lerp(w, across_->eval(context), facing_->eval(context));
  }
  TextureDetail detail() const override { return facing_->detail().and_also(across_->detail()); }

 private:
  FacingWeight weight_;
  FloatTexturePtr facing_, across_;
};

class DirectionMixSpectrumTexture final : public SpectrumTexture {
 public:
  DirectionMixSpectrumTexture(FacingWeight weight, SpectrumTexturePtr facing,
                              SpectrumTexturePtr across)
      : weight_(weight), facing_(std::move(facing)), across_(std::move(across)) {}
  SampledSpectrum eval(const TextureContext& context,
                       const SampledWavelengths& lambda) const override {
    const float w = weight_(context);
    if (w == 0.0f) return across_->eval(context, lambda);
    if (w == 1.0f) return facing_->eval(context, lambda);
    return lerp(w, across_->eval(context, lambda), facing_->eval(context, lambda));
  }

 private:
  FacingWeight weight_;
  SpectrumTexturePtr facing_, across_;
};

}  // namespace

FloatTexturePtr make_float_directionmix(const TextureDescription& description,
                                        TextureScope& scope) {
  const ParameterSet& p = description.parameters;
  return std::make_shared<DirectionMixFloatTexture>(FacingWeight(description),
                                                    scope.float_texture(p, "tex1", 0.0f),
                                                    scope.float_texture(p, "tex2", 1.0f));
}

SpectrumTexturePtr make_spectrum_directionmix(const TextureDescription& description,
                                              SpectrumKind kind, TextureScope& scope) {
  const ParameterSet& p = description.parameters;
  return std::make_shared<DirectionMixSpectrumTexture>(
      FacingWeight(description), scope.spectrum_texture(p, "tex1", kind, 0.0f),
      scope.spectrum_texture(p, "tex2", kind, 1.0f));
}

}  // namespace nephroid
