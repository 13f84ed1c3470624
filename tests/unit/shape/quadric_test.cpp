// Spheres, disks and cylinders: hits, frames, areas, sampling, error bounds.
#include "shape_checks.h"

namespace nephroid {
namespace {

using namespace testing;

Mat44d scaled(double x, double y, double z) {
  Mat44d m;
  m.setScale(Vec3d(x, y, z));
  return m;
}
Mat44d moved(double x, double y, double z) {
  Mat44d m;
  m.setTranslation(Vec3d(x, y, z));
  return m;
}
Transform turned_and_moved(uint64_t seed, const Mat44d& first) {
  Random random(seed);
  return Transform(first * random.rotation() * moved(0.5, -1.0, 2.0));
}

struct Case {
  const char* name;
  ShapePtr shape;
  bool convex;
  float size;
};

/// Whole and clipped shapes, under conformal and other transforms, some left-handed.
std::vector<Case> cases() {
  const Transform rigid = turned_and_moved(1, scaled(1.5, 1.5, 1.5));
  const Transform mirror = turned_and_moved(2, scaled(1, 1, -1));
  const Transform squeezed = turned_and_moved(3, scaled(1.4, 0.5, 0.9));
  Mat44d shear;
  shear[0][1] = 0.4;
  shear[2][0] = -0.3;
  const Transform sheared = turned_and_moved(4, shear);
  std::vector<Case> all;
  all.push_back({"sphere", make_sphere(rigid, false, 1, -1, 1, 360), true, 1.5f});
  all.push_back({"sphere mirrored", make_sphere(mirror, false, 1, -1, 1, 360), true, 1});
  all.push_back({"sphere reversed", make_sphere(rigid, true, 1, -1, 1, 360), false, 1.5f});
  all.push_back({"ellipsoid", make_sphere(squeezed, false, 1, -1, 1, 360), true, 1});
  all.push_back({"ellipsoid sheared", make_sphere(sheared, false, 1, -1, 1, 360), true, 1});
  all.push_back({"sphere cut", make_sphere(rigid, false, 1, -0.4f, 0.7f, 250), true, 1.5f});
  all.push_back({"ellipsoid cut", make_sphere(squeezed, true, 1, -1, 0.3f, 300), false, 1});
  all.push_back({"disk", make_disk(rigid, false, 0.3f, 1, 0, 360), true, 1.5f});
  all.push_back({"ring sector", make_disk(squeezed, false, 0.3f, 1, 0.4f, 200), true, 1});
  all.push_back({"cylinder", make_cylinder(rigid, false, 0.7f, -1, 0.5f, 360), true, 1.5f});
  all.push_back({"cylinder sector", make_cylinder(sheared, true, 0.7f, 0.5f, -1, 130), false, 1});
  return all;
}

TEST(Quadrics, AreaSamplingHasTheDensityItReports) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    check_area_sampling(*c.shape, 0);
  }
}

TEST(Quadrics, DirectionSamplingHasTheDensityItReports) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    for (const Vec3f& from : {Vec3f(2.5f, 1.0f, 3.0f), Vec3f(0.5f, -1.2f, 1.9f)})
      check_direction_sampling(*c.shape, 0, from);
  }
}

TEST(Quadrics, DerivativesMatchFiniteDifferences) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    for (const Vec2f& uv : {Vec2f(0.3f, 0.4f), Vec2f(0.8f, 0.7f), Vec2f(0.11f, 0.23f)})
      check_derivatives(*c.shape, 0, uv, c.size);
  }
}

TEST(Quadrics, FramesAreFiniteAtPolesAndCentres) {
  for (const Case& c : cases())
    for (const Vec2f& uv : {Vec2f(0, 0), Vec2f(0, 1), Vec2f(1, 0), Vec2f(1, 1), Vec2f(0.5f, 1)}) {
      const SurfaceInteraction s = surface_at(*c.shape, 0, uv);
      EXPECT_NEAR(length(s.ng), 1.0f, 1e-6f) << c.name;
      EXPECT_NEAR(length(s.shading.x), 1.0f, 1e-6f) << c.name;
      EXPECT_TRUE(is_finite(s.dpdv) && is_finite(s.dndu) && is_finite(s.dndv)) << c.name;
      EXPECT_GT(length(s.dpdu), 0.0f) << c.name;
    }
}

