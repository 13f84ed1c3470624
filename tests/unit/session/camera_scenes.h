// Cameras with mirrors, scales and motions, and comparisons of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "input/pbrt_parser.h"
#include "scene/camera/camera.h"
#include "scene/scene.h"

namespace nephroid::testing {

/// Transforms of cameras as files have them.
inline const std::vector<std::string>& camera_transforms() {
  static const std::vector<std::string> transforms = {
      "LookAt 1 2 -5  0 1 0  0 1 0",
      "Scale -1 1 1 LookAt 1 -37 38  -0.2 -1 1.7  0 0 1",
      "Scale 2 2 2 LookAt 3 1 4  0 0 0  0 1 0",
      "Scale -1 2 3 Rotate 30 0 0 1 LookAt 3 1 4  0 0 0  0 1 0",
      "Translate 1 2 9 Rotate 40 1 1 0 Scale 1 2 1",
      "LookAt 3 1 4  0 0 0  0 1 0 Scale 0.1 0.1 -0.1",
      "ConcatTransform [1 0.2 0 0  0.3 1 0.1 0  0 0 2 0  1 2 3 1]"};
  return transforms;
}

constexpr const char* kBall = R"(
  Film "rgb" "integer xresolution" 24 "integer yresolution" 16
  Sampler "sobol" "integer pixelsamples" 4
  WorldBegin
  LightSource "infinite"
  Shape "sphere" "float radius" 2
)";

inline SceneDescription description_of(const std::string& text) {
  Diagnostics diagnostics;
  return parse_pbrt_string(text, "test.pbrt", ".", diagnostics);
}

inline std::unique_ptr<Scene> built(const SceneDescription& description,
                                    const SceneOverrides& overrides = {}) {
  Diagnostics diagnostics;
  return build_scene(description, overrides, diagnostics);
}

/// Largest difference of entries, relative to the largest entry.
inline double difference(const Mat44d& a, const Mat44d& b) {
  double apart = 0, largest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      apart = std::max(apart, std::abs(a[i][j] - b[i][j]));
      largest = std::max(largest, std::abs(b[i][j]));
    }
  return apart / largest;
}

/// Rays over the picture, the lens and the shutter have the same bits.
inline void expect_same_rays(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.film.width, b.film.width);
  ASSERT_EQ(a.film.height, b.film.height);
  for (int i = 0; i < 64; ++i) {
    const Vec2f film(static_cast<float>(i * 7 % 64) / 64 * static_cast<float>(a.film.width),
                     static_cast<float>(i * 11 % 64) / 64 * static_cast<float>(a.film.height));
    const Vec2f lens(static_cast<float>(i * 5 % 64) / 64, static_cast<float>(i * 13 % 64) / 64);
    const float time = static_cast<float>(i) / 64;
    const auto u = a.camera->generate_ray(film, lens, time),
               v = b.camera->generate_ray(film, lens, time);
    ASSERT_EQ(u.has_value(), v.has_value());
    if (!u) continue;
    EXPECT_EQ(u->ray.o, v->ray.o);
    EXPECT_EQ(u->ray.d, v->ray.d);
    EXPECT_EQ(u->ray.time, v->ray.time);
    EXPECT_EQ(u->weight, v->weight);
  }
}

}  // namespace nephroid::testing
