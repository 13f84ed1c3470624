// Bilinear patches: hits against the parametric form and against triangles, frames, normals, areas,
// and sampling of rectangles and twisted patches.
#include "scene/shape/plane_rectangle.h"
#include "shape_checks.h"

namespace nephroid {
namespace {

using namespace testing;

MeshData patch(const Vec3f& p00, const Vec3f& p10, const Vec3f& p01, const Vec3f& p11) {
  MeshData mesh;
  mesh.positions = {p00, p10, p01, p11};
  mesh.quads = {0, 1, 2, 3};
  return mesh;
}

MeshData rectangle() {
  const Vec3f o(0.3f, -0.4f, 1), u(1.2f, 0.5f, 0.1f), v(-0.5f, 1.2f, 0);
  return patch(o, o + u, o + v, o + u + v);
}
MeshData trapezoid() {
  return patch({0, 0, 0}, {2, 0, 0}, {0.5f, 1, 0}, {1, 1, 0});
}
MeshData twisted() {
  return patch({0, 0, 0}, {1, 0, 0.4f}, {0, 1.2f, 0.3f}, {1.3f, 1, -0.5f});
}

TEST(BilinearMesh, EveryPointOfThePatchIsHit) {
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const MeshData data =
        patch(random.in_box(1), random.in_box(1), random.in_box(1), random.in_box(1));
    const ShapePtr shape = make_bilinear_mesh(data, false);
    const SurfaceInteraction target = surface_at(*shape, 0, random.square());
    Ray ray;
    ray.o = random.in_box(4);
    ray.d = (target.p - ray.o) * 0.5f;
    if (abs_dot(normalize(ray.d), target.ng) < 0.05f) continue;
    const auto hit = shape->intersect(0, ray, 0.0f);
    ASSERT_TRUE(hit) << i;
    ASSERT_LT(hit->t, 2.0f + 1e-4f);  // or an earlier hit
    const SurfaceInteraction s = surface_at(*shape, 0, hit->uv);
    EXPECT_LT(length(s.p - (ray.o + ray.d * hit->t)), 2e-5f);
  }
}

TEST(BilinearMesh, PlaneConvexPatchesAreHitWhereTheirTwoTrianglesAre) {
  Random random(2);
  for (const MeshData& data : {rectangle(), trapezoid()}) {
    const ShapePtr shape = make_bilinear_mesh(data, false);
    MeshData cut = data;
    cut.triangles = {0, 1, 3, 0, 3, 2};
    const TriangleMesh triangles(cut, false);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
      Ray ray;
      ray.o = random.in_box(4);
      ray.d = Vec3f(0.5f, 0.5f, 0.5f) + random.in_box(1.5f) - ray.o;
      const auto a = shape->intersect(0, ray, 0.0f);
      auto b = triangles.intersect(0, ray, 0.0f);
      if (!b) b = triangles.intersect(1, ray, 0.0f);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      ++hits;
      EXPECT_NEAR(a->t / b->t, 1.0f, 1e-5f);
    }
    EXPECT_GT(hits, 300);
  }
}

TEST(BilinearMesh, NeighboursLeaveNoGap) {
  MeshData data;
  data.positions = {{0, 0, 0},    {1, 0.1f, 0.3f}, {2, 0, 0.1f},
                    {0, 1, 0.2f}, {1.1f, 1, 0},    {2, 1.2f, 0.4f}};
  data.quads = {0, 1, 3, 4, 1, 2, 4, 5};
  const ShapePtr shape = make_bilinear_mesh(data, false);
  ASSERT_EQ(shape->primitive_count(), 2u);
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    // Aim at points of the shared edge.
    const Vec3f target =
        data.positions[1] + (data.positions[4] - data.positions[1]) * random.unit();
    Ray ray;
    ray.o = target + Vec3f(random.in(-1, 1), random.in(-1, 1), 3);
    ray.d = target - ray.o;
    EXPECT_TRUE(shape->intersect(0, ray, 0.0f) || shape->intersect(1, ray, 0.0f));
  }
}

TEST(BilinearMesh, DerivativesMatchFiniteDifferences) {
  for (const bool flip : {false, true})
    for (const MeshData& data : {rectangle(), trapezoid(), twisted()}) {
      const ShapePtr shape = make_bilinear_mesh(data, flip);
      check_derivatives(*shape, 0, {0.3f, 0.6f}, 1);
      check_derivatives(*shape, 0, {0.8f, 0.1f}, 1);
    }
}

