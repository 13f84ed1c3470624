// Spectra in parameters: every way to write them, and errors.
#include <fstream>

#include "unit/texture/texture_fixture.h"

namespace nephroid::testing_texture {
namespace {

Parameter numbers(const std::string& type, std::vector<double> values) {
  Parameter p;
  p.type = type;
  p.name = "L";
  p.numbers = std::move(values);
  return p;
}
Parameter word(const std::string& value) {
  Parameter p;
  p.type = "spectrum";
  p.name = "L";
  p.strings = {value};
  return p;
}
SpectrumPtr make(const Parameter& p, SpectrumKind kind = SpectrumKind::kUnbounded,
                 const std::string& directory = ".") {
  SceneFiles files(directory);
  return spectrum_from_parameter(p, kind, files);
}

TEST(SpectrumParameter, PairsAreInterpolated) {
  const SpectrumPtr s = make(numbers("spectrum", {400, 1, 500, 3, 600, 3}));
  EXPECT_FLOAT_EQ((*s)(450), 2.0f);
  EXPECT_FLOAT_EQ((*s)(550), 3.0f);
  EXPECT_FLOAT_EQ((*s)(650), 0.0f);
}

TEST(SpectrumParameter, NamesFilesAndBlackBodies) {
  EXPECT_EQ((*make(word("glass-BK7")))(550), (*named_spectrum("glass-BK7"))(550));
  EXPECT_EQ((*make(numbers("blackbody", {4500})))(550), (*blackbody_spectrum(4500))(550));
  const ScratchDirectory scratch;
  std::ofstream(scratch.file("s.spd")) << "# lambda value\n400 1\n500 3 # peak\n600 3\n";
  EXPECT_FLOAT_EQ((*make(word("s.spd"), SpectrumKind::kUnbounded, scratch.path().string()))(450),
                  2.0f);
}

TEST(SpectrumParameter, RgbIsReadInTheKindAskedFor) {
  const Parameter p = numbers("rgb", {0.2, 0.5, 0.4});
  const Rgb rgb{.2f, .5f, .4f};
  const RgbColorSpace& space = RgbColorSpace::srgb();
  EXPECT_EQ((*make(p, SpectrumKind::kAlbedo))(550), (*rgb_albedo_spectrum(space, rgb))(550));
  EXPECT_EQ((*make(p, SpectrumKind::kUnbounded))(550), (*rgb_unbounded_spectrum(space, rgb))(550));
  EXPECT_EQ((*make(p, SpectrumKind::kIlluminant))(550),
            (*rgb_illuminant_spectrum(space, rgb))(550));
  Parameter lost = p;
  lost.color_space = "adobe";
  EXPECT_THROW(make(lost), SceneError);
}

TEST(SpectrumParameter, RefusesWhatPbrtRefuses) {
  EXPECT_THROW(make(numbers("rgb", {1, 1}), SpectrumKind::kAlbedo), SceneError);
  EXPECT_THROW(make(numbers("rgb", {1, 1.5, 1}), SpectrumKind::kAlbedo), SceneError);
  EXPECT_THROW(make(numbers("rgb", {1, -0.1, 1})), SceneError);
  EXPECT_NO_THROW(make(numbers("rgb", {1, 1.5, 1})));
  EXPECT_THROW(make(numbers("float", {1})), SceneError);
  EXPECT_THROW(make(numbers("spectrum", {400, 1, 500})), SceneError);
  EXPECT_THROW(make(numbers("spectrum", {500, 1, 400, 1})), SceneError);
  EXPECT_THROW(make(numbers("blackbody", {0})), SceneError);
  EXPECT_THROW(make(word("no-such-spectrum")), IoError);
  const ScratchDirectory scratch;
  std::ofstream(scratch.file("bad.spd")) << "400 one\n";
  EXPECT_THROW(make(word("bad.spd"), SpectrumKind::kUnbounded, scratch.path().string()),
               SceneError);
}

}  // namespace
}  // namespace nephroid::testing_texture
