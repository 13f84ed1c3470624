// Shapes of Mitsuba: geometry, orientation, groups and files.
#include <cmath>

#include "input/mitsuba/mesh_shapes.h"
#include "input/mitsuba/serialized_mesh.h"
#include "unit/input/mitsuba_files.h"
#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

using Numbers = std::vector<double>;

std::string shape(const std::string& type, const std::string& body = "") {
  return "<shape type=\"" + type + "\">" + body + "</shape>\n";
}
std::string shape_file(const std::string& name) {
  return "<string name=\"filename\" value=\"" + name + "\"/>\n";
}

Vec3d point_at(const ShapeDescription& s, size_t i) {
  const Numbers p = parameter(s.parameters, "P").numbers;
  return {p.at(3 * i), p.at(3 * i + 1), p.at(3 * i + 2)};
}
/// Normal of a triangle by its winding, as it is without "N".
Vec3d face_normal(const ShapeDescription& s, size_t triangle) {
  const Numbers indices = parameter(s.parameters, "indices").numbers;
  const auto corner = [&](size_t i) {
    return point_at(s, static_cast<size_t>(indices.at(3 * triangle + i)));
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

TEST(MitsubaShape, SphereHasCentreAndRadiusInItsTransform) {
  MitsubaScene scene;
  const ShapeDescription s =
      scene
          .read(shape("sphere",
                      "<point name=\"center\" x=\"1\" z=\"3\"/><float name=\"radius\" "
                      "value=\"2\"/><transform name=\"toWorld\"><scale value=\"10\"/>"
                      "</transform><boolean name=\"flipNormals\" value=\"true\"/>"))
          .shapes[0];
  EXPECT_EQ(number(s.parameters, "radius"), 2);
  Vec3d center;
  s.transform.start.multVecMatrix(Vec3d(0.0), center);
  EXPECT_EQ(center, Vec3d(10, 0, 30));
  EXPECT_TRUE(s.reverse_orientation);
}

TEST(MitsubaShape, CylinderRunsFromPointToPoint) {
  MitsubaScene scene;
  const ShapeDescription s =
      scene
          .read(shape("cylinder",
                      "<point name=\"p0\" value=\"1, 1, 1\"/><point name=\"p1\" "
                      "value=\"1, 4, 5\"/><float name=\"radius\" value=\"0.5\"/>"))
          .shapes[0];
  EXPECT_EQ(number(s.parameters, "zmin"), 0);
  EXPECT_NEAR(number(s.parameters, "zmax"), 5, 1e-12);
  Vec3d from, to, side;
  s.transform.start.multVecMatrix(Vec3d(0, 0, 0), from);
  s.transform.start.multVecMatrix(Vec3d(0, 0, 5), to);
  s.transform.start.multDirMatrix(Vec3d(1, 0, 0), side);
  EXPECT_NEAR((from - Vec3d(1, 1, 1)).length(), 0, 1e-6);
  EXPECT_NEAR((to - Vec3d(1, 4, 5)).length(), 0, 1e-6);
  EXPECT_NEAR(side.dot(to - from), 0, 1e-6);
  EXPECT_GT(s.transform.start.determinant(), 0);
}

TEST(MitsubaShape, RectangleFacesZWithTheTextureUpsideDown) {
  MitsubaScene scene;
  const ShapeDescription s = scene.read(shape("rectangle")).shapes[0];
  EXPECT_EQ(face_normal(s, 0), Vec3d(0, 0, 1));
  EXPECT_EQ(face_normal(s, 1), Vec3d(0, 0, 1));
  // Mitsuba has uv = (0, 0) at (-1, -1), and there the first pixel of an image: pbrt-v4's v = 1.
  EXPECT_EQ(point_at(s, 0), Vec3d(-1, -1, 0));
  const Numbers uv = parameter(s.parameters, "uv").numbers;
  EXPECT_EQ((Numbers{uv[0], uv[1]}), (Numbers{0, 1}));
}

TEST(MitsubaShape, CubeFacesOutwards) {
  MitsubaScene scene;
  const ShapeDescription s = scene.read(shape("cube")).shapes[0];
  const Numbers indices = parameter(s.parameters, "indices").numbers;
  ASSERT_EQ(indices.size(), 36u);
  double area = 0;
  for (size_t t = 0; t < 12; ++t) {
    const Vec3d corner = point_at(s, static_cast<size_t>(indices[3 * t]));
    EXPECT_NEAR(face_normal(s, t).dot(corner), 1, 1e-12);
    const Vec3d a = point_at(s, static_cast<size_t>(indices[3 * t + 1])) - corner;
    const Vec3d b = point_at(s, static_cast<size_t>(indices[3 * t + 2])) - corner;
    area += 0.5 * a.cross(b).length();
  }
  EXPECT_NEAR(area, 24, 1e-12);
}

// Corners and their uv in Mitsuba's src/shapes/cube.cpp.
TEST(MitsubaShape, ACubeHasMitsubasTextureCoordinates) {
  MitsubaScene scene;
  const ShapeDescription s = scene.read(shape("cube")).shapes[0];
  const Numbers uv = parameter(s.parameters, "uv").numbers;
  const auto expect_uv = [&](const Vec3d& normal, const Vec3d& p, double u, double v) {
    const Numbers indices = parameter(s.parameters, "indices").numbers;
    int found = 0;
    for (size_t t = 0; t < 12; ++t)
      for (size_t k = 0; k < 3; ++k) {
        const auto i = static_cast<size_t>(indices[3 * t + k]);
        if (face_normal(s, t).dot(normal) < 0.9 || !(point_at(s, i) == p)) continue;
        EXPECT_EQ(uv[2 * i], u) << p.x << p.y << p.z;
        EXPECT_EQ(uv[2 * i + 1], 1 - v) << p.x << p.y << p.z;
        ++found;
      }
    EXPECT_GT(found, 0);
  };
  expect_uv({0, -1, 0}, {1, -1, -1}, 0, 1);
  expect_uv({0, -1, 0}, {-1, -1, 1}, 1, 0);
  expect_uv({0, 1, 0}, {1, 1, -1}, 0, 1);
  expect_uv({0, 1, 0}, {-1, 1, 1}, 1, 0);
  expect_uv({1, 0, 0}, {1, -1, -1}, 0, 1);
  expect_uv({1, 0, 0}, {1, 1, 1}, 1, 0);
  expect_uv({0, 0, 1}, {1, -1, 1}, 0, 1);
  expect_uv({0, 0, 1}, {1, 1, 1}, 1, 1);
  expect_uv({-1, 0, 0}, {-1, -1, 1}, 0, 1);
  expect_uv({-1, 0, 0}, {-1, 1, -1}, 1, 0);
  expect_uv({0, 0, -1}, {1, 1, -1}, 0, 1);
  expect_uv({0, 0, -1}, {-1, -1, -1}, 1, 0);
}

TEST(MitsubaShape, SerializedMeshesOfBothVersionsAndPrecisions) {
  for (const int version : {3, 4})
    for (const bool is_double : {false, true}) {
      SerializedSample first, second;
      second.positions = {{0, 0, 1}, {2, 0, 1}, {0, 3, 1}, {1, 1, 7}};
      second.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
      second.uvs = {{0, 0}, {1, 0.25f}, {0, 1}, {0.5f, 0.5f}};
      second.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
      second.triangles = {0, 1, 2, 0, 2, 3};
      for (SerializedSample* mesh : {&first, &second}) {
        mesh->version = version;
        mesh->is_double = is_double;
      }
      MitsubaScene scene;
      scene.folder().write("m.serialized", serialized_file({first, second}));
      const ShapeDescription s =
          scene
              .read(shape("serialized", shape_file("m.serialized") +
                                            "<integer name=\"shapeIndex\" value=\"1\"/>"))
              .shapes[0];
      EXPECT_EQ(point_at(s, 3), Vec3d(1, 1, 7));
      EXPECT_EQ(parameter(s.parameters, "indices").numbers, (Numbers{0, 1, 2, 0, 2, 3}));
      EXPECT_EQ(parameter(s.parameters, "N").numbers.at(4), 1);
      EXPECT_EQ(parameter(s.parameters, "uv").numbers.at(3), 0.75);
      // Red, green, blue and alpha for each vertex.
      EXPECT_EQ(parameter(s.parameters, "vertexcolors").numbers.at(5), 1);
      EXPECT_EQ(parameter(s.parameters, "vertexcolors").numbers.size(), 16u);
    }
}

TEST(MitsubaShape, SerializedFaultsAreErrors) {
  const std::string good = serialized_file({SerializedSample()});
  const auto error = [](const std::string& bytes, int index = 0) {
    return error_of([&] { mitsuba::read_serialized(bytes, index, {}); });
  };
  EXPECT_EQ(error(good), "no error");
  EXPECT_EQ(error(good, 1), "the file cannot be used: there is no mesh 1, expected 0 to 0");
  EXPECT_EQ(error(""), "the file cannot be used: the file ends too early");
  EXPECT_EQ(error("hello, this is a text"),
            "the file cannot be used: the bytes at a mesh are not 1c 04, expected a .serialized "
            "file");
  std::string other_version = good;
  other_version[2] = 5;
  EXPECT_EQ(error(other_version),
            "the file cannot be used: the file has version 5, expected 3 or 4");
  std::string many = good;
  many[many.size() - 1] = '\x7f';
  EXPECT_NE(error(many).find("claims to hold 2130706433 meshes"), std::string::npos);
  std::string damaged = good;
  damaged[8] = '\x55';
  EXPECT_NE(error(damaged).find("mesh 0 of the file: "), std::string::npos);
  SerializedSample bad_index;
  bad_index.triangles = {0, 1, 3};
  EXPECT_EQ(error(serialized_file({bad_index})),
            "the file cannot be used: a triangle has vertex 3, expected one of 3");
  SerializedSample claim;
  claim.claimed_triangles = uint64_t{1} << 33;
  EXPECT_EQ(error(serialized_file({claim})), "mesh 0 of the file: the data end too early");
  SerializedSample nan;
  nan.positions[1].y = NAN;
  EXPECT_EQ(error(serialized_file({nan})),
            "the file cannot be used: a position is not finite, expected finite numbers");
}

TEST(MitsubaShape, EachCutOfASerializedFileIsAnErrorOrAMesh) {
  const std::string good = serialized_file({SerializedSample(), SerializedSample()});
  for (size_t size = 0; size < good.size(); ++size)
    error_of([&] { mitsuba::read_serialized(good.substr(0, size), 1, {}); });
}

TEST(MitsubaShape, MeshesWithoutNormalsBecomeSmoothUnlessTheyAreFaceted) {
  MitsubaScene scene;
  // Two faces of a roof; the ridge is shared.
  scene.folder().write("roof.obj", "v -1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 1\nf 1 2 4\nf 2 3 4\n");
  const ShapeDescription smooth = scene.read(shape("obj", shape_file("roof.obj"))).shapes[0];
  const Numbers n = parameter(smooth.parameters, "N").numbers;
  const double length = std::sqrt(0.5);
  // Corners of one face have its normal, those of the ridge the mean, by angle.
  EXPECT_NEAR(n[0], length, 1e-6);
  EXPECT_NEAR(n[1], -length, 1e-6);
  const Vec3d ridge(n[3], n[4], n[5]);
  EXPECT_NEAR(ridge.length(), 1, 1e-6);
  EXPECT_LT(std::abs(ridge.x), length);
  const ShapeDescription faceted =
      scene
          .read(shape("obj",
                      shape_file("roof.obj") + "<boolean name=\"faceNormals\" value=\"true\"/>"))
          .shapes[0];
  EXPECT_FALSE(has_parameter(faceted.parameters, "N"));
}

TEST(MitsubaShape, MirrorsTurnMeshesWithoutNormalsOver) {
  MitsubaScene scene;
  scene.folder().write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  scene.folder().write("full.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  scene.folder().write("bare.ply",
                       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\nelement face 1\n"
                       "property list uchar int vertex_index\nend_header\n"
                       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string mirror = "<transform name=\"toWorld\"><scale x=\"-1\"/></transform>";
  const std::string faceted = "<boolean name=\"faceNormals\" value=\"true\"/>";
  const std::string flip = "<boolean name=\"flipNormals\" value=\"true\"/>";
  const auto is_turned = [&](const std::string& type, const std::string& body) {
    return scene.read(shape(type, body)).shapes.at(0).reverse_orientation;
  };
  EXPECT_TRUE(is_turned("obj", shape_file("bare.obj") + mirror));
  EXPECT_TRUE(is_turned("obj", shape_file("bare.obj") + mirror + faceted));
  EXPECT_TRUE(is_turned("obj", shape_file("full.obj") + mirror + faceted));
  EXPECT_TRUE(is_turned("ply", shape_file("bare.ply") + mirror + faceted));
  EXPECT_FALSE(is_turned("obj", shape_file("bare.obj")));
  EXPECT_FALSE(is_turned("obj", shape_file("full.obj") + mirror));
  EXPECT_FALSE(is_turned("obj", shape_file("bare.obj") + mirror + flip));
  // Mitsuba's own shapes have normals.
  EXPECT_FALSE(is_turned("rectangle", mirror));
  EXPECT_FALSE(is_turned("cube", mirror));
}

TEST(MitsubaShape, TextureCoordinatesOfFilesAreTurnedOver) {
  MitsubaScene scene;
  scene.folder().write("uv.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nf 1/1 2/1 3/1\n");
  const std::string flip = "<boolean name=\"flipTexCoords\" value=\"false\"/>";
  // Mitsuba turns those of OBJ over by itself.
  EXPECT_EQ(parameter(scene.read(shape("obj", shape_file("uv.obj"))).shapes[0].parameters, "uv")
                .numbers.at(1),
            0.25);
  EXPECT_EQ(
      parameter(scene.read(shape("obj", shape_file("uv.obj") + flip)).shapes[0].parameters, "uv")
          .numbers.at(1),
      0.75);
}

TEST(MitsubaShape, PlyFilesWithNormalsAreLeftToTheLoader) {
  const auto ply = [](const std::string& properties, const std::string& rest) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\n" +
        properties + "element face 1\nproperty list uchar int vertex_index\nend_header\n";
    for (const char* point : {"0 0 0", "1 0 0", "0 1 0"}) text += point + rest + "\n";
    return text + "3 0 1 2\n";
  };
  MitsubaScene scene;
  scene.folder().write("n.ply",
                       ply("property float nx\nproperty float ny\nproperty float nz\n", " 0 0 1"));
  scene.folder().write("uv.ply", ply("property float u\nproperty float v\n", " 0.5 0.25"));
  const ShapeDescription direct = scene.read(shape("ply", shape_file("n.ply"))).shapes[0];
  EXPECT_EQ(direct.type, "plymesh");
  EXPECT_EQ(text(direct.parameters, "filename"), "n.ply");
  const ShapeDescription with_uv = scene.read(shape("ply", shape_file("uv.ply"))).shapes[0];
  EXPECT_EQ(with_uv.type, "trianglemesh");
  EXPECT_EQ(parameter(with_uv.parameters, "uv").numbers.at(1), 0.75);
  EXPECT_NE(scene.error(shape("ply", shape_file("none.ply"))).find("scene.xml:2:19: "),
            std::string::npos);
}

TEST(MitsubaShape, ColoursOfPlyFilesAreReadWhereATextureWantsThem) {
  MitsubaScene scene;
  scene.folder().write("c.ply",
                       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\nproperty uchar red\n"
                       "property uchar green\nproperty uchar blue\nelement face 1\n"
                       "property list uchar int vertex_index\nend_header\n"
                       "0 0 0 255 128 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n");
  const auto colors = [&](const std::string& texture, const std::string& body,
                          const std::string& version) {
    return parameter(scene
                         .read(shape("ply", shape_file("c.ply") + body +
                                                "<bsdf type=\"diffuse\"><texture type=\"" +
                                                texture + "\" name=\"reflectance\"/></bsdf>"),
                               version)
                         .shapes.at(0)
                         .parameters,
                     "vertexcolors")
        .numbers.at(1);
  };
  // 128 / 255 is 0.2159 in linear light.
  EXPECT_NEAR(colors("vertexcolors", "", "0.6.0"), 0.2159, 1e-4);
  EXPECT_NEAR(colors("vertexcolors", "<boolean name=\"srgb\" value=\"false\"/>", "0.6.0"),
              128 / 255.0, 1e-6);
  EXPECT_NEAR(colors("mesh_attribute", "", "3.0.0"), 128 / 255.0, 1e-6);
  EXPECT_FALSE(has_parameter(scene.read(shape("ply", shape_file("c.ply"))).shapes[0].parameters,
                             "vertexcolors"));
}

TEST(MitsubaShape, HairIsStraightFromPointToPoint) {
  MitsubaScene scene;
  scene.folder().write("hair.txt", "0 0 0\n0 0 3\n\n\n1 0 0\n1 0 3\n1 3 3\n");
  const SceneDescription d =
      scene.read(shape("hair", shape_file("hair.txt") + "<float name=\"radius\" value=\"0.1\"/>"));
  ASSERT_EQ(d.shapes.size(), 2u);
  EXPECT_EQ(number(d.shapes[0].parameters, "width0"), 0.2);
  ASSERT_EQ(parameter(d.shapes[1].parameters, "P").numbers.size(), 21u);
  EXPECT_NEAR((point_at(d.shapes[1], 4) - Vec3d(1, 1, 3)).length(), 0, 1e-6);
  scene.folder().write("bad.txt", "0 0 0\n0 0\n");
  EXPECT_EQ(scene.error(shape("hair", shape_file("bad.txt"))),
            "scene.xml:2:20: line 2 of the file has no point, expected x, y and z");
}

TEST(MitsubaShape, BinaryHairHasInfiniteMarks) {
  std::string bytes = "BINARY_HAIR";
  const auto add = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  add(uint32_t{4});
  for (const float x :
       {0.f, 0.f, 0.f, 0.f, 0.f, 1.f, float(INFINITY), 5.f, 0.f, 0.f, 5.f, 0.f, 1.f})
    add(x);
  MitsubaScene scene;
  scene.folder().write("hair.bin", bytes);
  EXPECT_EQ(scene.read(shape("hair", shape_file("hair.bin"))).shapes.size(), 2u);
  scene.folder().write("cut.bin", bytes.substr(0, bytes.size() - 1));
  EXPECT_NE(scene.error(shape("hair", shape_file("cut.bin"))).find("ends too early"),
            std::string::npos);
}

TEST(MitsubaShape, CurvesHaveLinearRadii) {
  MitsubaScene scene;
  scene.folder().write("c.txt", "0 0 0 1\n0 0 1 2\n0 0 2 3\n0 0 3 4\n");
  const ShapeDescription s =
      scene.read(shape("bsplinecurve", shape_file("c.txt")), "3.0.0").shapes[0];
  EXPECT_EQ(text(s.parameters, "basis"), "bspline");
  EXPECT_EQ(number(s.parameters, "width0"), 2);
  EXPECT_EQ(number(s.parameters, "width1"), 8);
  EXPECT_EQ(scene.warnings(), "");
  scene.folder().write("bulge.txt", "0 0 0 1\n0 0 1 2\n0 0 2 2\n0 0 3 1\n");
  scene.read(shape("bsplinecurve", shape_file("bulge.txt")), "3.0.0");
  EXPECT_NE(scene.warnings().find("radii are linear"), std::string::npos);
}

TEST(MitsubaShape, GroupsAreObjectsWithInstances) {
  MitsubaScene scene;
  const SceneDescription d = scene.read(
      "<shape type=\"shapegroup\" id=\"pair\">" + shape("sphere") + shape("cube") + "</shape>\n" +
      shape("instance",
            "<ref id=\"pair\"/><transform name=\"toWorld\"><translate x=\"3\"/>"
            "</transform>") +
      shape("instance", "<ref id=\"pair\"/>"));
  EXPECT_TRUE(d.shapes.empty());
  ASSERT_EQ(d.objects.at("pair").shapes.size(), 2u);
  ASSERT_EQ(d.instances.size(), 2u);
  EXPECT_EQ(d.instances[0].object, "pair");
  EXPECT_EQ(d.instances[0].transform.start[3][0], 3);
  EXPECT_NE(scene.error(shape("instance")).find("has no shape group"), std::string::npos);
}

TEST(MitsubaShape, DefaultsOfMaterialsAreThoseOfTheVersion) {
  MitsubaScene scene;
  const SceneDescription d =
      scene.read(shape("sphere") + shape("sphere", "<emitter type=\"area\"/>") +
                 shape("sphere", "<medium name=\"interior\" type=\"homogeneous\"/>"));
  EXPECT_EQ(material(d, d.shapes[0].material.name).type, "diffuse");
  EXPECT_EQ(parameter(material(d, d.shapes[1].material.name).parameters, "reflectance").numbers,
            (Numbers{0, 0, 0}));
  EXPECT_EQ(material(d, d.shapes[2].material.name).type, "interface");
}

}  // namespace
}  // namespace nephroid::testing
