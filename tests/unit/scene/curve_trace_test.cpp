// Curves in a scene: tessellated ribbons agree with recursive subdivision, curves of one kind share
// a geometry without changing a hit, and bad directives are located.
#include <gtest/gtest.h>

#include <optional>

#include "core/sampler.h"
#include "core/warps.h"
#include "input/pbrt_parser.h"
#include "scene/scene.h"
#include "unit/scene/numbers.h"

namespace nephroid {
namespace {

struct Built {
  Diagnostics diagnostics;
  std::unique_ptr<Scene> scene;
  explicit Built(const std::string& world) {
    const SceneDescription d =
        parse_pbrt_string("WorldBegin\n" + world, "test.pbrt", ".", diagnostics);
    scene = build_scene(d, {}, diagnostics);
  }
};

std::string curve_error(const std::string& world) {
  try {
    Built built(world);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

/// Random curves in the unit box, of every basis and degree.
std::string tangle(const std::string& type, int count) {
  Numbers u{7};
  std::string text;
  const bool ribbon = type == "ribbon";
  for (int i = 0; i < count; ++i) {
    const bool spline = i % 2 == 0;
    const int degree = i % 3 == 0 ? 2 : 3, points = degree == 2 ? 5 : 7;
    text += "Shape \"curve\" \"string type\" \"" + type + "\" \"string basis\" \"" +
            (spline ? "bspline" : "bezier") + "\" \"integer degree\" " + std::to_string(degree) +
            " \"point3 P\" [";
    Vec3f p = u.in_cube(0.5f);
    for (int k = 0; k < points; ++k, p += u.in_cube(0.4f))
      text += " " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
    text += " ] \"float width0\" 0.04 \"float width1\" 0.01";
    if (ribbon) {
      text += " \"normal N\" [";
      const int ends = spline ? points - degree + 1 : (points - 1) / degree + 1;
      for (int k = 0; k < ends; ++k) {
        const Vec3f n = u.in_cube(1.0f) + Vec3f(0, 0, 1.5f);
        text += " " + std::to_string(n.x) + " " + std::to_string(n.y) + " " + std::to_string(n.z);
      }
      text += " ]";
    }
    text += "\n";
  }
  return text;
}

/// First hit of all pieces of all records, by the shapes' own intersection.
std::optional<SurfaceInteraction> brute_force(const Scene& scene, const Ray& ray) {
  std::optional<ShapeHit> first;
  const Shape* shape = nullptr;
  uint32_t piece = 0;
  for (const ShapeRecord& record : scene.top.records)
    for (uint32_t i = 0; i < record.shape->primitive_count(); ++i) {
      Ray rest = ray;
      if (first) rest.t_max = first->t;
      const auto hit = record.shape->intersect(i, rest, 0.0f);
      if (!hit) continue;
      first = hit;
      shape = record.shape.get();
      piece = i;
    }
  if (!first) return std::nullopt;
  SurfaceInteraction at;
  shape->fill(piece, first->uv, ray, first->t, at);
  at.distance = first->t * length(ray.d);
  return at;
}

TEST(CurveTracing, AgreesWithRecursiveSubdivision) {
  for (const char* type : {"flat", "cylinder", "ribbon"}) {
    const Built built(tangle(type, 30));
    const Scene& scene = *built.scene;
    EXPECT_EQ(scene.shape_count, 1u);
    Numbers u{31};
    int hits = 0, missed = 0, elsewhere = 0, shadows = 0;
    constexpr int kRays = 3000;
    for (int i = 0; i < kRays; ++i) {
      Ray ray;
      ray.d = normalize(u.in_cube(1.0f)) * (0.2f + u());
      ray.o = u.in_cube(0.7f) - ray.d * (3.0f / length(ray.d));
      const auto expected = brute_force(scene, ray);
      SurfaceInteraction found;
      const bool hit = scene.intersect(ray, found);
      shadows += hit != scene.top.accelerator->occluded(ray, kMaskAll);
      if (hit != expected.has_value()) {
        ++missed;
        continue;
      }
      if (!hit) continue;
      ++hits;
      // Along a curve that is parallel to the ray, the tessellation's depth is less accurate.
      if (std::abs(found.distance - expected->distance) > 0.01f) {
        ++elsewhere;  // another curve behind an edge that only one of the two hits
        continue;
      }
      EXPECT_LT(length(found.p - expected->p), 1e-3f);
      EXPECT_NEAR(found.uv.y, expected->uv.y, 0.05f);
      EXPECT_GT(dot(found.shading.x, expected->shading.x), 0.99f);
    }
    EXPECT_GT(hits, 300) << type;
    // Only rays at an edge may differ.
    EXPECT_LE(missed + elsewhere, hits / 50) << type;
    EXPECT_EQ(shadows, 0) << type;
  }
}

TEST(CurveTracing, CurvesAlikeShareAGeometryAndNothingElse) {
  const std::string curves = tangle("cylinder", 12);
  const Built together(curves);
  EXPECT_EQ(together.scene->top.records.size(), 1u);
  // Tiny spheres between the curves keep them apart.
  std::string apart;
  for (size_t at = 0; at < curves.size();) {
    const size_t end = curves.find('\n', at) + 1;
    apart += curves.substr(at, end - at);
    apart += "Shape \"sphere\" \"float radius\" 1e-6\n";
    at = end;
  }
  const Built separate(apart);
  EXPECT_EQ(separate.scene->top.records.size(), 24u);
  Numbers u{5};
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray ray;
    ray.d = normalize(u.in_cube(1.0f));
    ray.o = u.in_cube(0.7f) - ray.d * 3.0f;
    SurfaceInteraction a, b;
    const bool hit = together.scene->intersect(ray, a);
    ASSERT_EQ(hit, separate.scene->intersect(ray, b));
    if (!hit) continue;
    ++hits;
    EXPECT_EQ(a.p, b.p);
    EXPECT_EQ(a.uv, b.uv);
  }
  EXPECT_GT(hits, 100);
  // Another material, transform, orientation or type starts another geometry.
  const std::string one = R"(Shape "curve" "point3 P" [0 0 0 1 0 0 2 0 0 3 1 0] )";
  const Built various(one + one + "Material \"hair\" " + one + "Translate 0 1 0 " + one +
                      "ReverseOrientation " + one + one + "\"string type\" \"cylinder\" " + one +
                      "\"float alpha\" 0.5 " + one);
  EXPECT_EQ(various.scene->top.records.size(), 7u);
  EXPECT_EQ(various.scene->top.records[0].shape->primitive_count(),
            2 * various.scene->top.records[1].shape->primitive_count());
}

TEST(CurveTracing, ThickCurvesAreSmooth) {
  const Vec3f p[] = {{-0.5f, 0.05f, 0}, {-0.9f, 1, 0}, {0.1f, 1.2f, 0}, {-0.4f, 2, 0}};
  const Built built(
      R"(Shape "curve" "float width" 0.26 "point3 P" [-.5 .05 0  -.9 1 0  .1 1.2 0  -.4 2 0] )");
  int missed = 0;
  for (int i = 1; i < 400; ++i) {
    const float s = (static_cast<float>(i) + 0.3f) / 401, r = 1 - s;  // between Embree's parts
    const Vec3f at =
        p[0] * (r * r * r) + p[1] * (3 * r * r * s) + p[2] * (3 * r * s * s) + p[3] * (s * s * s);
    const Vec3f along =
        normalize((p[1] - p[0]) * (r * r) + (p[2] - p[1]) * (2 * r * s) + (p[3] - p[2]) * (s * s));
    for (const float side : {-1.0f, 1.0f}) {
      Ray ray;
      ray.o = at + Vec3f(-along.y, along.x, 0) * (side * 0.98f * 0.13f) - Vec3f(0, 0, 3);
      ray.d = {0, 0, 1};
      SurfaceInteraction hit;
      missed += built.scene->intersect(ray, hit) ? 0 : 1;
    }
  }
  EXPECT_EQ(missed, 0);
}

TEST(CurveTracing, StretchedCurvesAndInstancesAreMet) {
  const std::string one =
      R"(Shape "curve" "point3 P" [-1 0 0 -.3 0 0 .3 0 0 1 0 0] "float width" 0.2 )";
  const Built built("Scale 2 3 1 " + one + R"(
      ObjectBegin "o" )" +
                    one + R"( ObjectEnd
      Translate 0 2 0 ObjectInstance "o")");
  Ray ray;
  ray.d = Vec3f(0, 0, 1);
  SurfaceInteraction hit;
  // Widths are in object space: 0.3 to each side, and three times that for the scaled curve.
  for (const auto& [centre, half] : {std::pair(0.0f, 0.3f), std::pair(6.0f, 0.9f)})
    for (const float part : {-1.02f, -0.98f, 0.98f, 1.02f}) {
      ray.o = Vec3f(1.9f, centre + half * part, -4);
      EXPECT_EQ(built.scene->intersect(ray, hit), std::abs(part) < 1.0f) << centre << " " << part;
    }
}

TEST(CurveTracing, CurvesMove) {
  const std::string one =
      R"(Shape "curve" "point3 P" [-1 0 0 -.3 0 0 .3 0 0 1 0 0] "float width" 0.2 )";
  const Built built("Translate 0 5 0 ActiveTransform EndTime Translate 0 2 0 ActiveTransform All " +
                    one + one);
  Ray ray;
  ray.d = Vec3f(0, 0, 1);
  SurfaceInteraction hit;
  for (const float time : {0.0f, 0.5f, 1.0f})
    for (const float offset : {-0.11f, -0.09f, 0.09f, 0.11f}) {
      ray.time = time;
      ray.o = Vec3f(0.4f, 5 + 2 * time + offset, -4);
      EXPECT_EQ(built.scene->intersect(ray, hit), std::abs(offset) < 0.1f) << time << " " << offset;
    }
}

TEST(CurveTracing, WrongDirectivesGetLocatedErrors) {
  const std::string p4 = "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 1 0] ";
  const auto expect_error = [](const std::string& directive, const std::string& text) {
    const std::string error = curve_error(directive);
    EXPECT_NE(error.find("test.pbrt:2:"), std::string::npos) << error;
    EXPECT_NE(error.find(text), std::string::npos) << error;
  };
  expect_error("Shape \"curve\"", "0 points");
  expect_error("Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 1 0 4 0 0]", "3 more");
  expect_error("Shape \"curve\" \"string basis\" \"bspline\" \"point3 P\" [0 0 0 1 0 0]",
               "at least 4");
  expect_error("Shape \"curve\" \"integer degree\" 4 " + p4, "degree 4, expected 2 or 3");
  expect_error("Shape \"curve\" \"string basis\" \"hermite\" " + p4, "\"hermite\" is unknown");
  expect_error("Shape \"curve\" \"string type\" \"tube\" " + p4, "\"tube\" is unknown");
  expect_error("Shape \"curve\" \"string type\" \"ribbon\" " + p4, "0 normals \"N\", expected 2");
  expect_error("Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [0 0 1 0 0 0] " + p4,
               "is zero");
  expect_error("Shape \"curve\" \"float width\" -1 " + p4, "negative");
  expect_error("Shape \"curve\" \"point3 P\" [0 0 0 1e18 0 0 2 0 0 3 1 0]", "too far away");
  expect_error("AreaLightSource \"diffuse\" Shape \"curve\" " + p4, "cannot be an area light");

  const Built warned("Shape \"curve\" \"float width\" 0 " + p4 +
                     "\nShape \"curve\" \"point3 P\" [1 1 1 1 1 1 1 1 1 1 1 1]\n" +
                     "Shape \"curve\" \"normal N\" [0 0 1] " + p4);
  EXPECT_EQ(warned.scene->primitive_count, Built("Shape \"curve\" " + p4).scene->primitive_count);
  std::string all;
  for (const Warning& w : warned.diagnostics.warnings()) all += located(w.where, w.message) + "\n";
  EXPECT_NE(all.find("test.pbrt:2:1: curve has no width"), std::string::npos) << all;
  EXPECT_NE(all.find("\"N\" of a curve is ignored"), std::string::npos) << all;
}

}  // namespace
}  // namespace nephroid
