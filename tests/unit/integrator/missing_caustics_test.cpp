// Notes on caustics that are missing, or rendered by another estimator.
#include "integrator/photons/missing_caustics.h"

#include <gtest/gtest.h>

#include "owned_routes.h"
#include "rendering.h"

namespace nephroid {
namespace {

using testing_support::owned_routes, testing_support::scene_from_text;

constexpr const char* kStart = "Camera \"perspective\" WorldBegin LightSource \"point\"\n";

/// The note on a scene's glossy caustics, or empty.
std::string note_of(const std::string& world, bool by_path_tracing = true) {
  const auto scene = scene_from_text(kStart + world);
  EstimatorStatistics s;
  explain_glossy_caustics(owned_routes(*scene, {"all=C.*L:path"}), by_path_tracing, s);
  return s.notes.empty() ? "" : s.notes[0];
}

const std::string kSphere = " Shape \"sphere\"\n";
const std::string kGlass = "Material \"dielectric\" \"float roughness\" 0.02" + kSphere;

TEST(MissingCaustics, GlossyMaterialsAreNamedWithTheirAlpha) {
  EXPECT_EQ(
      note_of(kGlass),
      "no material of the scene has a specular lobe. An alpha above -D "
      "specular-alpha=0.035..0.07 makes it glossy: dielectric1 (test.pbrt:2:1), alpha 0.141. Its "
      "caustics are part of the diffuse light and rendered by path tracing");
  EXPECT_EQ(note_of(kGlass, false).find("path tracing"), std::string::npos);
  const std::string named =
      "MakeNamedMaterial \"vase\" \"string type\" \"conductor\" \"float "
      "roughness\" 0.25 \"bool remaproughness\" false NamedMaterial \"vase\"";
  EXPECT_NE(note_of(named + kSphere).find("vase (test.pbrt:2:1), alpha 0.25."), std::string::npos);
}

TEST(MissingCaustics, TheSmoothestOfManyAreNamed) {
  std::string world;
  for (const char* roughness : {"0.5", "0.3", "0.2", "0.4", "0.1"})
    world += "Material \"conductor\" \"float roughness\" " + std::string(roughness) + kSphere;
  const std::string note = note_of(world);
  EXPECT_NE(note.find("makes it glossy: conductor5"), std::string::npos) << note;
  EXPECT_NE(note.find("alpha 0.548; and 2 more. Their"), std::string::npos) << note;
  EXPECT_EQ(note.find("conductor1"), std::string::npos) << note;
}

TEST(MissingCaustics, NoCausticsWithoutGlossyMaterials) {
  EXPECT_EQ(note_of(kSphere),
            "no material of the scene has a specular or glossy lobe: there are no caustics, and no "
            "photons were needed");
  EXPECT_EQ(
      note_of("Material \"dielectric\" \"float roughness\" 0.02 Material \"diffuse\"" + kSphere),
      note_of(kSphere))
      << "no shape has the glossy one";
  EXPECT_EQ(note_of(kGlass + "Material \"dielectric\"" + kSphere), "") << "there are photons";
}

TEST(MissingCaustics, PhotonsAreOutOfViewOnlyOnceTheyWereLookedFor) {
  const auto scene = scene_from_text(kStart + kSphere);
  const OwnedRoutes owned = owned_routes(*scene, {"all=C.*L:photons"});
  EstimatorStatistics stopped;
  stopped.photon_paths = stopped.photons_stored = 100;
  EstimatorStatistics whole = stopped;
  whole.camera_paths = 15;
  explain_darkness(owned, 0, stopped);
  EXPECT_TRUE(stopped.notes.empty());
  explain_darkness(owned, 0, whole);
  ASSERT_EQ(whole.notes.size(), 1u);
  EXPECT_EQ(whole.notes[0], "100 photons stored, none near a point that the camera sees");
}

TEST(MissingCaustics, PhotonsNeedASurfaceToBeMergedAt) {
  const auto note = [](const std::string& world) {
    const auto scene = scene_from_text(kStart + world);
    EstimatorStatistics s;
    s.photon_paths = 100;
    s.photon_paths_specular = 70;
    explain_missing_caustics(owned_routes(*scene, {"all=C.*L:path"}), s);
    return s.notes.at(0);
  };
  const std::string start =
      "70 of 100 photon paths met a specular surface, none reached a diffuse one behind it";
  EXPECT_EQ(note("Material \"dielectric\"" + kSphere),
            start + ": the scene has no diffuse or glossy surface, where photons are merged");
  EXPECT_EQ(note(kSphere + "Material \"dielectric\"" + kSphere),
            start + " within the maximum path depth (-D max-depth)");
}

}  // namespace
}  // namespace nephroid
