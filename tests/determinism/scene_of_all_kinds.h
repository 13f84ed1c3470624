// A scene with lights, surfaces, media and shapes of every kind, for bit-by-bit comparisons.
#pragma once

namespace nephroid::testing_support {

inline const char* const kScene = R"(
  LookAt 0 1 -6  0 0.8 0  0 1 0
  Camera "perspective" "float fov" 35 "float lensradius" 0.02 "float focaldistance" 6
  Film "rgb" "integer xresolution" 24 "integer yresolution" 20
  PixelFilter "mitchell"
  WorldBegin
  AttributeBegin
    Translate 0 3 0
    AreaLightSource "diffuse" "rgb L" [9 8 7] "bool twosided" true
    Shape "disk" "float radius" 0.5 "float height" 0
  AttributeEnd
  LightSource "point" "rgb I" [2 3 4] "point3 from" [2 2 -3]
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  Material "dielectric" "spectrum eta" "glass-SF11"
  AttributeBegin Translate -0.8 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
  Material "coateddiffuse" "rgb reflectance" [0.2 0.5 0.3] "float roughness" 0.2
  AttributeBegin Translate 0.8 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
  LightSource "infinite" "rgb L" [0.2 0.3 0.4]
  MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [0.7 0.2 0.2]
  MakeNamedMaterial "metal" "string type" "conductor" "float roughness" 0.1
  MakeNamedMaterial "gap" "string type" "interface"
  MakeNamedMaterial "half" "string type" "mix" "string materials" ["paint" "gap"] "float amount" 0.5
  Material "mix" "string materials" ["half" "metal"] "float amount" 0.3
  Shape "bilinearmesh" "point3 P" [-2 0.2 -2  0 0.2 -2  -2 0.2 0  0 0.2 0]
  Material "diffuse" "rgb reflectance" [0.3 0.6 0.3]
  Shape "bilinearmesh" "point3 P" [0 0.3 -2  2 0.3 -2  0 0.3 0  2 0.3 0] "float alpha" 0.5
  ObjectBegin "ball"
    Material "coatedconductor" "float interface.roughness" 0.1 "float conductor.roughness" 0.3
      "float g" 0.4 "rgb albedo" [0.5 0.4 0.3]
    Shape "loopsubdiv" "integer levels" 2
      "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
      "point3 P" [0.5 0 0  -0.5 0 0  0 0.5 0  0 -0.5 0  0 0 0.5  0 0 -0.5]
  ObjectEnd
  AttributeBegin Translate 0 1.6 0.5 ObjectInstance "ball" AttributeEnd
  AttributeBegin Translate -0.2 0.4 -1.5 ActiveTransform EndTime Translate 0.4 0 0 Rotate 150 1 0 1
    ObjectInstance "ball" AttributeEnd
  AttributeBegin Translate -1.2 1.8 1 Scale 1 0.6 1.4 Rotate 40 1 1 0 ObjectInstance "ball" AttributeEnd
  MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 2
    "float density" [0.2 1 0.6 0.1] "rgb sigma_s" [1.5 1 0.5] "rgb sigma_a" [0.1 0.2 0.3]
  AttributeBegin MediumInterface "smoke" "" Material "interface" Translate 0.6 0.6 0.6
    Shape "sphere" "float radius" 0.6 AttributeEnd
  AttributeBegin Material "hair" "float eumelanin" 0.5
    Shape "curve" "point3 P" [-1.2 0.2 -1  -0.4 0.9 -1.3  0.4 0.2 -1  1.2 0.9 -1]
      "float width" 0.1 AttributeEnd
  AttributeBegin Material "subsurface" "rgb mfp" [0.2 0.1 0.05] "rgb reflectance" [0.8 0.6 0.5]
    Translate 1.6 0.5 -0.5 Shape "sphere" "float radius" 0.4 AttributeEnd
  Material "diffuse" "rgb reflectance" [0.4 0.4 0.7]
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
    "point3 P" [-3 0 2  3 0 2  3 3 2.5  -3 3 2.5] "normal N" [-1 0 -1  1 0 -1  1 0 -1  -1 0 -1]
  )";

}  // namespace nephroid::testing_support
