// The Trowbridge-Reitz (GGX) distribution, height-correlated Smith shadowing, and exact sampling of
// visible normals. With s(w) = sqrt(z^2 + ax^2 x^2 + ay^2 y^2) the Smith terms divide by no cosine
// and stay exact at grazing angles: G1(w) = 2z/(z+s), G2(o,i) = 2 zo zi/(so zi + si zo). It must
// not know Fresnel terms or lobes. Papers: Heitz 2014, 2018; Dupuy & Benyoub 2023.
#pragma once

#include "core/math.h"
#include "scene/bsdf/bsdf.h"

namespace nephroid {

class TrowbridgeReitz {
 public:
  /// Perfectly smooth.
  TrowbridgeReitz() = default;
  /// Like pbrt-v4: smooth if both are below 1e-3; else both are clamped to at least 1e-4.
  TrowbridgeReitz(float alpha_x, float alpha_y)
      : smooth_(std::max(alpha_x, alpha_y) < 1e-3f),
        alpha_x_(smooth_ ? alpha_x : std::max(alpha_x, 1e-4f)),
        alpha_y_(smooth_ ? alpha_y : std::max(alpha_y, 1e-4f)) {}

  static float roughness_to_alpha(float roughness) { return safe_sqrt(roughness); }

  bool smooth() const { return smooth_; }
  float alpha_x() const { return alpha_x_; }
  float alpha_y() const { return alpha_y_; }
  float max_alpha() const { return std::max(alpha_x_, alpha_y_); }

  /// Class of a lobe with this roughness: S if smooth or at most `specular_alpha`, else G.
  EventClass event_class(float specular_alpha) const {
    return smooth_ || max_alpha() <= specular_alpha ? EventClass::kSpecular : EventClass::kGlossy;
  }

  /// Density of facet normals per projected area, 1/sr, at the unit normal m.
  float d(const Vec3f& m) const {
    const float x = m.x / alpha_x_, y = m.y / alpha_y_;
    const float e = x * x + y * y + m.z * m.z;
    return 1.0f / (kPi * alpha_x_ * alpha_y_ * e * e);
  }
  /// s(w) of the file's head.
  float s(const Vec3f& w) const {
    return std::sqrt(w.z * w.z + sqr(alpha_x_ * w.x) + sqr(alpha_y_ * w.y));
  }
  /// G2(o,i) / (4 zo zi); zo, zi > 0 are the absolute cosines.
  static float g2_over_4zz(float so, float zo, float si, float zi) {
    return 0.5f / (so * zi + si * zo);
  }
  /// Density pdf_w of visible facets at m, seen from w on either side of the surface.
  float visible_pdf_w(const Vec3f& w, const Vec3f& m) const {
    return 2.0f * d(m) * abs_dot(w, m) / (std::abs(w.z) + s(w));
  }
  /// Density pdf_w of the reflection of w about a visible facet m.
  float reflection_pdf_w(const Vec3f& w, const Vec3f& m) const {
    return 0.5f * d(m) / (std::abs(w.z) + s(w));
  }

  /// Samples a facet normal (z >= 0) visible from w, with density visible_pdf_w.
  Vec3f sample_visible(const Vec3f& w, const Vec2f& u) const {
    // In the space where the facets are a hemisphere, the visible normal halves the angle between
    // the direction and a uniform point of the spherical cap z > -cos.
    Vec3f stretched = normalize(Vec3f(alpha_x_ * w.x, alpha_y_ * w.y, w.z));
    if (stretched.z < 0.0f) stretched = -stretched;
    const float up = (1.0f - u.y) * (1.0f + stretched.z);
    const float z = up - stretched.z;
    const float r = safe_sqrt(1.0f - z * z);
    const float phi = 2.0f * kPi * u.x;
    const Vec3f half(r * std::cos(phi) + stretched.x, r * std::sin(phi) + stretched.y, up);
    const Vec3f m(alpha_x_ * half.x, alpha_y_ * half.y, half.z);
    return length_squared(m) > 0.0f ? normalize(m) : Vec3f(0, 0, 1);
  }

 private:
  bool smooth_ = true;
  float alpha_x_ = 0, alpha_y_ = 0;
};

}  // namespace nephroid
