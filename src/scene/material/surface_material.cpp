// Bump and normal mapping; see surface_material.h.
#include "scene/material/surface_material.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid {
namespace {

/// The largest finite difference step in uv: pbrt-v4's where it does not know the size of a pixel.
constexpr float kBumpStep = 0.0005f;
/// The smallest step over the rounding error of u or p.
constexpr float kMinSteps = 4;

struct Tangents {
  Vec3f dpdu, dpdv;
};

/// A step from `u` and `p` over half of the finest detail along dp, as long as rounding leaves it.
float bump_step(float u, float detail_of_uv, const Vec3f& p, const Vec3f& dp, float detail_of_p) {
  constexpr float kRounding = kMinSteps * std::numeric_limits<float>::epsilon();
  const float along = length(dp);
  const float finest = std::max(detail_of_uv, detail_of_p * along);
  float step = finest > 0 ? std::min(kBumpStep, 0.5f / finest) : kBumpStep;
  step = std::max({step, kRounding * std::abs(u), 1e-12f});
  if (detail_of_p > 0 && along > 0)
    step = std::max(step, kRounding * max_component(abs(p)) / along);
  return (u + step) - u;
}

Tangents bumped(const SurfaceInteraction& s, const FloatTexture& displacement) {
  const TextureContext here(s);
  const float d = displacement.eval(here);
  const TextureDetail detail = displacement.detail();
  const float du = bump_step(here.uv.x, detail.per_uv.x, here.p, s.shading_dpdu, detail.per_length);
  const float dv = bump_step(here.uv.y, detail.per_uv.y, here.p, s.shading_dpdv, detail.per_length);
  const auto tilted = [&](const Vec3f& dp, const Vec3f& dn, float step, const Vec2f& in_uv) {
    TextureContext moved = here;
    moved.p = here.p + dp * step;
    moved.uv = here.uv + in_uv;
    const float slope = (displacement.eval(moved) - d) / step;
    return dp + s.shading.z * slope + dn * d;
  };
  return {tilted(s.shading_dpdu, s.dndu, du, Vec2f(du, 0)),
          tilted(s.shading_dpdv, s.dndv, dv, Vec2f(0, dv))};
}

Tangents normal_mapped(const SurfaceInteraction& s, const NormalMap& map) {
  const Frame frame = Frame::from_z_and_tangent(s.shading.z, s.shading_dpdu);
  Vec3f local = map.at(TextureContext(s));
  if (map.obeys_handedness() && dot(cross(s.dpdu, s.dpdv), s.ng) < 0.0f) local.y = -local.y;
  const Vec3f n = frame.to_world(normalize(local));
  const Vec3f u = normalize(s.shading_dpdu - n * dot(s.shading_dpdu, n));
  return {u * length(s.shading_dpdu), normalize(cross(n, u)) * length(s.shading_dpdv)};
}

}  // namespace

NormalMap::NormalMap(const ParameterSet& parameters, SceneFiles& files)
    : placement_(parameters, "normalmap.", WrapMode::kRepeat),
      scale_(parameters.get_float("normalmap.scale", 1.0f)),
      obeys_handedness_(parameters.get_bool("normalmap.handedness", false)) {
  placement_.choose_set(parameters, "normalmap.");
  const FileSource file = files.source_of(parameters.get_string("normalmap", ""));
  const SourceLocation& where = parameters.find("normalmap")->where;
  image_ = read_stored_image(file, where);
  if (image_->channels() < 3)
    throw SceneError(where, "normal map \"" + file.path + "\" is grey, expected three channels");
}

Vec3f NormalMap::at(const TextureContext& context) const {
  const Vec2f st = placement_.in_image(placement_.coordinates(context));
  const Rgb c = image_->bilinear(st, placement_.wrap());
  const Vec3f n = Vec3f(c.r, c.g, c.b) * 2.0f - Vec3f(1.0f);
  return {n.x * scale_, n.y * scale_, n.z};
}

SurfaceMaterial::SurfaceMaterial(const MaterialDescription& description,
                                 const MaterialContext& context) {
  displacement_ = context.textures.float_texture(description.parameters, "displacement");
  if (description.parameters.get_string("normalmap", "").empty()) return;
  if (displacement_)
    context.diagnostics.warn(description.where,
                             "material has both \"displacement\" and \"normalmap\"; only the "
                             "normal map is used");
  normal_map_ = std::make_shared<NormalMap>(description.parameters, context.files);
}

void SurfaceMaterial::bump(SurfaceInteraction& s) const {
  if (!has_bump()) return;
  const Tangents t = normal_map_ ? normal_mapped(s, *normal_map_) : bumped(s, *displacement_);
  const Vec3f n = normalize(cross(t.dpdu, t.dpdv));
  // Without a usable parametrisation the surface keeps its frame.
  if (!is_finite(n) || !(length_squared(n) > 0.5f)) return;
  s.shading = Frame::from_z_and_tangent(face_forward(n, s.ng), t.dpdu);
  s.shading_dpdu = t.dpdu;
  s.shading_dpdv = t.dpdv;
}

}  // namespace nephroid
