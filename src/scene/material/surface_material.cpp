// Bump and normal mapping; see surface_material.h.
#include "scene/material/surface_material.h"

#include <OpenImageIO/imageio.h>

#include <filesystem>

#include "scene/texture/image_file.h"

namespace nephroid {
namespace {

/// Step of the finite differences in uv when nothing is known of the size of a pixel.
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
  const Vec3f n = frame.to_world(normalize(map.at(s.uv)));
  const Vec3f u = normalize(s.shading_dpdu - n * dot(s.shading_dpdu, n));
  return {u * length(s.shading_dpdu), normalize(cross(n, u)) * length(s.shading_dpdv)};
}

int wrapped(int i, int size) {
  const int r = i % size;
  return r < 0 ? r + size : r;
}

}  // namespace

NormalMap::NormalMap(const std::string& file, const SourceLocation& where) {
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file, &wish);
  if (!input) image_is_unreadable(file, OIIO::geterror(), where);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.nchannels < 3)
    throw SceneError(where, "normal map \"" + file + "\" has " + std::to_string(spec.nchannels) +
                                " channels, expected three");
  width_ = spec.width;
  height_ = spec.height;
  rgb_.resize(static_cast<size_t>(width_) * height_ * 3);
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, rgb_.data()))
    image_is_unreadable(file, input->geterror(), where);
}

Vec3f NormalMap::texel(int x, int y) const {
  const size_t i = (static_cast<size_t>(wrapped(y, height_)) * width_ + wrapped(x, width_)) * 3;
  return Vec3f(rgb_[i], rgb_[i + 1], rgb_[i + 2]) * 2.0f - Vec3f(1.0f);
}

Vec3f NormalMap::at(const Vec2f& uv) const {
  const float u = uv.x - std::floor(uv.x), v = 1.0f - uv.y - std::floor(1.0f - uv.y);
  const float x = u * static_cast<float>(width_) - 0.5f;
  const float y = v * static_cast<float>(height_) - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  return (texel(x0, y0) * (1 - fx) + texel(x0 + 1, y0) * fx) * (1 - fy) +
         (texel(x0, y0 + 1) * (1 - fx) + texel(x0 + 1, y0 + 1) * fx) * fy;
}

SurfaceMaterial::SurfaceMaterial(const MaterialDescription& description,
                                 const MaterialContext& context) {
  displacement_ = context.textures.float_texture(description.parameters, "displacement");
  const std::string file = description.parameters.get_string("normalmap", "");
  if (file.empty()) return;
  if (displacement_)
    context.diagnostics.warn(description.where,
                             "material has both \"displacement\" and \"normalmap\"; only the "
                             "normal map is used");
  const auto path = std::filesystem::path(context.directory) / file;
  normal_map_ =
      std::make_shared<NormalMap>(path.string(), description.parameters.find("normalmap")->where);
}

void SurfaceMaterial::bump(SurfaceInteraction& s) const {
  if (!has_bump()) return;
  const Tangents t = normal_map_ ? normal_mapped(s, *normal_map_) : bumped(s, *displacement_);
  const Vec3f n = normalize(cross(t.dpdu, t.dpdv));
  // A surface without a usable parametrisation has nothing to tilt.
  if (!is_finite(n) || !(length_squared(n) > 0.5f)) return;
  s.shading = Frame::from_z_and_tangent(face_forward(n, s.ng), t.dpdu);
  s.shading_dpdu = t.dpdu;
  s.shading_dpdv = t.dpdv;
}

}  // namespace nephroid