TEST(Quadrics, AreasAreThoseOfTheClosedForm) {
  const Transform by3 = turned_and_moved(5, scaled(3, 3, 3));
  EXPECT_NEAR(make_sphere(by3, false, 2, -2, 2, 360)->area(0), 4 * kPi * 36, 1e-3f);
  EXPECT_NEAR(make_sphere(by3, false, 2, -1, 1.5f, 90)->area(0), kPi / 2 * 2 * 2.5f * 9, 1e-4f);
  EXPECT_NEAR(make_disk(by3, false, 1, 2, 1, 180)->area(0), kPi / 2 * 3 * 9, 1e-4f);
  EXPECT_NEAR(make_cylinder(by3, false, 2, 0, 3, 360)->area(0), 2 * kPi * 2 * 3 * 9, 1e-3f);
  const Transform unequal = turned_and_moved(6, scaled(2, 3, 1));
  EXPECT_NEAR(make_disk(unequal, false, 1, 1, 0, 360)->area(0), kPi * 6, 1e-5f);
  // A prolate spheroid with axes 1, 1, 2.
  const double e = std::sqrt(0.75);
  const double spheroid = 2 * double(kPi) * (1 + 2 / e * std::asin(e));
  const Transform stretched = turned_and_moved(7, scaled(1, 1, 2));
  EXPECT_NEAR(make_sphere(stretched, false, 1, -1, 1, 360)->area(0) / spheroid, 1.0, 1e-5);
  // Stratified Monte Carlo, for shapes without a closed form.
  for (const Case& c : cases())
    EXPECT_NEAR(mean_area(*c.shape, 0, 200) / c.shape->area(0), 1.0, 2e-4) << c.name;
}

TEST(Quadrics, SolidAnglesAreThoseOfTheClosedForm) {
  const ShapePtr sphere =
      make_sphere(turned_and_moved(8, scaled(2, 2, 2)), false, 0.5f, -1, 1, 360);
  for (const float distance : {1.0001f, 1.3f, 5.0f, 1000.0f}) {
    const Vec3f from = Vec3f(0.5f, -1, 2) + normalize(Vec3f(1, 2, 3)) * distance;
    const double d = length(from - Vec3f(0.5f, -1, 2));
    const double sin2 = 1 / (d * d), expected = 2 * double(kPi) * sin2 / (1 + std::sqrt(1 - sin2));
    EXPECT_NEAR(mean_solid_angle(*sphere, 0, from, 4) / expected, 1.0, 1e-4) << distance;
  }
  // From inside: all directions. From the axis of a disk: those of its cone.
  EXPECT_NEAR(mean_solid_angle(*sphere, 0, {0.8f, -0.7f, 2.1f}, 400) / (4 * kPi), 1.0, 1e-3);
  const ShapePtr disk = make_disk(Transform(), false, 0, 1, 0, 360);
  EXPECT_NEAR(mean_solid_angle(*disk, 0, {0, 0, 2}, 400), 2 * kPi * (1 - 2 / std::sqrt(5.0)), 1e-5);
  // From its long axis, an ellipsoid covers the tangent cone.
  const ShapePtr egg = make_sphere(Transform(scaled(1, 1, 3)), false, 1, -1, 1, 360);
  // The tangent from (0,0,6) to x^2 + z^2/9 = 1 touches at z = 1.5, x = sqrt(.75): tan = x / 4.5.
  const double tan2 = 0.75 / (4.5 * 4.5), cosine = 1 / std::sqrt(1 + tan2);
  EXPECT_NEAR(mean_solid_angle(*egg, 0, {0, 0, 6}, 400) / (2 * kPi * (1 - cosine)), 1.0, 1e-4);
}

TEST(Quadrics, OnlyTheNearSideOfASphereCanBeSampledFromOutside) {
  for (const bool reverse : {false, true}) {
    const ShapePtr sphere = make_sphere(Transform(), reverse, 1, -1, 1, 360);
    const float side = reverse ? -1.0f : 1.0f;
    EXPECT_GT(sphere->pdf_towards(0, {0, 0, 3}, {0, 0, 1}, Vec3f(0, 0, side)), 0.0f);
    EXPECT_EQ(sphere->pdf_towards(0, {0, 0, 3}, {0, 0, -1}, Vec3f(0, 0, -side)), 0.0f);
    EXPECT_GT(sphere->pdf_towards(0, {0, 0, 0.5f}, {0, 0, -1}, Vec3f(0, 0, -side)), 0.0f);
  }
}

