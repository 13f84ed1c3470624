// Materials from a few parameters, and a point on a flat surface to evaluate them at. It must not
// know single materials.
#pragma once

#include "scene/material/material.h"
#include "scene/material/table.h"

namespace nephroid::testing_support {

inline Parameter numbers(const std::string& type, const std::string& name,
                         std::vector<double> values) {
  Parameter p;
  p.type = type;
  p.name = name;
  p.numbers = std::move(values);
  return p;
}

inline Parameter strings(const std::string& type, const std::string& name,
                         std::vector<std::string> values) {
  Parameter p;
  p.type = type;
  p.name = name;
  p.strings = std::move(values);
  return p;
}

inline Parameter boolean(const std::string& name, bool value) {
  Parameter p;
  p.type = "bool";
  p.name = name;
  p.bools = {value};
  return p;
}

inline MaterialDescription material(const std::string& type, std::vector<Parameter> parameters = {},
                                    const std::string& name = "") {
  MaterialDescription d;
  d.type = type;
  d.name = name;
  d.where = {std::make_shared<const std::string>("scene.pbrt"), 7, 3};
  d.parameters.where = d.where;
  for (Parameter& p : parameters) p.where = d.where;
  d.parameters.list = std::move(parameters);
  return d;
}

struct Made {
  SceneDescription description;
  Diagnostics diagnostics;
  std::vector<MaterialPtr> materials;

  explicit Made(std::vector<MaterialDescription> list, const MaterialSettings& settings = {}) {
    description.materials = std::move(list);
    const TextureLibrary textures(description, diagnostics);
    materials = make_materials(description, textures, settings, diagnostics);
  }
};

/// The located error message of making these materials; empty if there is none.
inline std::string error_of(std::vector<MaterialDescription> list) {
  try {
    Made made(std::move(list));
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

inline SurfaceInteraction flat_point(const Vec3f& p = {0.3f, 0.4f, 0.0f}) {
  SurfaceInteraction s;
  s.p = p;
  s.ng = Vec3f(0, 0, 1);
  s.wo = normalize(Vec3f(0.3f, 0.2f, 0.8f));
  s.uv = Vec2f(p.x, p.y);
  s.dpdu = s.shading_dpdu = Vec3f(1, 0, 0);
  s.dpdv = s.shading_dpdv = Vec3f(0, 1, 0);
  s.dndu = s.dndv = Vec3f(0, 0, 0);
  return s;
}

inline constexpr float kSpecularAlpha = 0.05f;
inline const Vec3f kWo = normalize(Vec3f(0.5f, 0.0f, 0.7f));
inline const Vec3f kWi = normalize(Vec3f(-0.2f, 0.3f, 0.9f));

/// Evaluates class `c` at a flat point, from kWo to kWi.
inline BsdfEval eval_of(const Material& m, EventClass c) {
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.3f);
  BsdfArena arena;
  return m.make_bsdf(flat_point(), lambda, kSpecularAlpha, arena)
      ->eval(kWo, kWi, TransportMode::kRadiance, c, ClassMask::kAll);
}

}  // namespace nephroid::testing_support
