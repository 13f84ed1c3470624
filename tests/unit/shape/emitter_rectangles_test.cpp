// Which triangle pairs of lamps become patches.
#include "scene/shape/emitter_rectangles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/shape/mesh_preparation.h"
#include "shape_checks.h"

namespace nephroid {
namespace {

using namespace testing;

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
  for (const auto& [degrees, joins] : {std::pair{0.0f, true},
                                       {90.0f, true},
                                       {180.0f, true},
                                       {90.00002f, true},
                                       {30.0f, false},
                                       {1.0f, false}}) {
    const MeshData mesh = join_rectangles(square(degrees));
    EXPECT_EQ(mesh.quads.size(), joins ? 4u : 0u) << degrees;
    EXPECT_EQ(mesh.triangles.size(), joins ? 0u : 6u) << degrees;
    if (!joins) continue;
    const SurfaceInteraction of_patch =
        surface_at(*make_bilinear_mesh(quads_of(mesh), false), 0, {0.3f, 0.4f});
    const SurfaceInteraction of_triangle =
        surface_at(TriangleMesh(square(degrees), false), 0, {0.3f, 0.4f});
    EXPECT_LT(length(of_patch.dpdu - of_triangle.dpdu), 1e-4f) << degrees;
    EXPECT_LT(length(of_patch.dpdv - of_triangle.dpdv), 1e-4f) << degrees;
  }
}

}  // namespace
}  // namespace nephroid
