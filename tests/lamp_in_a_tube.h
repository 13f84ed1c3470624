// A room in which camera paths rarely find the lamp: it stands in a tube and lights the ceiling
// above. Trials then choose to merge photons of all light.
#pragma once

#include <string>

namespace nephroid::testing_support {

/// The text of the scene seen by `camera`, with `pixels` on each side.
inline std::string lamp_in_a_tube(const std::string& camera, int pixels) {
  const std::string side = std::to_string(pixels);
  return camera + R"(
  Film "rgb" "integer xresolution" )" +
         side + R"( "integer yresolution" )" + side + R"(
  PixelFilter "box"
  WorldBegin
  AttributeBegin
    Translate 0 1 0 Rotate -90 1 0 0
    AreaLightSource "diffuse" "rgb L" [300 270 240] Shape "disk" "float radius" 0.08
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.7 0.6 0.5]
  AttributeBegin
    Translate 0 0.6 0 Rotate -90 1 0 0
    Shape "cylinder" "float radius" 0.2 "float zmin" 0 "float zmax" 0.8
  AttributeEnd
  Shape "bilinearmesh" "point3 P" [-3 0 -5  3 0 -5  -3 0 3  3 0 3]
  Shape "bilinearmesh" "point3 P" [-3 3 -5  3 3 -5  -3 3 3  3 3 3]
  Shape "bilinearmesh" "point3 P" [-3 0 3  3 0 3  -3 3 3  3 3 3]
)";
}

}  // namespace nephroid::testing_support
