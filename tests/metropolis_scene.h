// A small scene for Markov chains: a lamp, a floor and a metal ball. It has three parts, so that
// tests can exchange the film.
#pragma once

#include <string>

namespace nephroid::testing_support {

inline const std::string kHead = R"(
  LookAt 0 3 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 30
  PixelFilter "mitchell"
)";
inline const std::string kFilm = R"(Film "rgb" "integer xresolution" 12 "integer yresolution" 12 )";
inline const std::string kWorld = R"(
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Material "conductor" "float roughness" 0.2
  Translate 0.3 0.5 0 Shape "sphere" "float radius" 0.5
)";

}  // namespace nephroid::testing_support
