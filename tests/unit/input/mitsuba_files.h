// Writes .serialized and .vol files for tests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math.h"

namespace nephroid::testing {

/// A mesh of a .serialized file; by default one triangle.
struct SerializedSample {
  int version = 4;
  bool is_double = false, has_face_normals = false;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Vec2f> uvs;
  std::vector<Vec3f> colors;
  std::vector<uint32_t> triangles;
  uint64_t claimed_triangles = 0;  ///< written instead of the true number if above 0

  SerializedSample();
};

/// A file with these meshes, which have one version.
std::string serialized_file(const std::vector<SerializedSample>& meshes);

struct VolumeSample {
  int encoding = 1;
  int resolution[3] = {2, 2, 2};
  int channels = 1;
  Vec3f min{0, 0, 0}, max{1, 1, 1};
  std::vector<float> values;  ///< 0 to 7 by default; in 0 to 1 for encoding 3

  VolumeSample();
};
std::string volume_file(const VolumeSample& volume);

}  // namespace nephroid::testing