TEST(Quadrics, OutsideFollowsReverseOrientationAndIsMirroredWithTheShape) {
  for (const bool reverse : {false, true})
    for (const bool mirrored : {false, true}) {
      const Transform t(scaled(1, 1, mirrored ? -1 : 1));
      const float expected = reverse ? -1.0f : 1.0f;
      const ShapePtr sphere = make_sphere(t, reverse, 1, -1, 1, 360);
      const SurfaceInteraction s = surface_at(*sphere, 0, {0.3f, 0.6f});
      EXPECT_NEAR(dot(s.ng, s.p), expected, 1e-6f);
      EXPECT_NEAR(
          dot(sphere->sample_area(0, {0.2f, 0.7f})->ng, sphere->sample_area(0, {0.2f, 0.7f})->p),
          expected, 1e-6f);
      Ray ray;
      ray.o = Vec3f(0, 0, mirrored ? -5 : 5);
      ray.d = -ray.o;
      SurfaceInteraction hit;
      make_disk(t, reverse, 1, 1, 0, 360)->fill(0, {0, 0.5f}, ray, 0.8f, hit);
      EXPECT_NEAR(hit.ng.z, expected * (mirrored ? -1.0f : 1.0f), 1e-6f);
    }
}

TEST(Quadrics, TextureCoordinatesAreThoseOfPbrt) {
  const ShapePtr sphere = make_sphere(Transform(), false, 2, -1, 2, 180);
  // v runs from the lower clip (0) to the top (1), u over phi_max.
  const SurfaceInteraction low = surface_at(*sphere, 0, {0.5f, 0});
  EXPECT_LT(length(low.p - Vec3f(0, std::sqrt(3.0f), -1)), 1e-5f);
  EXPECT_NEAR(surface_at(*sphere, 0, {0.25f, 1}).p.z, 2, 1e-5f);
  const SurfaceInteraction rim =
      surface_at(*make_disk(Transform(), false, 0, 2, 1, 360), 0, {0, 0});
  EXPECT_LT(length(rim.p - Vec3f(2, 0, 0)), 1e-6f);
  const SurfaceInteraction top =
      surface_at(*make_cylinder(Transform(), false, 1, -1, 3, 360), 0, {0.25f, 1});
  EXPECT_LT(length(top.p - Vec3f(0, 1, 3)), 1e-6f);
}

/// A signed function that is zero on the surface, and a test of the clipping limits.
struct Implicit {
  std::function<double(const Vec3d&)> value;
  std::function<bool(const Vec3d&)> kept;
};

/// First sign change along the ray at a kept point, in small steps. Negative if there is none.
double march(const Implicit& surface, const Vec3d& o, const Vec3d& d, double t_end, int steps) {
  double before = surface.value(o);
  for (int i = 1; i <= steps; ++i) {
    const double t = t_end * i / steps;
    const double after = surface.value(o + d * t);
    if (before * after <= 0.0) {
      double a = t - t_end / steps, b = t, va = before;
      for (int k = 0; k < 40; ++k) {
        const double m = 0.5 * (a + b), vm = surface.value(o + d * m);
        if (va * vm <= 0.0)
          b = m;
        else
          a = m, va = vm;
      }
      if (surface.kept(o + d * a)) return a;
    }
    before = after;
  }
  return -1.0;
}

double turn(const Vec3d& p) {
  return std::fmod(std::atan2(p.y, p.x) + 2 * double(kPi), 2 * double(kPi));
}

