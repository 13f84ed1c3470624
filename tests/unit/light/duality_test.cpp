// Emitted light equals received light: the flux through a disk by rays that leave the light, and by
// the light seen from the disk, for every kind of light.
#include "core/warps.h"
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

/// A receiver: one side of a disk.
struct Target {
  Vec3f center{0.2f, -0.1f, -0.5f};
  Vec3f normal = normalize(Vec3f(0.3f, 0.2f, 1));
  float radius = 0.8f;
};

Mean received(const Light& light, const Target& target, int count) {
  TestRandom random(11);
  const Frame frame = Frame::from_z(target.normal);
  const double area = kPi * target.radius * target.radius;
  Mean mean;
  for (int i = 0; i < count; ++i) {
    const Vec2f d = square_to_disk(random.next2()) * target.radius;
    const Vec3f p = target.center + frame.x * d.x + frame.y * d.y;
    mean.add(area * irradiance_sample(light, p, target.normal, random));
  }
  return mean;
}

Mean sent(const Light& light, const Target& target, int count) {
  return emitted_flux(light, count, [&](const Ray& ray) {
    const float slope = dot(ray.d, target.normal);
    if (slope >= 0) return 0.0;
    const float t = dot(target.center - ray.o, target.normal) / slope;
    return t > 0 && length(ray.o + ray.d * t - target.center) < target.radius ? 1.0 : 0.0;
  });
}

void expect_duality(const Light& light, const std::string& name) {
  const Target target;
  const Mean a = received(light, target, 100000), b = sent(light, target, 200000);
  EXPECT_GT(a.mean(), 0) << name;
  EXPECT_TRUE(agrees(a, b.mean(), b.error())) << name;
}

TEST(Duality, PointAndDistant) {
  const SceneSphere sphere{{0, 0, 0}, 4};
  for (const char* text :
       {"LightSource \"point\" \"point3 from\" [1 0 1.5]",
        "LightSource \"distant\" \"point3 from\" [1 0 3] \"point3 to\" [0 0 0]",
        "LightSource \"distant\" \"point3 from\" [1 0 3] \"point3 to\" [0 0 0] \"float angle\" 40",
        "LightSource \"distant\" \"point3 from\" [1 0 3] \"point3 to\" [0 0 0] \"float angle\" .53",
        "LightSource \"infinite\"",
        "LightSource \"spot\" \"point3 from\" [0 0 2] \"point3 to\" [0.5 0 0] \"float coneangle\" "
        "25 "
        "\"float conedeltaangle\" 20",
        "Scale 1 2 0.7 Rotate 30 1 1 0 LightSource \"spot\" \"point3 from\" [0 0 2] \"point3 to\" "
        "[0.5 0 0] \"float coneangle\" 35 \"float conedeltaangle\" 20"})
    expect_duality(*light_of(text, sphere), text);
}

TEST(Duality, Area) {
  const auto place = [](double z) {
    return Transform(Mat44d().setScale(Vec3d(1, 2, 0.5)) *
                     Mat44d().setAxisAngle(Vec3d(1, 0, 0), 0.4) *
                     Mat44d().setTranslation(Vec3d(0.1, 0, z)));
  };
  // A sphere hides its far side from the receiver, but not from its own rays here: use one side
  // only.
  const Transform above(Mat44d().setTranslation(Vec3d(0, 0.4, 1.5)));
  expect_duality(*area_light_of("", make_sphere(above, false, 0.5f, -0.5f, 0.5f, 360)), "sphere");
  for (const char* sides : {"", "\"bool twosided\" true"}) {
    expect_duality(*area_light_of(sides, make_disk(place(1.5), true, 0, 0.5f, 0.1f, 300)), "disk");
    expect_duality(*area_light_of(sides, make_cylinder(place(2), false, 0.4f, -0.5f, 0.5f, 360)),
                   std::string("cylinder ") + sides);
    expect_duality(*area_light_of(sides, rectangle(0.4f, 0.9f, 1.2f)), "rectangle");
    MeshData m;
    m.positions = {{-1, 0, 1.5f}, {0, 1, 1.4f}, {1, 0, 1.6f}};
    m.triangles = {0, 1, 2};
    expect_duality(*area_light_of(sides, std::make_shared<TriangleMesh>(m, false)), "triangle");
  }
}

TEST(Duality, ImageUnderAnyTransform) {
  const ScratchDirectory scratch;
  std::vector<float> rgb;
  for (int i = 0; i < 64; ++i)
    for (const int period : {5, 3, 7}) rgb.push_back(1.0f + static_cast<float>(i % period));
  write_square(scratch.file("sky.exr"), 8, rgb);
  for (const char* transform : {"", "Rotate 40 1 2 3", "Scale 1 2 0.5 Rotate 20 1 1 0"})
    expect_duality(*light_of(std::string(transform) +
                                 " LightSource \"infinite\" \"string filename\" \"sky.exr\"",
                             {{0, 0, 0}, 2}, scratch.path().string()),
                   transform);
}

TEST(Duality, ImagesFromAPointUnderAnyTransform) {
  const ScratchDirectory scratch;
  std::vector<float> rgb;
  for (int i = 0; i < 64; ++i)
    for (const int period : {5, 3, 7}) rgb.push_back(static_cast<float>(i % period));
  write_square(scratch.file("a.exr"), 8, rgb);
  write_square(scratch.file("wide.exr"), 16, rgb);
  for (const char* transform : {"Translate 0.3 0 1.5 Rotate 160 1 0.2 0",
                                "Translate 0 0 2 Scale 1 2 0.7 Rotate 170 1 0.3 0"})
    for (const char* light : {"\"projection\" \"string filename\" \"a.exr\"",
                              "\"projection\" \"string filename\" \"wide.exr\" \"float fov\" 40",
                              "\"goniometric\" \"string filename\" \"a.exr\""})
      expect_duality(
          *light_of(std::string(transform) + " LightSource " + light, {}, scratch.path().string()),
          std::string(transform) + light);
}

TEST(Duality, Portal) {
  const ScratchDirectory scratch;
  std::vector<float> rgb;
  for (int i = 0; i < 64; ++i)
    for (const int period : {5, 3, 7}) rgb.push_back(static_cast<float>(i % period));
  write_square(scratch.file("sky.exr"), 8, rgb);
  const std::string portal =
      "\"point3 portal\" [-0.5 -0.6 1.2  -0.5 0.4 1.5  0.7 0.4 1.5  0.7 -0.6 1.2]";
  for (const char* source : {"", "\"rgb L\" [1 2 3]", "\"string filename\" \"sky.exr\""})
    expect_duality(
        *light_of(std::string("Rotate 50 1 1 0 LightSource \"infinite\" ") + source + portal,
                  {{0, 0, 0}, 4}, scratch.path().string()),
        source);
}

}  // namespace
}  // namespace nephroid::testing_light