TEST(BilinearMesh, TextureCoordinatesScaleTheDerivatives) {
  MeshData data = rectangle();
  const ShapePtr plain = make_bilinear_mesh(data, false);
  data.uvs = std::vector<Vec2f>{{1, 3}, {3, 3}, {1, 7}, {3, 7}};
  const SurfaceInteraction a = surface_at(*plain, 0, {0.25f, 0.5f});
  const SurfaceInteraction b = surface_at(*make_bilinear_mesh(data, false), 0, {0.25f, 0.5f});
  EXPECT_TRUE(b.uv.equalWithAbsError({1.5f, 5.0f}, 1e-6f));
  EXPECT_LT(length(b.dpdu - a.dpdu * 0.5f), 1e-6f);
  EXPECT_LT(length(b.dpdv - a.dpdv * 0.25f), 1e-6f);
  EXPECT_LT(length(b.ng - a.ng), 1e-6f);
  // A mirrored texture does not flip the surface.
  data.uvs = std::vector<Vec2f>{{1, 0}, {0, 0}, {1, 1}, {0, 1}};
  EXPECT_LT(length(surface_at(*make_bilinear_mesh(data, false), 0, {0.2f, 0.2f}).ng - a.ng), 1e-6f);
}

TEST(BilinearMesh, NormalsDecideTheOutsideAndTurnTheFrame) {
  MeshData data = rectangle();
  const Vec3f ng = surface_at(*make_bilinear_mesh(data, false), 0, {0.5f, 0.5f}).ng;
  EXPECT_LT(length(surface_at(*make_bilinear_mesh(data, true), 0, {0.5f, 0.5f}).ng + ng), 1e-6f);
  const Vec3f tilt(0.2f, 0.1f, -0.3f);
  data.normals = std::vector<Vec3f>(4, tilt - ng * 2.0f);
  for (const bool flip : {false, true}) {
    const ShapePtr shape = make_bilinear_mesh(data, flip);
    const SurfaceInteraction s = surface_at(*shape, 0, {0.5f, 0.5f});
    EXPECT_LT(length(s.ng + ng), 1e-6f);
    EXPECT_LT(length(s.shading.z - normalize(tilt - ng * 2.0f)), 1e-6f);
    EXPECT_NEAR(dot(s.shading_dpdu, s.shading.z), 0.0f, 1e-5f);
    EXPECT_NEAR(length(s.shading_dpdu), length(s.dpdu), 1e-5f);
    EXPECT_LT(length(shape->sample_area(0, {0.3f, 0.7f})->ng + ng), 1e-6f);
  }
}

TEST(BilinearMesh, AreasAreThoseOfTheClosedForm) {
  EXPECT_NEAR(make_bilinear_mesh(rectangle(), false)->area(0),
              length(cross(Vec3f(1.2f, 0.5f, 0.1f), Vec3f(-0.5f, 1.2f, 0))), 1e-6f);
  EXPECT_NEAR(make_bilinear_mesh(trapezoid(), false)->area(0), 1.25f, 1e-6f);
  // A patch degenerated to a triangle.
  EXPECT_NEAR(make_bilinear_mesh(patch({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}), false)->area(0),
              0.5f, 1e-6f);
  for (const MeshData& data : {rectangle(), trapezoid(), twisted()}) {
    const ShapePtr shape = make_bilinear_mesh(data, false);
    EXPECT_NEAR(mean_area(*shape, 0, 200) / shape->area(0), 1.0, 1e-4);
  }
}

TEST(BilinearMesh, SamplingHasTheDensityItReports) {
  for (const MeshData& data : {rectangle(), trapezoid(), twisted()}) {
    const ShapePtr shape = make_bilinear_mesh(data, false);
    check_area_sampling(*shape, 0);
    for (const Vec3f& from : {Vec3f(0.5f, 0.4f, 1.8f), Vec3f(3, 1, 0.6f), Vec3f(-50, 70, 90)})
      check_direction_sampling(*shape, 0, from);
  }
}

TEST(BilinearMesh, SolidAngleOfARectangleIsTheClosedForm) {
  const ShapePtr face =
      make_bilinear_mesh(patch({-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}), false);
  EXPECT_NEAR(mean_solid_angle(*face, 0, {0, 0, 0}, 4), 2 * kPi / 3, 1e-6);
  // Seen on its axis: 4 asin(a b / sqrt((a^2 + h^2)(b^2 + h^2))) for half sides a, b at height h.
  const ShapePtr box =
      make_bilinear_mesh(patch({-2, -1, 0}, {2, -1, 0}, {-2, 1, 0}, {2, 1, 0}), false);
  for (const double h : {0.01, 0.5, 7.0, 60.0}) {
    const double expected = 4 * std::asin(2 / std::sqrt((4 + h * h) * (1 + h * h)));
    EXPECT_NEAR(mean_solid_angle(*box, 0, {0, 0, float(h)}, 4) / expected, 1.0, 1e-6) << h;
  }
}