TEST(Quadrics, FirstHitIsTheOneFoundBySmallSteps) {
  Mat44d shear = scaled(1.2, 0.8, 1.0);
  shear[0][1] = 0.4;
  const Transform transform = turned_and_moved(9, shear);
  const auto ball = [](const Vec3d& p) { return p.dot(p) - 1; };
  const auto tube = [](const Vec3d& p) { return p.x * p.x + p.y * p.y - 0.49; };
  const auto always = [](const Vec3d&) { return true; };
  const double phi = 250.0 / 180.0 * double(kPi);
  const std::vector<std::pair<ShapePtr, Implicit>> shapes = {
      {make_sphere(transform, false, 1, -1, 1, 360), {ball, always}},
      {make_sphere(transform, false, 1, -0.4f, 0.7f, 250),
       {ball, [&](const Vec3d& p) { return p.z >= -0.4f && p.z <= 0.7f && turn(p) <= phi; }}},
      {make_disk(transform, false, 0.3f, 1, 0.4f, 250),
       {[](const Vec3d& p) { return p.z - 0.3f; },
        [&](const Vec3d& p) {
          const double r = std::hypot(p.x, p.y);
          return r >= 0.4f && r <= 1 && turn(p) <= phi;
        }}},
      {make_cylinder(transform, false, 0.7f, -1, 0.5f, 250),
       {tube, [&](const Vec3d& p) { return p.z >= -1 && p.z <= 0.5 && turn(p) <= phi; }}},
  };
  Random random(21);
  int hits = 0, disagreements = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto& [shape, implicit] = shapes[static_cast<size_t>(i) % shapes.size()];
    Ray ray;
    ray.o = Vec3f(0.5f, -1, 2) + random.in_box(2);
    ray.d = Vec3f(0.5f, -1, 2) + random.in_box(1.2f) - ray.o;
    const auto hit = shape->intersect(0, ray, 0.0f);
    Vec3d o, d;
    transform.inverse.multVecMatrix(Vec3d(ray.o.x, ray.o.y, ray.o.z), o);
    transform.inverse.multDirMatrix(Vec3d(ray.d.x, ray.d.y, ray.d.z), d);
    const double t = march(implicit, o, d, 8.0, 4000);
    if (hit.has_value() != (t >= 0)) {
      ++disagreements;  // grazing rays between two steps
      continue;
    }
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->t, t, 1e-5);
    SurfaceInteraction s;
    shape->fill(0, hit->uv, ray, hit->t, s);
    EXPECT_LT(length(s.p - (ray.o + ray.d * hit->t)), 2e-6f * (1 + hit->t));
    EXPECT_LT(length(s.p - surface_at(*shape, 0, s.uv).p), 2e-6f);
    EXPECT_TRUE(shape->bounds(0).intersects(s.p));
    ray.t_max = hit->t * 0.999f;
    EXPECT_FALSE(shape->intersect(0, ray, 0.0f));
    ray.t_max = kInfinity;
    const auto later = shape->intersect(0, ray, hit->t * 1.001f);
    EXPECT_TRUE(!later || later->t > hit->t);
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LE(disagreements, 3);
}

TEST(Quadrics, BoundsAreTight) {
  for (const Case& c : cases()) {
    const Bounds3f box = c.shape->bounds(0);
    Bounds3f seen;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j) {
        const Vec3f p = surface_at(*c.shape, 0, Vec2f(float(i) / 200, float(j) / 200)).p;
        EXPECT_TRUE(box.intersects(p)) << c.name;
        seen.extendBy(p);
      }
    const std::string name = c.name;
    if (name.find("cut") == std::string::npos && name.find("sector") == std::string::npos) {
      EXPECT_LT(length(box.min - seen.min), 2e-3f) << c.name;
      EXPECT_LT(length(box.max - seen.max), 2e-3f) << c.name;
    }
  }
}

TEST(Quadrics, RaysDoNotMeetTheSurfaceTheyLeave) {
  Random random(31);
  int hits = 0;
  for (int i = 0; i < 40000; ++i) {
    const float size = std::pow(10.0f, random.in(-4, 4));
    const Vec3f center = random.direction() * std::pow(10.0f, random.in(-4, 4));
    const bool equal = i % 2 == 0;
    const Mat44d m = scaled(size, equal ? size : size * random.in(0.05f, 1.0f),
                            equal ? size : size * random.in(0.05f, 1.0f)) *
                     random.rotation() * moved(center.x, center.y, center.z);
    const Transform transform(m);
    switch (i % 3) {
      case 0:
        hits += check_no_self_hits(*make_sphere(transform, false, 1, -1, 1, 360), center, size,
                                   true, random);
        break;
      case 1:
        hits += check_no_self_hits(*make_disk(transform, false, 0.1f, 1, 0, 360), center, size,
                                   false, random);
        break;
      default:
        hits += check_no_self_hits(*make_cylinder(transform, false, 0.5f, -1, 1, 300), center, size,
                                   true, random);
    }
  }
  EXPECT_GT(hits, 8000);
}

