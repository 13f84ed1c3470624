// Triangle meshes: frames, orientation, error bounds, sampling of directions.
#include "shape_checks.h"

namespace nephroid {
namespace {

using namespace testing;

MeshData one_triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  MeshData mesh;
  mesh.positions = {a, b, c};
  mesh.triangles = {0, 1, 2};
  return mesh;
}

bool same(const Vec3f& a, const Vec3f& b) {
  return length(a - b) == 0.0f;
}

const MeshData kSkew = one_triangle({1, 0.2f, 2}, {2.5f, -0.4f, 1.5f}, {1.4f, 2, 1.1f});

TEST(TriangleMesh, PointAndDefaultTextureCoordinatesFollowEmbreeBarycentrics) {
  const TriangleMesh mesh(kSkew, false);
  const SurfaceInteraction s = surface_at(mesh, 0, {0.25f, 0.5f});
  const auto& p = kSkew.positions;
  const Vec3f expected = p[0] * 0.25f + p[1] * 0.25f + p[2] * 0.5f;
  EXPECT_LT(length(s.p - expected), 1e-6f);
  EXPECT_TRUE(s.uv.equalWithAbsError({0.75f, 0.5f}, 1e-7f));  // .25 (0,0) + .25 (1,0) + .5 (1,1)
  const float extent = std::max(max_component(abs(p[1] - p[0])), max_component(abs(p[2] - p[0])));
  for (int i = 0; i < 3; ++i) {
    const float bound =
        std::abs(p[0][i] * 0.25f) + std::abs(p[1][i] * 0.25f) + std::abs(p[2][i] * 0.5f);
    // Rounding of p, and of the tracer's distances to a triangle of this size.
    EXPECT_FLOAT_EQ(s.p_error[i], gamma_bound(7) * bound + gamma_bound(6) * extent);
  }
}

TEST(TriangleMesh, OutsideIsCrossUnlessFlippedAndShadingNormalsWin) {
  MeshData data = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_TRUE(same(surface_at(TriangleMesh(data, false), 0, {0.2f, 0.2f}).ng, Vec3f(0, 0, 1)));
  EXPECT_TRUE(same(surface_at(TriangleMesh(data, true), 0, {0.2f, 0.2f}).ng, Vec3f(0, 0, -1)));
  data.normals = std::vector<Vec3f>{{0, 0, -2}, {0, 0.5f, -1}, {0.5f, 0, -1}};
  for (const bool flip : {false, true}) {
    const TriangleMesh mesh(data, flip);
    const SurfaceInteraction s = surface_at(mesh, 0, {0.25f, 0.5f});
    EXPECT_TRUE(same(s.ng, Vec3f(0, 0, -1)));
    const Vec3f ns = normalize(Vec3f(0.25f, 0.125f, -1.25f));
    EXPECT_LT(length(s.shading.z - ns), 1e-6f);
    Vec3f axis;
    float cosine;
    mesh.normal_bounds(0, &axis, &cosine);
    EXPECT_TRUE(same(axis, Vec3f(0, 0, -1)));
    EXPECT_EQ(cosine, 1.0f);
    EXPECT_TRUE(same(mesh.sample_area(0, {0.3f, 0.6f})->ng, Vec3f(0, 0, -1)));
    EXPECT_TRUE(same(mesh.sample_towards(0, {0.3f, 0.2f, 1}, {0.3f, 0.6f})->ng, Vec3f(0, 0, -1)));
  }
}

TEST(TriangleMesh, DerivativesMatchFiniteDifferencesOverTheTexture) {
  MeshData data = kSkew;
  data.uvs = std::vector<Vec2f>{{0.1f, 0.2f}, {0.9f, 0.3f}, {0.4f, 0.8f}};
  data.normals = std::vector<Vec3f>{{0.2f, 0.3f, 1}, {0.1f, -0.2f, 0.9f}, {-0.2f, 0.4f, 1.1f}};
  const TriangleMesh mesh(data, false);
  const SurfaceInteraction s = surface_at(mesh, 0, {0.3f, 0.3f});
  // Step in barycentric coordinates: uv and p are linear in them, so the chain rule is exact.
  for (const Vec2f& step : {Vec2f(0.1f, 0), Vec2f(0, 0.1f), Vec2f(0.1f, -0.2f)}) {
    const Vec2f to = Vec2f(0.3f, 0.3f) + step;
    const SurfaceInteraction moved = surface_at(mesh, 0, to);
    const Vec2f duv = moved.uv - s.uv;
    EXPECT_LT(length(moved.p - s.p - s.dpdu * duv.x - s.dpdv * duv.y), 2e-6f);
    const auto normal = [&](const Vec2f& b) {
      return data.normals[0] * (1 - b.x - b.y) + data.normals[1] * b.x + data.normals[2] * b.y;
    };
    const Vec3f dn = normal(to) - normal({0.3f, 0.3f});
    EXPECT_LT(length(dn - s.dndu * duv.x - s.dndv * duv.y), 2e-6f);
  }
  EXPECT_LT(length(s.shading_dpdv - cross(s.shading.z, s.dpdu)), 1e-5f);
  EXPECT_NEAR(dot(s.shading.z, s.shading_dpdu), 0.0f, 1e-5f);
  EXPECT_GT(dot(s.shading_dpdu, s.dpdu), 0.0f);
}

TEST(TriangleMesh, DefaultTextureCoordinatesAreTheSameAsWrittenOnes) {
  MeshData written = kSkew;
  written.uvs = std::vector<Vec2f>{{0, 0}, {1, 0}, {1, 1}};
  for (const bool flip : {false, true}) {
    const SurfaceInteraction a = surface_at(TriangleMesh(kSkew, flip), 0, {0.3f, 0.2f});
    const SurfaceInteraction b = surface_at(TriangleMesh(written, flip), 0, {0.3f, 0.2f});
    EXPECT_TRUE(a.uv.equalWithAbsError(b.uv, 1e-6f));
    EXPECT_LT(length(a.ng - b.ng), 1e-6f);
    EXPECT_LT(length(a.dpdu - b.dpdu) + length(a.dpdv - b.dpdv), 2e-6f);
    EXPECT_LT(length(a.shading.x - b.shading.x) + length(a.shading.y - b.shading.y), 1e-6f);
    EXPECT_LT(length(a.shading_dpdu - b.dpdu) + length(a.shading_dpdv - b.dpdv), 2e-6f);
    EXPECT_TRUE(same(a.dndu, b.dndu));
  }
}

TEST(TriangleMesh, TangentsSetTheShadingFrameEvenWithoutNormals) {
  MeshData data = one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  data.tangents = std::vector<Vec3f>{{0, 1, 0}, {0, 1, 0}, {0, 1, 0.2f}};
  const SurfaceInteraction s = surface_at(TriangleMesh(data, true), 0, {0.25f, 0.25f});
  EXPECT_TRUE(same(s.shading.z, Vec3f(0, 0, -1)));
  EXPECT_LT(length(s.shading.x - Vec3f(0, 1, 0)), 1e-6f);
  EXPECT_TRUE(same(s.dndu, Vec3f(0, 0, 0)));
}

TEST(TriangleMesh, DegenerateTextureCoordinatesStillGiveAFrame) {
  MeshData data = kSkew;
  data.uvs = std::vector<Vec2f>{{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}};
  for (const bool with_normals : {false, true}) {
    if (with_normals) data.normals = std::vector<Vec3f>{{0, 0.1f, 1}, {0.1f, 0, 1}, {0, 0, 1}};
    const SurfaceInteraction s = surface_at(TriangleMesh(data, false), 0, {0.3f, 0.3f});
    EXPECT_NEAR(length(s.dpdu), 1.0f, 1e-6f);
    EXPECT_NEAR(dot(s.dpdu, s.ng), 0.0f, 1e-6f);
    EXPECT_NEAR(dot(s.dpdu, s.dpdv), 0.0f, 1e-6f);
    EXPECT_TRUE(is_finite(s.dndu) && is_finite(s.dndv) && is_finite(s.shading.x));
  }
}

TEST(TriangleMesh, SliverAndTinyTrianglesHaveUnitNormals) {
  const float tiny = 1e-18f;
  for (const MeshData& data : {one_triangle({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}),
                               one_triangle({0, 0, 0}, {1e4f, 0, 0}, {5e3f, 1e-6f, 0})}) {
    const SurfaceInteraction s = surface_at(TriangleMesh(data, false), 0, {0.3f, 0.3f});
    EXPECT_TRUE(same(s.ng, Vec3f(0, 0, 1)));
    EXPECT_NEAR(length(s.shading.x), 1.0f, 1e-6f);
  }
}

TEST(TriangleMesh, RaysAimedAtAPointHitItAndRaysAimedBesideItMiss) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const MeshData data = one_triangle(random.in_box(2), random.in_box(2), random.in_box(2));
    const TriangleMesh mesh(data, false);
    if (mesh.area(0) < 0.05f) continue;
    const float b1 = random.in(-0.5f, 1.5f), b2 = random.in(-0.5f, 1.5f);
    const float inside = std::min({b1, b2, 1 - b1 - b2});
    if (std::abs(inside) < 1e-3f) continue;
    const auto& p = data.positions;
    const Vec3f target = p[0] * (1 - b1 - b2) + p[1] * b1 + p[2] * b2;
    Ray ray;
    ray.o = random.in_box(5);
    ray.d = (target - ray.o) * 0.5f;
    const Vec3f n = normalize(cross(p[1] - p[0], p[2] - p[0]));
    if (abs_dot(n, normalize(ray.d)) < 0.05f) continue;
    const auto hit = mesh.intersect(0, ray, 0.0f);
    ASSERT_EQ(hit.has_value(), inside > 0) << i;
    if (!hit) continue;
    EXPECT_NEAR(hit->t, 2.0f, 1e-4f);
    EXPECT_NEAR(hit->uv.x, b1, 1e-4f);
    EXPECT_NEAR(hit->uv.y, b2, 1e-4f);
    ray.t_max = hit->t * 0.99f;
    EXPECT_FALSE(mesh.intersect(0, ray, 0.0f));
    ray.t_max = kInfinity;
    EXPECT_FALSE(mesh.intersect(0, ray, hit->t * 1.01f));
  }
}

