// Which triangle pairs of lamps become patches.
#include "scene/shape/emitter_rectangles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nephroid {
namespace {

/// A square of two triangles whose texture coordinates are turned by an angle.
MeshData square(float degrees) {
  MeshData mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  const float c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
  for (const Vec3f& p : mesh.positions) mesh.uvs.emplace_back(c * p.x - s * p.y, s * p.x + c * p.y);
  return mesh;
}

TEST(JoinRectangles, KeepsTheFrameOfTheTexture) {
  // A patch knows directions of u and v along its edges alone.
  for (const auto& [degrees, joins] :
       {std::pair{0.0f, true}, {90.0f, true}, {180.0f, true}, {30.0f, false}, {1.0f, false}}) {
    const MeshData mesh = join_rectangles(square(degrees));
    EXPECT_EQ(mesh.quads.size(), joins ? 4u : 0u) << degrees;
    EXPECT_EQ(mesh.triangles.size(), joins ? 0u : 6u) << degrees;
  }
}

}  // namespace
}  // namespace nephroid
