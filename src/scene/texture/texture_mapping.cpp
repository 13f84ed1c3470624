// The mappings from points to texture coordinates; see texture_mapping.h (pbrt-v4 section 10.2).
#include "scene/texture/texture_mapping.h"

namespace nephroid {

namespace {

/// Textures do not move: an animated transform is used at its start.
Transform world_to_texture(const TextureDescription& description) {
  return Transform(description.transform.start).inverted();
}

/// The largest factor by which it stretches an axis.
float largest_scale(const Transform& t) {
  return std::max(
      {length(t.vector({1, 0, 0})), length(t.vector({0, 1, 0})), length(t.vector({0, 0, 1}))});
}

}  // namespace

TextureMapping2D::TextureMapping2D(const TextureDescription& description)
    : world_to_texture_(world_to_texture(description)) {
  const ParameterSet& p = description.parameters;
  const std::string name = p.get_string("mapping", "uv");
  if (name == "uv") {
    kind_ = Kind::kUv;
    scale_ = {p.get_float("uscale", 1.0f), p.get_float("vscale", 1.0f)};
    offset_ = {p.get_float("udelta", 0.0f), p.get_float("vdelta", 0.0f)};
  } else if (name == "spherical") {
    kind_ = Kind::kSpherical;
  } else if (name == "cylindrical") {
    kind_ = Kind::kCylindrical;
  } else if (name == "planar") {
    kind_ = Kind::kPlanar;
    axis_s_ = p.get_vector3("v1").value_or(Vec3f(1, 0, 0));
    axis_t_ = p.get_vector3("v2").value_or(Vec3f(0, 1, 0));
    offset_ = {p.get_float("udelta", 0.0f), p.get_float("vdelta", 0.0f)};
  } else {
    throw SceneError(p.find("mapping")->where,
                     "unknown texture mapping \"" + name +
                         "\", expected \"uv\", \"spherical\", \"cylindrical\" or \"planar\"");
  }
}

Vec2f TextureMapping2D::map(const TextureContext& context) const {
  if (kind_ == Kind::kUv)
    return {scale_.x * context.uv.x + offset_.x, scale_.y * context.uv.y + offset_.y};
  const Vec3f p = world_to_texture_.point(context.p);
  if (kind_ == Kind::kPlanar) return {offset_.x + dot(p, axis_s_), offset_.y + dot(p, axis_t_)};
  const float phi = std::atan2(p.y, p.x);
  if (kind_ == Kind::kCylindrical) return {(kPi + phi) * kInv2Pi, p.z};
  const float cosine = std::clamp(normalize(p).z, -1.0f, 1.0f);
  return {std::acos(cosine) * kInvPi, (phi < 0.0f ? phi + 2.0f * kPi : phi) * kInv2Pi};
}

TextureDetail TextureMapping2D::detail(const Vec2f& per_st) const {
  if (kind_ == Kind::kUv)
    return {{std::abs(scale_.x) * per_st.x, std::abs(scale_.y) * per_st.y}, 0};
  if (kind_ != Kind::kPlanar) return {};
  return {{0, 0},
          largest_scale(world_to_texture_) *
              std::max(length(axis_s_) * per_st.x, length(axis_t_) * per_st.y)};
}

TextureDetail TextureMapping3D::detail(float per_length) const {
  return {{0, 0}, largest_scale(world_to_texture_) * per_length};
}

TextureMapping3D::TextureMapping3D(const TextureDescription& description)
    : world_to_texture_(world_to_texture(description)) {}

}  // namespace nephroid