TEST(TriangleMesh, SamplingHasTheDensityItReports) {
  const TriangleMesh mesh(kSkew, false);
  check_area_sampling(mesh, 0, triangle_parameters());
  // Near (by solid angle), at the edge of the plane, and far (by area).
  for (const Vec3f& from : {Vec3f(1.6f, 0.5f, 1.2f), Vec3f(0, 0, 0), Vec3f(3, 3, 3),
                            Vec3f(1.6f, 0.6f, 1.75f), Vec3f(60, 80, -40)})
    check_direction_sampling(mesh, 0, from, triangle_parameters());
}

TEST(TriangleMesh, SolidAnglesAreThoseOfTheClosedForm) {
  // An octant of the sphere, and half of a cube's face, which covers a twelfth of it.
  const TriangleMesh octant(one_triangle({1, 0, 0}, {0, 3, 0}, {0, 0, 0.5f}), false);
  EXPECT_NEAR(mean_solid_angle(octant, 0, {0, 0, 0}, 4), kPi / 2, 1e-6);
  const TriangleMesh half_face(one_triangle({-1, -1, 1}, {1, -1, 1}, {1, 1, 1}), false);
  EXPECT_NEAR(mean_solid_angle(half_face, 0, {0, 0, 0}, 4), kPi / 3, 1e-6);
  // Small: sampled by area, with mean 1/pdf equal to area * cos / d^2 up to size / distance.
  EXPECT_NEAR(mean_solid_angle(half_face, 0, {0, 0, -999}, 64) / 2e-6, 1.0, 1e-5);
}

