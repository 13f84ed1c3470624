// What importers add to image textures: files in memory, wrap modes per axis, channels, placement,
// and the attributes of vertices.
#include <fstream>
#include <iterator>

#include "scene/texture/image_file.h"
#include "unit/texture/texture_fixture.h"

namespace nephroid::testing_texture {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Image, MirrorsPerAxis) {
  const Image image(2, 2, 1, Image::Floats{0, 1, 2, 4}, RgbColorSpace::srgb());
  const WrapModes mirror(WrapMode::kMirror);
  // Pixels along u: 0 1 | 1 0 | 0 1.
  EXPECT_EQ(image.nearest_float({1.25f, 0.25f}, mirror), 1.0f);
  EXPECT_EQ(image.nearest_float({1.75f, 0.25f}, mirror), 0.0f);
  EXPECT_EQ(image.nearest_float({2.25f, 0.25f}, mirror), 0.0f);
  EXPECT_EQ(image.nearest_float({-0.75f, 0.25f}, mirror), 1.0f);
  EXPECT_FLOAT_EQ(image.bilinear_float({1.0f, 0.25f}, mirror), 1.0f);
  EXPECT_FLOAT_EQ(image.bilinear_float({-7.75f, 0.25f}, mirror), 0.0f);
  const WrapModes mixed(WrapMode::kClamp, WrapMode::kRepeat);
  EXPECT_EQ(image.nearest_float({1.75f, 1.25f}, mixed), 1.0f);
  EXPECT_EQ(image.nearest_float({-3.0f, -0.25f}, mixed), 2.0f);
}

TEST(Image, ChannelsThatAreNotStored) {
  const Image grey(1, 1, 1, Image::Floats{0.25f}, RgbColorSpace::srgb());
  const Image color(1, 1, 3, Image::Floats{0.1f, 0.2f, 0.3f}, RgbColorSpace::srgb());
  const Image with_alpha(1, 1, 4, Image::Floats{0.1f, 0.2f, 0.3f, 0.4f}, RgbColorSpace::srgb());
  const Vec2f st(0.5f, 0.5f);
  for (const int channel : {0, 1, 2})
    EXPECT_EQ(grey.bilinear_channel(st, WrapMode::kClamp, channel), 0.25f);
  EXPECT_EQ(grey.bilinear_channel(st, WrapMode::kClamp, 3), 1.0f);
  EXPECT_EQ(color.bilinear_channel(st, WrapMode::kClamp, 1), 0.2f);
  EXPECT_EQ(color.nearest_channel(st, WrapMode::kClamp, 3), 1.0f);
  EXPECT_EQ(with_alpha.nearest_channel(st, WrapMode::kClamp, 3), 0.4f);
  EXPECT_EQ(color.bilinear_channel({5, 5}, WrapMode::kBlack, 3), 0.0f);
}

TEST(Image, GreyWithAlpha) {
  const Image image(2, 1, 2, Image::Floats{0.25f, 0.75f, 0.5f, 0.5f}, RgbColorSpace::srgb());
  const Vec2f first(0.25f, 0.5f), middle(0.5f, 0.5f);
  for (const int channel : {0, 1, 2})
    EXPECT_EQ(image.nearest_channel(first, WrapMode::kClamp, channel), 0.25f);
  EXPECT_EQ(image.nearest_channel(first, WrapMode::kClamp, 3), 0.75f);
  EXPECT_FLOAT_EQ(image.bilinear_channel(middle, WrapMode::kClamp, 3), 0.625f);
  EXPECT_FLOAT_EQ(image.bilinear_channel(middle, WrapMode::kClamp, 1), 0.375f);
  EXPECT_FLOAT_EQ(image.bilinear(middle, WrapMode::kClamp).g, 0.375f);
  EXPECT_FLOAT_EQ(image.bilinear_float(middle, WrapMode::kClamp), 0.375f);
}

class ImageLookup : public ::testing::Test {
 protected:
  /// The bytes of a 2 x 1 picture: red then a quarter of green and blue.
  std::string picture(const std::string& suffix) const {
    const std::string path = scratch.file("picture" + suffix);
    write_image<uint8_t>(path, 2, 1, 3, OIIO::TypeDesc::UINT8, {255, 0, 0, 0, 64, 64});
    return bytes_of(path);
  }
  ScratchDirectory scratch;
};

TEST_F(ImageLookup, FilesInMemoryAreReadLikeFiles) {
  for (const char* suffix : {".png", ".jpg", ".webp"}) {
    SCOPED_TRACE(suffix);
    const std::string bytes = picture(suffix);
    const ImagePtr memory = read_image(
        FileSource("in memory", std::make_shared<const std::string>(bytes)), std::nullopt, {});
    const ImagePtr disk = read_image(scratch.file(std::string("picture") + suffix), {}, {});
    ASSERT_EQ(memory->width(), 2);
    ASSERT_EQ(memory->channels(), disk->channels());
    for (int x = 0; x < 2; ++x)
      for (int c = 0; c < memory->channels(); ++c)
        EXPECT_EQ(memory->value(x, 0, c), disk->value(x, 0, c));
  }
}

TEST_F(ImageLookup, FilesInMemoryCanBePfm) {
  const float values[6] = {1, 2, 3, 4, 5, 6};
  std::string bytes = "PF\n2 1\n-1.0\n";
  bytes.append(reinterpret_cast<const char*>(values), sizeof values);
  const ImagePtr image = read_image(
      FileSource("in memory", std::make_shared<const std::string>(bytes)), std::nullopt, {});
  EXPECT_EQ(image->value(1, 0, 2), 6.0f);
}

