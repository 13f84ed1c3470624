// Scenes and useful starts to test guides with.
#pragma once

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "input/pbrt_parser.h"
#include "photon/emission_guide.h"
#include "unit/bsdf/statistics.h"
#include "unit/film/scratch_directory.h"

namespace nephroid::testing_guide {

/// The lights above a floor. PICTURE in their text is replaced by the name of a small picture.
inline std::unique_ptr<Scene> scene_with(const std::string& lights) {
  const ScratchDirectory directory;
  {
    std::ofstream picture(directory.file("picture.pfm"), std::ios::binary);
    picture << "PF\n8 8\n-1.0\n";
    for (int i = 0; i < 64; ++i)
      for (const int period : {5, 3, 7}) {
        const float v = 1.0f + static_cast<float>(i % period);
        picture.write(reinterpret_cast<const char*>(&v), sizeof v);
      }
  }
  std::string text = "WorldBegin\n" + lights + R"(
    Material "diffuse" Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3])";
  if (const size_t at = text.find("PICTURE"); at != std::string::npos)
    text.replace(at, 7, directory.file("picture.pfm"));
  Diagnostics diagnostics;
  return build_scene(parse_pbrt_string(text, "test.pbrt", ".", diagnostics), {}, diagnostics);
}

/// Adds starts whose first hits are evenly spread in a ball.
inline void add_cluster(std::vector<UsefulStart>& starts, int light, const Vec3f& center,
                        float radius, int count, testing_bsdf::TestRandom& random) {
  for (int i = 0; i < count; ++i) {
    const Vec2f z = random.next2(), phi = random.next2();
    const Vec3f w = testing_bsdf::spherical(2.0 * static_cast<double>(z.x) - 1,
                                            2 * M_PI * static_cast<double>(phi.x));
    starts.push_back({light, center + w * (radius * std::cbrt(z.y)), 0.2f + phi.y});
  }
}

}  // namespace nephroid::testing_guide
