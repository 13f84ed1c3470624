// Cameras from scene text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "input/pbrt_parser.h"
#include "scene/camera/camera.h"
#include "source_directory.h"

namespace nephroid::testing_support {

/// File names are relative to this folder.
inline std::unique_ptr<Camera> camera_of(const std::string& text, int width, int height,
                                         float diagonal_mm = 35) {
  Diagnostics diagnostics;
  const SceneDescription d =
      parse_pbrt_string(text + "\nWorldBegin", "test.pbrt",
                        testing_support::source_directory() + "/tests/unit/camera", diagnostics);
  return make_camera(d, {width, height, diagonal_mm}, diagnostics);
}

inline Ray ray_of(const Camera& camera, const Vec2f& film, const Vec2f& u_lens, float u_time) {
  const std::optional<CameraRay> c = camera.generate_ray(film, u_lens, u_time);
  EXPECT_TRUE(c.has_value());
  if (!c) return {};
  EXPECT_EQ(c->weight, 1.0f);
  return c->ray;
}

inline void expect_near(const Vec3f& a, const Vec3f& b) {
  EXPECT_LT(length(a - b), 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
}

/// The error message of make_camera.
inline std::string camera_error(const std::string& text) {
  try {
    camera_of(text, 8, 8);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace nephroid::testing_support
