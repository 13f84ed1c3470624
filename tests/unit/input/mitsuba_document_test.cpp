// The XML of Mitsuba scenes: parameters, includes, references, values, and what is wrong with them.
#include "unit/input/mitsuba_scene.h"

namespace nephroid::testing {
namespace {

const std::string kSphere = "<shape type=\"sphere\"/>\n";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(MitsubaDocument, ParametersHaveDefaultsThatTheUserReplaces) {
  const std::string body =
      "<default name=\"r\" value=\"2\"/>\n<default name=\"r\" value=\"3\"/>\n"
      "<shape type=\"sphere\"><float name=\"radius\" value=\"$r\"/></shape>\n";
  MitsubaScene scene;
  EXPECT_EQ(number(scene.read(body).shapes[0].parameters, "radius"), 2);
  scene.options.defines = {{"r", "0.5"}, {"unused", "1"}};
  EXPECT_EQ(number(scene.read(body).shapes[0].parameters, "radius"), 0.5);
  EXPECT_TRUE(has(scene.warnings(), "the scene has no parameter \"$unused\"")) << scene.warnings();
  EXPECT_EQ(scene.read(body).choices.parameters, std::vector<std::string>{"r=0.5"});
}

TEST(MitsubaDocument, ParametersStandAnywhereInAText) {
  MitsubaScene scene;
  scene.folder().write("meshes/a-1.ply",
                       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\nelement face 1\n"
                       "property list uchar int vertex_index\nend_header\n"
                       "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const SceneDescription d = scene.read(
      "<default name=\"dir\" value=\"meshes\"/><default name=\"n\" value=\"1\"/>\n"
      "<shape type=\"ply\"><string name=\"filename\" value=\"$dir/a-$n.ply\"/></shape>\n");
  EXPECT_EQ(d.shapes[0].type, "trianglemesh");
  EXPECT_EQ(scene.error("<shape type=\"$shpae\"/>\n<default name=\"shape\" value=\"x\"/>\n"),
            "scene.xml:2:8: parameter \"$shpae\" has no value, expected a <default> or one by "
            "--define");
}

TEST(MitsubaDocument, IncludesAreReadInPlace) {
  MitsubaScene scene;
  scene.folder().write("parts/ball.xml",
                       "<scene version=\"0.6.0\">\n<default name=\"r\" value=\"7\"/>\n"
                       "<shape type=\"sphere\"><float name=\"radius\" value=\"$r\"/></shape>\n"
                       "</scene>");
  const SceneDescription d =
      scene.read("<default name=\"r\" value=\"4\"/><include filename=\"parts/ball.xml\"/>\n");
  ASSERT_EQ(d.shapes.size(), 1u);
  EXPECT_EQ(number(d.shapes[0].parameters, "radius"), 4);
  EXPECT_TRUE(d.shapes[0].where.file->ends_with("parts/ball.xml"));
  EXPECT_EQ(d.shapes[0].where.line, 3);
}

TEST(MitsubaDocument, IncludesStandAnywhereAndMayBeOneObject) {
  MitsubaScene scene;
  scene.folder().write("glass.xml", "<bsdf version=\"3.0.0\" type=\"dielectric\" id=\"glass\"/>");
  scene.folder().write("size.xml",
                       "<scene version=\"3.0.0\"><float name=\"radius\" value=\"3\"/></scene>");
  const SceneDescription d = scene.read(
      "<shape type=\"sphere\">\n<default name=\"part\" value=\"glass\"/>"
      "<include filename=\"$part.xml\"/><include filename=\"size.xml\"/></shape>\n",
      "3.0.0");
  EXPECT_EQ(d.shapes.at(0).material.name, "glass");
  EXPECT_EQ(number(d.shapes[0].parameters, "radius"), 3);
  scene.folder().write("other.xml", "<collada/>");
  EXPECT_TRUE(has(scene.error("<include filename=\"other.xml\"/>"), "other.xml:1:1: "));
}

TEST(MitsubaDocument, FilesAreFoundInTheFoldersOfPaths) {
  MitsubaScene scene;
  scene.folder().write("spectra/a.spd", "400 0.5\n700 0.5\n");
  scene.folder().write("b.spd", "400 0.25\n700 0.25\n");
  const auto reflectance = [&](const std::string& file) {
    const SceneDescription d = scene.read(
        "<path value=\"spectra\"/>\n<bsdf type=\"diffuse\" id=\"a\"><spectrum "
        "name=\"reflectance\" filename=\"" +
        file + "\"/></bsdf>\n");
    return parameter(d.materials.at(0).parameters, "reflectance").numbers.at(1);
  };
  EXPECT_EQ(reflectance("a.spd"), 0.5);
  EXPECT_EQ(reflectance("b.spd"), 0.25);
  EXPECT_EQ(reflectance("..\\b.spd"), 0.25);
  scene.folder().write("spectra/b.spd", "400 0.75\n700 0.75\n");
  EXPECT_EQ(reflectance("b.spd"), 0.75);
  EXPECT_EQ(scene.warnings(), "");
  EXPECT_TRUE(has(scene.error("<path value=\"/\"/><include filename=\"etc/passwd\"/>"),
                  "lies outside of the scene's folder"));
}

TEST(MitsubaDocument, IncludesOfThemselvesAreErrors) {
  MitsubaScene scene;
  scene.folder().write("a.xml",
                       "<scene version=\"0.6.0\">\n <include filename=\"b.xml\"/></scene>");
  scene.folder().write("b.xml", "<scene version=\"0.6.0\"><include filename=\"a.xml\"/></scene>");
  EXPECT_EQ(scene.error("<include filename=\"a.xml\"/>"), "b.xml:1:24: \"a.xml\" includes itself");
  EXPECT_TRUE(has(scene.error("<include filename=\"none.xml\"/>"),
                  "scene.xml:2:1: \"none.xml\" cannot be included"));
}

TEST(MitsubaDocument, IncludesThatDoubleAreBounded) {
  MitsubaScene scene;
  for (int i = 0; i < 40; ++i) {
    const std::string next = "<include filename=\"" + std::to_string(i + 1) + ".xml\"/>";
    scene.folder().write(std::to_string(i) + ".xml",
                         "<scene version=\"0.6.0\">" + next + next + "</scene>");
  }
  scene.folder().write("40.xml", "<scene version=\"0.6.0\"/>");
  EXPECT_TRUE(has(scene.error("<include filename=\"0.xml\"/>"), "includes more than 256 files"));
}

TEST(MitsubaDocument, ReferencesMayStandBeforeTheirObjects) {
  MitsubaScene scene;
  const SceneDescription d = scene.read(
      "<shape type=\"sphere\"><ref id=\"other\"/></shape>\n"
      "<alias id=\"red\" as=\"other\"/>\n"
      "<bsdf type=\"diffuse\" id=\"red\"/>\n");
  EXPECT_EQ(d.shapes[0].material.name, "red");
  EXPECT_EQ(material(d, "red").type, "diffuse");
}

TEST(MitsubaDocument, ASharedBsdfIsOneMaterial) {
  MitsubaScene scene;
  const SceneDescription d =
      scene.read("<bsdf type=\"dielectric\" id=\"glass\"/>\n" + std::string(3, ' ') +
                 "<shape type=\"sphere\"><ref id=\"glass\"/></shape>"
                 "<shape type=\"cube\"><ref id=\"glass\"/></shape>\n");
  EXPECT_EQ(d.materials.size(), 1u);
  EXPECT_EQ(d.shapes[1].material.name, "glass");
}

TEST(MitsubaDocument, WrongReferencesAreErrors) {
  MitsubaScene scene;
  EXPECT_EQ(scene.error("<bsdf type=\"diffuse\" id=\"green\"/>\n<shape type=\"sphere\">\n"
                        "  <ref id=\"gren\"/></shape>\n"),
            "scene.xml:4:3: there is no object with id \"gren\", expected the id of an object, did "
            "you mean \"green\"?");
  EXPECT_EQ(scene.error("<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>\n"
                        "<bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>\n"),
            "scene.xml:2:1: \"a\" refers to itself");
  EXPECT_EQ(scene.error("<bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"diffuse\" id=\"a\"/>\n"),
            "scene.xml:2:30: id \"a\" is already given at scene.xml:2:1");
  EXPECT_TRUE(has(scene.error("<alias id=\"x\" as=\"y\"/><alias id=\"y\" as=\"x\"/>\n"
                              "<shape type=\"sphere\"><ref id=\"x\"/></shape>\n"),
                  "there is no object with id \"x\""));
}

TEST(MitsubaDocument, LongChainsOfReferencesAreErrors) {
  std::string body = "<bsdf type=\"diffuse\" id=\"b0\"/>\n";
  for (int i = 1; i < 100000; ++i)
    body += "<bsdf type=\"twosided\" id=\"b" + std::to_string(i) + "\"><ref id=\"b" +
            std::to_string(i - 1) + "\"/></bsdf>\n";
  MitsubaScene scene;
  EXPECT_TRUE(has(scene.error(body), "nested more than 128 levels deep"));
}

TEST(MitsubaDocument, MergesThatDoubleAreBounded) {
  std::string body = "<shape type=\"merge\" id=\"m0\"><shape type=\"sphere\"/></shape>\n";
  for (int i = 1; i < 60; ++i) {
    const std::string ref = "<ref id=\"m" + std::to_string(i - 1) + "\"/>";
    body += "<shape type=\"merge\" id=\"m" + std::to_string(i) + "\">" + ref + ref + "</shape>\n";
  }
  MitsubaScene scene;
  EXPECT_TRUE(has(scene.error(body, "3.0.0"), "repeat shapes of more than 2^26 numbers"));
  // A few repetitions are what the file says.
  const std::string three =
      "<shape type=\"merge\" id=\"a\"><shape type=\"sphere\"/></shape>\n"
      "<shape type=\"merge\"><ref id=\"a\"/><ref id=\"a\"/></shape>\n";
  EXPECT_EQ(scene.read(three, "3.0.0").shapes.size(), 3u);
}

TEST(MitsubaDocument, ValuesOfParametersAreBoundedInSum) {
  std::string body = "<default name=\"x\" value=\"" + std::string(1 << 15, 'x') + "\"/>\n";
  for (int i = 0; i < 600; ++i)
    body += "<bsdf type=\"diffuse\" id=\"b" + std::to_string(i) + "$x\"/>\n";
  MitsubaScene scene;
  EXPECT_TRUE(has(scene.error(body), "parameters fill more than 2^24 characters"));
}

TEST(MitsubaDocument, DeepNestingIsAnError) {
  MitsubaScene scene;
  std::string open, close;
  for (int i = 0; i < 100000; ++i) {
    open += "<bsdf type=\"twosided\">";
    close += "</bsdf>";
  }
  EXPECT_TRUE(has(scene.error(open + close), "nested more than 64 levels deep"));
}

TEST(MitsubaDocument, EntitiesAreNotExpanded) {
  std::string bomb = "<!DOCTYPE scene [<!ENTITY e0 \"ha\">";
  for (int i = 1; i < 40; ++i) {
    const std::string previous = "&e" + std::to_string(i - 1) + ";";
    bomb += "<!ENTITY e" + std::to_string(i) + " \"" + previous + previous + "\">";
  }
  MitsubaScene scene;
  const SceneDescription d = scene.read_file(
      bomb + "]>\n<scene version=\"0.6.0\"><bsdf type=\"diffuse\" id=\"&e39;\"/></scene>");
  ASSERT_EQ(d.materials.size(), 1u);
  EXPECT_EQ(d.materials[0].name, "&e39;");
}

TEST(MitsubaDocument, OtherXmlIsAnError) {
  MitsubaScene scene;
  EXPECT_TRUE(has(scene.file_error("<scene version=\"0.6.0\">\n<shape type=\"cube\">\n</scene>"),
                  "scene.xml:3:3: </scene> does not close the element that is open"));
  EXPECT_TRUE(has(scene.file_error("<scene version=\"0.6.0\"></>"),
                  "scene.xml:1:26: </> does not close the element that is open"));
  EXPECT_TRUE(has(scene.file_error("<scene version=\"0.6.0\">\n<shape type=\"cube\"/>\n"),
                  "the file ends in the middle of an element"));
  EXPECT_TRUE(has(scene.file_error("<COLLADA/>"), "scene.xml:1:1: this is a COLLADA scene"));
  EXPECT_TRUE(has(scene.file_error("<a/>"), "scene.xml:1:1: this is an XML file"));
  EXPECT_EQ(scene.file_error(""), "scene.xml: the file is empty, expected XML elements");
  EXPECT_EQ(scene.file_error("<scene/>"),
            "scene.xml:1:1: <scene> has version \"\", expected 0.5, 0.6, 2 or 3");
}

TEST(MitsubaDocument, FilesLieInTheFolderOfTheScene) {
  MitsubaScene scene;
  const std::string body =
      "<shape type=\"obj\">\n<string name=\"filename\" value=\"../other.obj\"/></shape>\n";
  EXPECT_TRUE(has(scene.error(body), "scene.xml:3:1: \"../other.obj\" lies outside"));
  EXPECT_TRUE(has(scene.error("<include filename=\"/etc/passwd\"/>"), "lies outside"));
  EXPECT_TRUE(has(scene.error("<bsdf type=\"diffuse\" id=\"a\"><spectrum name=\"reflectance\" "
                              "filename=\"../a.spd\"/></bsdf>"),
                  "lies outside"));
  scene.options.allow_outside = true;
  EXPECT_FALSE(has(scene.error(body), "lies outside"));
}

TEST(MitsubaDocument, WrongValuesNameTheirElement) {
  MitsubaScene scene;
  const auto sphere = [](const std::string& property) {
    return "<shape type=\"sphere\">\n " + property + "</shape>\n";
  };
  EXPECT_EQ(scene.error(sphere("<float name=\"radius\" value=\"nan\"/>")),
            "scene.xml:3:2: property \"radius\" is \"nan\", expected a finite number");
  EXPECT_EQ(scene.error(sphere("<float name=\"radius\" value=\"1e999\"/>")),
            "scene.xml:3:2: property \"radius\" is \"1e999\", expected a finite number");
  EXPECT_EQ(scene.error(sphere("<string name=\"radius\" value=\"1\"/>")),
            "scene.xml:3:2: property \"radius\" is a <string>, expected <float>");
  EXPECT_EQ(scene.error(sphere("<float name=\"radius\"/>")),
            "scene.xml:3:2: property \"radius\" has no \"value\", expected a <float> with one");
  EXPECT_EQ(scene.error(sphere("<float value=\"1\"/>")),
            "scene.xml:3:2: <float> has no \"name\", expected one");
  EXPECT_EQ(scene.error(sphere("<float name=\"radius\" value=\"1\"/>\n"
                               "<float name=\"radius\" value=\"2\"/>")),
            "scene.xml:4:1: property \"radius\" is already given at scene.xml:3:2");
  EXPECT_EQ(scene.error(sphere("<boolean name=\"flipNormals\" value=\"yes\"/>")),
            "scene.xml:3:2: property \"flip_normals\" is not a boolean, expected true "
            "or false");
  EXPECT_EQ(scene.error(sphere("<point name=\"center\" value=\"1, 2\"/>")),
            "scene.xml:3:2: property \"center\" has 2 numbers, expected three");
  EXPECT_EQ(scene.error(sphere("<float name=\"radius\" value=\"0\"/>")),
            "scene.xml:2:1: \"radius\" is not above 0, expected a length");
}

TEST(MitsubaDocument, UnknownNamesAreWarningsOrErrors) {
  MitsubaScene scene;
  const std::string error = scene.error("<shape type=\"spere\"/>\n");
  EXPECT_TRUE(has(error, "scene.xml:2:1: shape \"spere\" is unknown, expected one of \"obj\""))
      << error;
  EXPECT_TRUE(has(error, "did you mean \"sphere\"?")) << error;
  EXPECT_EQ(scene.error("<shpe type=\"sphere\"/>\n"),
            "scene.xml:2:1: <shpe> in <scene> is unknown, expected a Mitsuba element");
  scene.read(
      "<shape type=\"sphere\">\n<float name=\"radus\" value=\"1\"/>\n"
      "<integer name=\"samplingWeight\" value=\"1\"/></shape>\n");
  EXPECT_EQ(scene.warnings(),
            "scene.xml:3:1: property \"radus\" of shape \"sphere\" is unknown, it is ignored, did "
            "you mean \"radius\"?\n");
  EXPECT_TRUE(scene.diagnostics.warnings()[0].is_unknown_name);
}

TEST(MitsubaDocument, NamesOfMitsuba05AreKnown) {
  MitsubaScene scene;
  const SceneDescription d = scene.read(
      "<camera type=\"perspective\"><float name=\"fov\" value=\"40\"/></camera>\n"
      "<luminaire type=\"constant\"/>\n",
      "0.5.0");
  EXPECT_EQ(d.camera->type, "perspective");
  EXPECT_EQ(d.lights[0].type, "infinite");
}

}  // namespace
}  // namespace nephroid::testing
