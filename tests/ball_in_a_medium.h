// A ball that fills most of the picture; its glass shows a lamp and a sky.
#pragma once

#include <string>

namespace nephroid::testing_support {

inline const std::string kBall = R"(
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 8 "integer yresolution" 8
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  WorldBegin
  LightSource "infinite" "rgb L" [0.2 0.3 0.4]
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [30 27 24]
    Translate 1 2 -1 Shape "sphere" "float radius" 0.8
  AttributeEnd
  MediumInterface "inside" ""
  Translate 0 0 3
)";
inline const std::string kClear =
    R"(MakeNamedMedium "inside" "string type" "homogeneous" "rgb sigma_a" [0.3 0.2 0.1] "rgb sigma_s" [0 0 0])";
inline const std::string kMilky =
    R"(MakeNamedMedium "inside" "string type" "homogeneous" "rgb sigma_a" [0.1 0.1 0.1] "rgb sigma_s" [0.3 0.2 0.1])";

inline const std::string kSphere = R"( Shape "sphere" "float radius" 1)";

/// The scene with a ball of this inner medium, material and shape.
inline std::string ball(const std::string& medium, const std::string& material,
                        const std::string& shape = kSphere) {
  std::string text = kBall;
  text.insert(text.find("WorldBegin") + 10, "\n" + medium + "\n");
  return text + material + shape;
}

}  // namespace nephroid::testing_support
