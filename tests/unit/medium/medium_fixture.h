// Media from scene text, random rays through them, and quadrature along rays.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/warps.h"
#include "input/pbrt_parser.h"
#include "scene/medium/medium.h"
#include "unit/bsdf/statistics.h"

namespace nephroid::testing_medium {

using testing_bsdf::TestRandom;

inline SampledWavelengths test_wavelengths() {
  return SampledWavelengths::sample_visible(0.37f);
}

/// The media of a scene; `text` may have transforms before its MakeNamedMedium directives.
inline std::vector<MediumPtr> media_of(const std::string& text, const std::string& directory = ".",
                                       Diagnostics* diagnostics = nullptr) {
  Diagnostics own;
  Diagnostics& d = diagnostics ? *diagnostics : own;
  return make_media(parse_pbrt_string(text + "\nWorldBegin", "t.pbrt", directory, d), d);
}
/// One medium named "m": its type, then its parameters.
inline std::string named(const std::string& type, const std::string& parameters) {
  return "MakeNamedMedium \"m\" \"string type\" \"" + type + "\" " + parameters;
}
inline MediumPtr medium_of(const std::string& type, const std::string& parameters,
                           const std::string& transform = "", const std::string& directory = ".") {
  const auto media = media_of(transform + "\n" + named(type, parameters), directory);
  EXPECT_EQ(media.size(), 1u);
  return media.at(0);
}

/// "[ v0 v1 ... ]": `count` values in [0, 1), most of them 0 if `sparse`.
inline std::string random_values(int count, uint64_t seed, bool sparse = false) {
  TestRandom random(seed);
  std::string text = "[";
  for (int i = 0; i < count; ++i) {
    const float v = random.next();
    text += " " + std::to_string(sparse ? std::max(0.0f, 4.0f * v - 3.0f) : v);
  }
  return text + " ]";
}

/// A transform with rotation, uneven scaling and translation.
inline const std::string kUneven = "Translate 1 -2 0.5 Rotate 33 1 2 3 Scale 2 0.5 3";

/// A unit ray from near the box of all test media, towards it or past it.
inline Ray random_ray(TestRandom& random, const Vec3f& center, float radius) {
  const auto point = [&] {
    return center +
           Vec3f(random.next() - 0.5f, random.next() - 0.5f, random.next() - 0.5f) * radius;
  };
  Ray ray;
  ray.o = point();
  ray.d = normalize(point() - ray.o);
  // Every fourth ray is parallel to an axis.
  if (random.next() < 0.25f) {
    const int axis = static_cast<int>(random.next() * 3);
    ray.d = {0, 0, 0};
    ray.d[axis] = random.next() < 0.5f ? -1.0f : 1.0f;
  }
  return ray;
}

/// A medium of each kind under test, with chromatic coefficients.
struct MediumCase {
  const char* name;
  MediumPtr medium;
  Vec3f center{0, 0, 0};  ///< centre of a ball that contains it
  float radius = 4;
};
/// All cases except those from files.
std::vector<MediumCase> medium_cases();

}  // namespace nephroid::testing_medium
