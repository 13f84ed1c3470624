// A room lit only by a spot-lit patch of a wall, so that guiding camera paths pays off.
#pragma once

#include <string>

namespace nephroid::testing_support {

/// The scene's text, with `pixels` on each side. `ball` is the material of a ball on the floor.
inline std::string lit_patch(const std::string& ball, int pixels) {
  const std::string side = std::to_string(pixels);
  return R"(
  LookAt 0 2.5 -4  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 40
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  Film "rgb" "integer xresolution" )" +
         side + R"( "integer yresolution" )" + side + R"(
  WorldBegin
  LightSource "spot" "rgb I" [90 80 70] "point3 from" [0 3 -1] "point3 to" [0 2 4]
    "float coneangle" 16 "float conedeltaangle" 4
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Shape "bilinearmesh" "point3 P" [-6 0 4  6 0 4  -6 6 4  6 6 4]
  )" + ball +
         R"(
  AttributeBegin Translate 0 0.6 0 Shape "sphere" "float radius" 0.6 AttributeEnd)";
}

}  // namespace nephroid::testing_support