TEST(Quadrics, ErrorBoundsHoldTheTrueSurfaceAndLittleMore) {
  Random random(33);
  for (int i = 0; i < 20000; ++i) {
    const float radius = std::pow(10.0f, random.in(-4, 4));
    // Within a thousand radii, where rounding is small compared with the curvature.
    const Vec3f center = random.direction() * (radius * std::pow(10.0f, random.in(-3, 3)));
    const ShapePtr sphere = make_sphere(Transform(moved(center.x, center.y, center.z)), false,
                                        radius, -radius, radius, 360);
    const auto s = sphere->sample_area(0, random.square());
    const Vec3d from_center(double(s->p.x) - center.x, double(s->p.y) - center.y,
                            double(s->p.z) - center.z);
    // The true normal at the float point, and that point's distance from the sphere along it.
    const double distance = from_center.length();
    double bound = 0.0;
    for (int k = 0; k < 3; ++k) {
      bound += std::abs(from_center[k]) / distance * s->p_error[k];
      // At most half a unit in the last place, plus double's error where terms cancel.
      EXPECT_LE(s->p_error[k], std::abs(s->p[k]) * 0x1.01p-24f +
                                   1e-14f * (radius + std::abs(s->p[k]) + std::abs(center[k])));
    }
    EXPECT_LE(std::abs(distance - radius), 1.001 * bound) << radius << " at " << center;
  }
}

TEST(Quadrics, ErrorBoundsHoldWhereTheTransformCancels) {
  // A disk at 1e7 in object space, rotated and moved back: only double's error is left.
  Random random(34);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const Transform back(moved(0, 0, -1e7) * scaled(0.1, 0.2, 0.3) * random.rotation());
    const ShapePtr disk = make_disk(back, false, 1e7f, 1, 0, 360);
    hits += check_no_self_hits(*disk, {0, 0, 0}, 0.1f, false, random);
  }
  EXPECT_GT(hits, 500);
}

TEST(Quadrics, RaysIntoASphereCrossItOnce) {
  Random random(32);
  for (int i = 0; i < 20000; ++i) {
    const float radius = std::pow(10.0f, random.in(-3, 4));
    // Where floats can still represent points of the sphere.
    const Vec3f center = random.direction() * (radius * std::pow(10.0f, random.in(-3, 3)));
    const ShapePtr sphere = make_sphere(Transform(moved(center.x, center.y, center.z)), false,
                                        radius, -radius, radius, 360);
    const auto s = sphere->sample_area(0, random.square());
    Vec3f w = random.direction();
    if (dot(w, s->ng) > 0.0f) w = -w;
    if (dot(w, s->ng) > -0.05f) continue;
    Ray ray;
    ray.o = offset_ray_origin(s->p, s->p_error, s->ng, w);
    ray.d = w;
    const auto hit = sphere->intersect(0, ray, 0.0f);
    ASSERT_TRUE(hit);
    const float chord = -2.0f * radius * dot(w, s->ng);
    EXPECT_NEAR(hit->t / chord, 1.0f, 0.05f) << radius << " at " << center;
  }
}

TEST(Quadrics, PointsOfLargeShapesStayOnTheRay) {
  // A ground disk of radius 1e4, hit close to the viewer: the point must not snap to a grid of uv.
  const ShapePtr ground = make_disk(Transform(), false, 0, 1e4f, 0, 360);
  Ray ray;
  ray.o = Vec3f(3.3f, 4.7f, 1.5f);
  ray.d = Vec3f(0.31f, 0.17f, -0.5f);
  const auto hit = ground->intersect(0, ray, 0.0f);
  ASSERT_TRUE(hit);
  SurfaceInteraction s;
  ground->fill(0, hit->uv, ray, hit->t, s);
  EXPECT_LT(length(s.p - Vec3f(3.3f + 0.93f, 4.7f + 0.51f, 0)), 2e-6f);
}

TEST(Quadrics, ShapesWithoutAreaAreNeitherHitNorSampled) {
  const Transform t;
  for (const ShapePtr& shape :
       {make_sphere(t, false, 1, 0.5f, 0.5f, 360), make_disk(t, false, 0, 1, 1, 360),
        make_cylinder(t, false, 1, 2, 2, 360), make_sphere(t, false, 1, -1, 1, 0)}) {
    EXPECT_FALSE(shape->sample_area(0, {0.3f, 0.6f}));
    EXPECT_FALSE(shape->sample_towards(0, {3, 4, 5}, {0.3f, 0.6f}));
    EXPECT_EQ(shape->area(0), 0.0f);
  }
}

}  // namespace
}  // namespace nephroid
