// The outside of shapes: transforms map it like normals, so that a mirrored ball emits outwards and
// contains its glass, for any shape and any position of the mirror.
#include <gtest/gtest.h>

#include "core/sampler.h"
#include "core/warps.h"
#include "input/pbrt_parser.h"
#include "scene/scene.h"
#include "unit/scene/numbers.h"

namespace nephroid {
namespace {

std::unique_ptr<Scene> scene_with(const std::string& world) {
  Diagnostics diagnostics;
  return build_scene(parse_pbrt_string("WorldBegin\n" + world, "t.pbrt", ".", diagnostics), {},
                     diagnostics);
}

/// A transform, and its text in the scene format.
struct Map {
  std::string text;
  Transform transform;
  bool keeps_angles;
};

Map scaled_and_moved(double x, double y, double z, bool keeps_angles) {
  Mat44d scale, move;
  scale.setScale(Vec3d(x, y, z));
  move.setTranslation(Vec3d(3, 1, -2));
  return {"Translate 3 1 -2 Scale " + std::to_string(x) + " " + std::to_string(y) + " " +
              std::to_string(z) + "\n",
          Transform(scale * move), keeps_angles};
}

const std::vector<Map>& mirrors() {
  static const std::vector<Map> all = {scaled_and_moved(-1.5, 1.5, 1.5, true),
                                       scaled_and_moved(-2, -2, -2, true),
                                       scaled_and_moved(1, -0.5, 2, false)};
  return all;
}

/// A closed tetrahedron around the origin, counter-clockwise from outside.
const std::string kTetrahedron =
    "Shape \"trianglemesh\" \"point3 P\" [1 1 1  -1 -1 1  -1 1 -1  1 -1 -1]\n"
    "  \"integer indices\" [0 2 1  0 1 3  0 3 2  1 2 3] ";
const std::string kNormals = "\"normal N\" [1 1 1  -1 -1 1  -1 1 -1  1 -1 -1] ";

/// The outward direction at a point, in shape space.
using Outwards = Vec3f (*)(const Vec3f& p);
struct Case {
  const char* name;
  std::string shape;
  Outwards outwards;  ///< null: the direction of the unmirrored shape
  /// Mirrored exactly only by conformal maps: vertex normals or rays choose the outside.
  bool needs_angles;
};

std::vector<Case> cases() {
  const Outwards away = [](const Vec3f& p) { return p; };
  const Outwards from_axis = [](const Vec3f& p) { return Vec3f(p.x, p.y, 0); };
  const Outwards up = [](const Vec3f&) { return Vec3f(0, 0, 1); };
  const std::string curve =
      "Shape \"curve\" \"float width\" 0.8 \"point3 P\" [-1 0 0  -0.4 0.3 0.2  0.4 0.2 0.1  1 0 0]";
  return {
      {"sphere", "Shape \"sphere\" \"float radius\" 0.9", away, false},
      {"cut sphere", "Shape \"sphere\" \"float zmax\" 0.5 \"float phimax\" 250", away, false},
      {"cylinder", "Shape \"cylinder\" \"float radius\" 0.7", from_axis, false},
      {"disk", "Shape \"disk\" \"float radius\" 1.2", up, false},
      {"mesh", kTetrahedron, away, false},
      {"mesh with normals", kTetrahedron + kNormals, away, true},
      {"patch", "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0  1 -1 0  -1 1 0  1 1 0.1]", up,
       false},
      {"patch with normals",
       "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]\n"
       "  \"normal N\" [0 0 -1  0 0 -1  0 0.1 -1  0 0 -1]",
       [](const Vec3f&) { return Vec3f(0, 0, -1); }, false},
      {"subdivision",
       "Shape \"loopsubdiv\" \"integer levels\" 2\n"
       "  \"point3 P\" [1 1 1  -1 -1 1  -1 1 -1  1 -1 -1]\n"
       "  \"integer indices\" [0 2 1  0 1 3  0 3 2  1 2 3]",
       nullptr, false},
      {"flat curve", curve, nullptr, true},
      {"round curve", curve + " \"string type\" \"cylinder\"", nullptr, true},
      {"ribbon", curve + " \"string type\" \"ribbon\" \"normal N\" [0 0 1 0 0.2 1]", nullptr, true},
  };
}

/// The shape under a map: alone, in an object whose shapes or instances are mapped, and moving.
std::vector<std::string> placed(const std::string& shape, const std::string& map) {
  const std::string object = "ObjectBegin \"o\"\n";
  return {"AttributeBegin\n" + map + shape + "\nAttributeEnd\n",
          object + map + shape + "\nObjectEnd\nObjectInstance \"o\"\n",
          object + shape + "\nObjectEnd\nAttributeBegin\n" + map +
              "ObjectInstance \"o\"\nAttributeEnd\n",
          "AttributeBegin\n" + map +
              "ActiveTransform EndTime Translate 9 0 0 ActiveTransform All\n" + shape +
              "\nAttributeEnd\n"};
}

Ray random_ray(Numbers& u) {
  Ray ray;
  ray.o = square_to_sphere(u.pair()) * 6.0f;
  ray.d = square_to_sphere(u.pair()) * 0.5f - ray.o;
  return ray;
}
Ray mapped(const Ray& ray, const Transform& t) {
  Ray to = ray;
  to.o = t.point(ray.o);
  to.d = t.vector(ray.d);
  return to;
}

TEST(Orientation, OfAShapeIsAwayFromItUnlessReversed) {
  for (const Case& c : cases()) {
    if (!c.outwards) continue;
    SCOPED_TRACE(c.name);
    for (const bool reverse : {false, true}) {
      const auto scene = scene_with((reverse ? "ReverseOrientation\n" : "") + c.shape);
      Numbers u{7};
      int hits = 0;
      for (int i = 0; i < 500; ++i) {
        SurfaceInteraction hit;
        if (!scene->intersect(random_ray(u), hit)) continue;
        ++hits;
        EXPECT_EQ(dot(hit.ng, c.outwards(hit.p)) > 0.0f, !reverse);
        EXPECT_EQ(dot(hit.shading.z, c.outwards(hit.p)) > 0.0f, !reverse);
      }
      EXPECT_GT(hits, 50);
    }
  }
}

TEST(Orientation, IsMappedAsNormalsAre) {
  for (const Case& c : cases())
    for (const Map& map : mirrors()) {
      if (c.needs_angles && !map.keeps_angles) continue;
      for (const std::string reverse : {"", "ReverseOrientation\n"}) {
        const auto plain = scene_with(reverse + c.shape);
        for (const std::string& world : placed(reverse + c.shape, map.text)) {
          SCOPED_TRACE(world);
          const auto scene = scene_with(world);
          Numbers u{11};
          int hits = 0, differing = 0;
          for (int i = 0; i < 300; ++i) {
            const Ray ray = random_ray(u);
            SurfaceInteraction a, b;
            const bool met = plain->intersect(ray, a);
            if (met != scene->intersect(mapped(ray, map.transform), b)) ++differing;
            if (!met || b.record == nullptr) continue;
            ++hits;
            // A ray at the rim may hit another part of the surface.
            if (length(map.transform.point(a.p) - b.p) > 1e-3f)
              ++differing;
            else if (length(normalize(map.transform.normal(a.ng)) - b.ng) > 2e-2f ||
                     length(normalize(map.transform.normal(a.shading.z)) - b.shading.z) > 2e-2f)
              ADD_FAILURE() << a.ng << " at " << a.p << " became " << b.ng;
          }
          EXPECT_GT(hits, 20);
          EXPECT_LE(differing, 3);
        }
      }
    }
}

TEST(Orientation, MirroredLampsShineOutwards) {
  const auto lambda = SampledWavelengths::sample_visible(0.37f);
  for (const Case& c : cases()) {
    // Closed shapes, visible from their centre and from outside.
    const std::string name = c.name;
    if (name != "sphere" && name != "mesh" && name != "mesh with normals" && name != "cylinder")
      continue;
    for (const Map& map : mirrors()) {
      if (c.needs_angles && !map.keeps_angles) continue;
      for (const bool reverse : {false, true}) {
        const std::string world = "AreaLightSource \"diffuse\"\n" + map.text +
                                  (reverse ? "ReverseOrientation\n" : "") + c.shape;
        SCOPED_TRACE(world);
        const auto scene = scene_with(world);
        const Vec3f middle = map.transform.point({0, 0, 0});
        Numbers u{13};
        for (int i = 0; i < 200; ++i) {
          // Paths that hit the lamp, next-event estimation and photons agree on the emitting side.
          const Ray ray = mapped(random_ray(u), map.transform);
          SurfaceInteraction hit;
          if (!scene->intersect(ray, hit)) continue;
          const Light& light = *scene->lights.at(hit.area_light);
          const auto shines = [&](const Vec3f& towards) {
            const Vec3f w = normalize(towards - hit.p);
            return !light.radiance(hit.p, hit.ng, hit.uv, w, lambda).is_black();
          };
          EXPECT_EQ(shines(hit.p + (hit.p - middle)), !reverse);
          EXPECT_EQ(shines(middle), reverse);
          const auto sample = light.sample_towards(middle, u.pair(), lambda);
          EXPECT_EQ(sample && !sample->radiance.is_black(), reverse);
          const auto photon = light.sample_emission(u.pair(), u.pair(), lambda);
          ASSERT_TRUE(photon);
          EXPECT_GT(dot(photon->ray.d, photon->ng), 0.0f);
          EXPECT_EQ(dot(photon->ng, photon->ray.o - middle) > 0.0f, !reverse);
        }
      }
    }
  }
}

}  // namespace
}  // namespace nephroid
