// Mitsuba's BSDFs on a sphere, for tests of the materials that they become.
#pragma once

#include <string>

#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {

/// `<bsdf type="type">body</bsdf>`
inline std::string bsdf(const std::string& type, const std::string& body = "") {
  return "<bsdf type=\"" + type + "\">" + body + "</bsdf>";
}

/// The scene with one sphere of this BSDF.
inline SceneDescription with_bsdf(MitsubaScene& scene, const std::string& element,
                                  const std::string& version = "0.6.0") {
  return scene.read("<shape type=\"sphere\">" + element + "</shape>\n", version);
}

/// The material of that sphere.
inline MaterialDescription material_of(const std::string& element,
                                       const std::string& version = "0.6.0") {
  MitsubaScene scene;
  const SceneDescription d = with_bsdf(scene, element, version);
  return material(d, d.shapes.at(0).material.name);
}

}  // namespace nephroid::testing
