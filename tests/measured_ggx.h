// A synthetic "measurement": tables of a tinted Trowbridge-Reitz surface in the parametrisation of
// Dupuy & Jakob 2018, and the bytes of its file.
#pragma once

#include <bit>
#include <string>
#include <string_view>

#include "scene/bsdf/measured.h"
#include "scene/bsdf/microfacet.h"

namespace nephroid::testing_measured {

/// The surface and the sizes of its tables.
struct GgxSurface {
  float alpha_x = 0.3f, alpha_y = 0.3f;
  size_t azimuths = 1;  ///< more than two if anisotropic
  int symmetry = 1;     ///< the azimuths span one turn divided by this
  size_t polar = 12;    ///< polar angles of the outgoing direction
  size_t normals = 64;  ///< nodes of the facet tables along each side
  size_t nodes = 24;    ///< nodes of the spectra along each side
  size_t wavelengths = 3;

  TrowbridgeReitz facets() const { return {alpha_x, alpha_y}; }
  /// Reflectance of a facet: rises linearly with the wavelength (nm).
  static float tint(float lambda) { return 0.2f + 0.6f * (lambda - 360.0f) / 470.0f; }
  /// f without the cosine; both directions are above the surface.
  float f(const Vec3f& wo, const Vec3f& wi, float lambda) const {
    const TrowbridgeReitz t = facets();
    return tint(lambda) * t.d(normalize(wo + wi)) *
           TrowbridgeReitz::g2_over_4zz(t.s(wo), wo.z, t.s(wi), wi.z);
  }
};

inline Vec3f polar_direction(float theta, float phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}
inline float node_place(size_t i, size_t count) {
  return count < 2 ? 0.0f : static_cast<float>(i) / static_cast<float>(count - 1);
}

/// A grid of value(x, y) at the nodes of the unit square.
template <class Value>
GridFamily tabulate(size_t width, size_t height, const Value& value) {
  GridFamily grid{width, height, {}};
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x)
      grid.values.push_back(value(node_place(x, width), node_place(y, height)));
  return grid;
}

/// Appends a grid of the same size.
inline void append(GridFamily& family, const GridFamily& grid) {
  family.width = grid.width;
  family.height = grid.height;
  family.values.insert(family.values.end(), grid.values.begin(), grid.values.end());
}

inline Vec3f normal_at(float x, float y, float turn) {
  return polar_direction(0.5f * kPi * x * x, (2.0f * y - 1.0f) * kPi + turn);
}

inline MeasuredTables tables_of(const GgxSurface& surface) {
  const TrowbridgeReitz facets = surface.facets();
  const bool isotropic = surface.azimuths <= 2;
  MeasuredTables t;
  for (size_t i = 0; i < surface.azimuths; ++i)
    t.phi.push_back(-kPi + 2.0f * kPi * node_place(i, surface.azimuths) /
                               static_cast<float>(surface.symmetry));
  for (size_t i = 0; i < surface.polar; ++i)
    t.theta.push_back(0.5f * kPi * node_place(i, surface.polar));
  for (size_t i = 0; i < surface.wavelengths; ++i)
    t.wavelengths.push_back(360.0f + 470.0f * node_place(i, surface.wavelengths));
  const auto area = [&](const Vec3f& w) { return 0.5f * (w.z + facets.s(w)); };
  t.facets = tabulate(surface.normals, surface.normals,
                      [&](float x, float y) { return facets.d(normal_at(x, y, 0)); });
  t.projected_area = tabulate(surface.normals, surface.normals,
                              [&](float x, float y) { return area(normal_at(x, y, 0)); });

  for (const float phi : t.phi) {
    for (const float theta : t.theta) {
      const Vec3f wo = polar_direction(theta, phi);
      const float turn = isotropic ? phi : 0.0f;
      // Density over the square: visible facets times [R2].
      const GridFamily seen = tabulate(surface.normals, surface.normals, [&](float x, float y) {
        const Vec3f m = normal_at(x, y, turn);
        return facets.d(m) * std::max(0.0f, dot(wo, m)) * x * std::sin(0.5f * kPi * x * x);
      });
      append(t.visible_facets, seen);
      const BilinearWarp warp(seen);
      GridMix only;
      only.add(0, 1.0f);
      const GridFamily ratio = tabulate(surface.nodes, surface.nodes, [&](float x, float y) {
        const Vec2f n = warp.sample({x, y}, only).p;
        const Vec3f m = normal_at(n.x, n.y, turn);
        const Vec3f wi = m * (2.0f * dot(wo, m)) - wo;
        const float cos_i = wi.z;
        if (!(cos_i > 0.0f)) return 0.0f;
        // f cos / (D / (4 area)) without the tint.
        const float cos_o = std::max(wo.z, 1e-6f);
        return TrowbridgeReitz::g2_over_4zz(facets.s(wo), cos_o, facets.s(wi), cos_i) * cos_i *
               4.0f * area(wo);
      });
      append(t.luminance, ratio);
      for (const float lambda : t.wavelengths) {
        GridFamily tinted = ratio;
        for (float& v : tinted.values) v *= GgxSurface::tint(lambda);
        append(t.spectra, tinted);
      }
    }
  }
  return t;
}

/// Writes tensor files field by field.
class TensorBytes {
 public:
  struct Field {
    std::string name;
    uint8_t type;
    std::vector<uint64_t> shape;
    std::string data;
  };
  void add(Field field) { fields_.push_back(std::move(field)); }
  void add(const std::string& name, const std::vector<uint64_t>& shape,
           const std::vector<float>& values) {
    Field field{name, 10, shape, {}};
    for (const float v : values) append_number(field.data, std::bit_cast<uint32_t>(v), 4);
    add(std::move(field));
  }
  static void append_number(std::string& to, uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i) & 0xFF);
  }
  std::string bytes() const {
    size_t offset = 18;
    for (const Field& f : fields_) offset += 13 + f.name.size() + 8 * f.shape.size();
    std::string table("tensor_file\0\1\0", 14), data;
    append_number(table, fields_.size(), 4);
    for (const Field& f : fields_) {
      append_number(table, f.name.size(), 2);
      table += f.name;
      append_number(table, f.shape.size(), 2);
      append_number(table, f.type, 1);
      append_number(table, offset + data.size(), 8);
      for (const uint64_t extent : f.shape) append_number(table, extent, 8);
      data += f.data;
    }
    return table + data;
  }

 private:
  std::vector<Field> fields_;
};

/// The file that holds the tables.
inline std::string bsdf_file_of(const MeasuredTables& t) {
  TensorBytes file;
  const auto grid = [&](const char* name, std::vector<uint64_t> shape, const GridFamily& g) {
    shape.push_back(g.height);
    shape.push_back(g.width);
    file.add(name, shape, g.values);
  };
  const std::string text = "synthetic";
  file.add({"description", 1, {text.size()}, text});
  file.add("phi_i", {t.phi.size()}, t.phi);
  file.add("theta_i", {t.theta.size()}, t.theta);
  file.add("wavelengths", {t.wavelengths.size()}, t.wavelengths);
  grid("ndf", {}, t.facets);
  grid("sigma", {}, t.projected_area);
  grid("vndf", {t.phi.size(), t.theta.size()}, t.visible_facets);
  grid("luminance", {t.phi.size(), t.theta.size()}, t.luminance);
  grid("spectra", {t.phi.size(), t.theta.size(), t.wavelengths.size()}, t.spectra);
  file.add({"jacobian", 1, {1}, std::string(1, t.values_are_ratios ? '\1' : '\0')});
  return file.bytes();
}

}  // namespace nephroid::testing_measured