TEST(TriangleMesh, DirectionSamplesStayInsideEvenForSlivers) {
  Random random(8);
  for (int i = 0; i < 20000; ++i) {
    const Vec3f a = random.in_box(1), b = random.in_box(1);
    const Vec3f c = a + (b - a) * random.unit() + random.in_box(std::pow(10.0f, random.in(-6, 0)));
    const TriangleMesh mesh(one_triangle(a, b, c), false);
    const Vec3f from = random.in_box(2);
    const auto s = mesh.sample_towards(0, from, random.square());
    if (!s) continue;
    ASSERT_TRUE(is_finite(s->p) && s->pdf > 0 && std::isfinite(s->pdf));
    EXPECT_EQ(mesh.pdf_towards(0, from, s->p, s->ng), s->pdf);
    Bounds3f box = mesh.bounds(0);
    box.min -= Vec3f(1e-6f, 1e-6f, 1e-6f);
    box.max += Vec3f(1e-6f, 1e-6f, 1e-6f);
    EXPECT_TRUE(box.intersects(s->p));
  }
}

TEST(TriangleMesh, NothingIsSeenEdgeOnOrOfATriangleWithoutArea) {
  const TriangleMesh flat(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), false);
  EXPECT_FALSE(flat.sample_towards(0, {3, 3, 0}, {0.4f, 0.3f}));
  EXPECT_FALSE(flat.sample_towards(0, {0.2f, 0.2f, 0}, {0.4f, 0.3f}));
  const TriangleMesh line(one_triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), false);
  EXPECT_FALSE(line.sample_area(0, {0.4f, 0.3f}));
  EXPECT_FALSE(line.sample_towards(0, {0, 0, 1}, {0.4f, 0.3f}));
  EXPECT_EQ(line.area(0), 0.0f);
}

TEST(TriangleMesh, RaysDoNotMeetTheTriangleTheyLeave) {
  Random random(5);
  int hits = 0;
  for (int i = 0; i < 40000; ++i) {
    const float size = std::pow(10.0f, random.in(-4, 4));
    const Vec3f center = random.direction() * std::pow(10.0f, random.in(-4, 4));
    const TriangleMesh mesh(one_triangle(center + random.in_box(size), center + random.in_box(size),
                                         center + random.in_box(size)),
                            false);
    hits += check_no_self_hits(mesh, center, size, false, random);
  }
  EXPECT_GT(hits, 2000);
}

}  // namespace
}  // namespace nephroid
