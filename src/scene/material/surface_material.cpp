// Bump and normal mapping; see surface_material.h.
#include "scene/material/surface_material.h"

namespace nephroid {
namespace {

/// Finite difference step in uv if the size of a pixel is unknown.
constexpr float kBumpStep = 0.0005f;

struct Tangents {
  Vec3f dpdu, dpdv;
};

Tangents bumped(const SurfaceInteraction& s, const FloatTexture& displacement) {
  const TextureContext here(s);
  const float d = displacement.eval(here);
  const auto tilted = [&](const Vec3f& dp, const Vec3f& dn, const Vec2f& step) {
    TextureContext moved = here;
    moved.p = here.p + dp * kBumpStep;
    moved.uv = here.uv + step;
    const float slope = (displacement.eval(moved) - d) / kBumpStep;
    return dp + s.shading.z * slope + dn * d;
  };
  return {tilted(s.shading_dpdu, s.dndu, Vec2f(kBumpStep, 0)),
          tilted(s.shading_dpdv, s.dndv, Vec2f(0, kBumpStep))};
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