TEST(BilinearMesh, RectangleSamplesStayInsideAtGrazingAngles) {
  Random random(9);
  const ShapePtr shape = make_bilinear_mesh(rectangle(), false);
  const SurfaceInteraction s = surface_at(*shape, 0, {0, 0});
  for (int i = 0; i < 20000; ++i) {
    const Vec3f from = s.p + s.dpdu * random.in(-2, 3) + s.dpdv * random.in(-2, 3) +
                       s.ng * std::pow(10.0f, random.in(-7, 1));
    const auto sample = shape->sample_towards(0, from, random.square());
    if (!sample) continue;
    ASSERT_TRUE(is_finite(sample->p) && std::isfinite(sample->pdf) && sample->pdf > 0);
    ASSERT_TRUE(sample->uv.x >= 0 && sample->uv.x <= 1 && sample->uv.y >= 0 && sample->uv.y <= 1);
  }
}

TEST(BilinearMesh, NormalConesHoldAllNormals) {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const ShapePtr shape = make_bilinear_mesh(
        patch(Vec3f(0, 0, 0) + random.in_box(0.4f), Vec3f(1, 0, 0) + random.in_box(0.4f),
              Vec3f(0, 1, 0) + random.in_box(0.4f), Vec3f(1, 1, 0) + random.in_box(0.4f)),
        i % 2 == 0);
    Vec3f axis;
    float cosine;
    shape->normal_bounds(0, &axis, &cosine);
    for (int k = 0; k < 50; ++k)
      EXPECT_GE(dot(axis, surface_at(*shape, 0, random.square()).ng), cosine - 1e-5f);
  }
}

TEST(BilinearMesh, RaysDoNotMeetThePlanePatchTheyLeave) {
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 40000; ++i) {
    const float size = std::pow(10.0f, random.in(-4, 4));
    const Vec3f center = random.direction() * std::pow(10.0f, random.in(-4, 4));
    // Corners in a plane that floats represent exactly: multiples of a power of two along two axes.
    const float grid = std::exp2(std::ceil(std::log2(std::max(size, length(center)))) - 16.0f);
    const auto snap = [&](float x) { return std::round(x / grid) * grid; };
    const Vec3f o(snap(center.x), snap(center.y), snap(center.z));
    const Vec3f u(snap(size), snap(size * 0.3f), 0), v(0, snap(-size * 0.4f), snap(size));
    const ShapePtr shape = make_bilinear_mesh(patch(o, o + u, o + v, o + u + v), false);
    if (!(shape->area(0) > 0)) continue;
    hits += check_no_self_hits(*shape, o + (u + v) * 0.5f, size, false, random);
  }
  EXPECT_GT(hits, 4000);
}

// Lamps keep rectangles and sample these instead of the mesh.
TEST(BilinearMesh, RectanglesSampleAsTheMeshDoes) {
  MeshData with_uvs = rectangle(), with_normals = rectangle();
  with_uvs.uvs = {{0.5f, 0}, {0.5f, 1}, {0.25f, 0}, {0.25f, 1}};
  const Vec3f back = -surface_at(*make_bilinear_mesh(rectangle(), false), 0, {0.5f, 0.5f}).ng;
  with_normals.normals.assign(4, back);
  Random random(31);
  for (const MeshData& data : {rectangle(), with_uvs, with_normals})
    for (const bool flip : {false, true}) {
      const ShapePtr shape = make_bilinear_mesh(data, flip);
      const auto plane = shape->rectangle(0);
      ASSERT_TRUE(plane);
      for (int i = 0; i < 200; ++i) {
        // Every other point is so far away that the rectangle is sampled by area.
        const Vec3f from = random.in_box(i % 2 == 0 ? 3.0f : 3000.0f);
        const Vec2f u = random.square();
        const auto a = plane->sample_towards(from, u), b = shape->sample_towards(0, from, u);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        EXPECT_EQ(a->p, b->p);
        EXPECT_EQ(a->p_error, b->p_error);
        EXPECT_EQ(a->ng, b->ng);
        EXPECT_EQ(a->ng, surface_at(*shape, 0, {0.5f, 0.5f}).ng);
        EXPECT_EQ(a->pdf, b->pdf);
        const float pdf = plane->pdf_towards(from, a->p, a->ng);
        EXPECT_EQ(pdf, shape->pdf_towards(0, from, a->p, a->ng));
        EXPECT_NEAR(pdf, a->pdf, 1e-4f * pdf);
      }
    }
}

TEST(BilinearMesh, OtherPatchesAreNoRectangles) {
  EXPECT_FALSE(make_bilinear_mesh(trapezoid(), false)->rectangle(0));
  EXPECT_FALSE(make_bilinear_mesh(twisted(), false)->rectangle(0));
  MeshData bent = rectangle();
  bent.normals.assign(4, Vec3f(0, 0, 1));
  bent.normals[3].y = 0.1f;
  EXPECT_FALSE(make_bilinear_mesh(bent, false)->rectangle(0));
}

}  // namespace
}  // namespace nephroid