TEST_F(ImageLookup, DamagedFilesInMemoryAreErrors) {
  const std::string bytes = picture(".png");
  for (const std::string& bad : {std::string(), std::string("garbage"), bytes.substr(0, 40)})
    EXPECT_THROW(
        read_image(FileSource("in memory", std::make_shared<const std::string>(bad)), {}, {}),
        Error);
}

TEST_F(ImageLookup, EncodingCanBeForced) {
  // Without edges, which JPEG smears.
  write_image<uint8_t>(scratch.file("picture.jpg"), 2, 1, 3, OIIO::TypeDesc::UINT8,
                       {64, 64, 64, 64, 64, 64});
  const std::string text =
      "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"picture.jpg\" "
      "\"string channel\" \"g\" \"string encoding\" \"linear\" \"string filter\" \"point\"";
  const std::string folder = scratch.path().string();
  const Textures ignored(text, folder), forced(text + " \"bool forceencoding\" true", folder);
  EXPECT_NEAR(ignored.value("t", 0.75f, 0.5f), srgb_to_linear(64 / 255.0), 0.03);
  EXPECT_NEAR(forced.value("t", 0.75f, 0.5f), 64 / 255.0, 0.03);
  EXPECT_TRUE(forced.warnings().empty());
}

TEST_F(ImageLookup, ChannelScaleCutoffAndPlacement) {
  picture(".png");
  const Textures t(
      "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"picture.png\" "
      "\"string channel\" \"r\" \"float scale\" 0.5 \"string filter\" \"point\" "
      "\"float uvtransform\" [1 0 0.5 0 1 0]\n"
      "Texture \"c\" \"float\" \"imagemap\" \"string filename\" \"picture.png\" "
      "\"string channel\" \"r\" \"float cutoff\" 0.5 \"string filter\" \"point\" "
      "\"string uwrap\" \"clamp\"",
      scratch.path().string());
  EXPECT_EQ(t.value("t", 0.25f, 0.5f), 0.0f);
  EXPECT_EQ(t.value("t", 0.75f, 0.5f), 0.5f);
  EXPECT_EQ(t.value("c", 0.25f, 0.5f), 1.0f);
  EXPECT_EQ(t.value("c", 0.75f, 0.5f), 0.0f);
  EXPECT_EQ(t.value("c", 1.25f, 0.5f), 0.0f);
}

/// A context in the middle of an edge of a triangle with colours and second coordinates.
struct TriangleContext {
  MeshData mesh;
  TextureContext context;
  TriangleContext() {
    mesh.triangles = {0, 1, 2};
    mesh.second_uvs = {{0, 0}, {1, 0}, {0, 1}};
    mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 0.5f}, {0, 0, 1, 0}};
    context.mesh = &mesh;
    context.barycentric = {0.5f, 0.5f};
    context.uv = {0.25f, 0.5f};
  }
};

TEST_F(ImageLookup, SecondCoordinatesAndColorsOfVertices) {
  const TriangleContext triangle;
  const TextureContext& c = triangle.context;
  EXPECT_EQ(c.second_uv(), Vec2f(0.5f, 0.5f));
  EXPECT_EQ(c.vertex_channel(0), 0.0f);
  EXPECT_EQ(c.vertex_channel(1), 0.5f);
  EXPECT_EQ(c.vertex_channel(3), 0.25f);
  EXPECT_EQ(TextureContext().vertex_channel(1), 1.0f);
  picture(".png");
  const Textures t(
      "Texture \"set\" \"float\" \"imagemap\" \"string filename\" \"picture.png\" "
      "\"string channel\" \"r\" \"integer uvset\" 1 \"string filter\" \"point\"\n"
      "Texture \"alpha\" \"float\" \"vertexcolor\" \"string channel\" \"a\" \"float scale\" 2\n"
      "Texture \"color\" \"spectrum\" \"vertexcolor\" \"rgb factor\" [1 1 0]",
      scratch.path().string());
  // The second coordinates lie in the right pixel, the first ones in the left one.
  EXPECT_EQ(t.number("set")->eval(c), 0.0f);
  EXPECT_EQ(t.number("alpha")->eval(c), 0.5f);
  const auto lambda = SampledWavelengths::sample_visible(0.3f);
  const SampledSpectrum expected = RgbColorSpace::srgb().polynomial({0, 0.5f, 0}).sample(lambda);
  EXPECT_EQ(t.spectrum("color")->eval(c, lambda).average(), expected.average());
}

TEST_F(ImageLookup, WrongParametersAreErrors) {
  picture(".png");
  const std::string text =
      "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"picture.png\" ";
  const std::string folder = scratch.path().string();
  EXPECT_NE(error_of(text + "\"string channel\" \"x\"", folder).find("unknown channel \"x\""),
            std::string::npos);
  EXPECT_NE(error_of(text + "\"string uwrap\" \"octahedralsphere\"", folder).find("wrap mode"),
            std::string::npos);
  EXPECT_NE(error_of(text + "\"integer uvset\" 2", folder).find("expected 0 or 1"),
            std::string::npos);
  EXPECT_NE(error_of(text + "\"float uvtransform\" [1 2]", folder).find("expected 6"),
            std::string::npos);
}

}  // namespace
}  // namespace nephroid::testing_texture
