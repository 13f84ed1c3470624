// Reads image files with OpenImageIO, see image_file.h.
#include "scene/texture/image_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>

#include "input/file_bytes.h"

namespace nephroid {

namespace {

/// Which channels of the file the image keeps: indices of grey, of rgb or of rgba.
std::vector<int> wanted_channels(const OIIO::ImageSpec& spec, const std::string& path,
                                 const SourceLocation& wanted_by) {
  if (spec.nchannels <= 2) return {0};
  const int r = spec.channelindex("R"), g = spec.channelindex("G"), b = spec.channelindex("B");
  if (r < 0 || g < 0 || b < 0)
    throw SceneError(wanted_by, "image \"" + path + "\" has no channels named R, G and B");
  const int a = spec.channelindex("A");
  if (a < 0) return {r, g, b};
  return {r, g, b, a};
}

/// The space whose primaries an EXR file names; sRGB for files that name none or unknown ones.
const RgbColorSpace& color_space_of(const OIIO::ImageSpec& spec) {
  struct Row {
    const char* name;
    std::array<float, 6> primaries;
  };
  static constexpr Row kRows[] = {{"srgb", {.64f, .33f, .3f, .6f, .15f, .06f}},
                                  {"dci-p3", {.68f, .32f, .265f, .69f, .15f, .06f}},
                                  {"rec2020", {.708f, .292f, .17f, .797f, .131f, .046f}},
                                  {"aces2065-1", {.7347f, .2653f, 0.f, 1.f, .0001f, -.077f}}};
  const OIIO::ParamValue* p = spec.find_attribute("chromaticities");
  if (!p || p->type().basetype != OIIO::TypeDesc::FLOAT || p->type().numelements() < 8)
    return RgbColorSpace::srgb();
  const float* written = static_cast<const float*>(p->data());
  for (const Row& row : kRows) {
    const bool same = std::equal(row.primaries.begin(), row.primaries.end(), written,
                                 [](float a, float b) { return std::abs(a - b) < 1e-3f; });
    if (same) return *RgbColorSpace::find(row.name);
  }
  return RgbColorSpace::srgb();
}

/// Reads all pixels as T and keeps the wanted channels.
template <class T>
std::vector<T> read_values(OIIO::ImageInput& input, const std::vector<int>& wanted,
                           OIIO::TypeDesc type, const std::string& path,
                           const SourceLocation& wanted_by) {
  const OIIO::ImageSpec& spec = input.spec();
  const size_t pixels = static_cast<size_t>(spec.width) * spec.height;
  // Not filled with zeros: a header may claim more than the file has, or than there is memory.
  const std::unique_ptr<T[]> all(new (std::nothrow) T[pixels * spec.nchannels]);
  if (!all) image_is_unreadable(path, "it is too large for the memory", wanted_by);
  if (!input.read_image(0, 0, 0, spec.nchannels, type, all.get()))
    image_is_unreadable(path, input.geterror(), wanted_by);
  std::vector<T> kept(pixels * wanted.size());
  for (size_t p = 0; p < pixels; ++p)
    for (size_t c = 0; c < wanted.size(); ++c)
      kept[p * wanted.size() + c] = all[p * spec.nchannels + wanted[c]];
  return kept;
}

/// Drops a fourth channel that is `one` everywhere; returns the number of channels left.
template <class T>
int drop_opaque_alpha(std::vector<T>& values, size_t channels, T one) {
  if (channels != 4) return static_cast<int>(channels);
  for (size_t i = 3; i < values.size(); i += 4)
    if (values[i] != one) return 4;
  for (size_t p = 0; p < values.size() / 4; ++p)
    std::copy_n(values.begin() + p * 4, 3, values.begin() + p * 3);
  values.resize(values.size() / 4 * 3);
  return 3;
}

}  // namespace

void image_is_unreadable(const std::string& path, std::string reason,
                         const SourceLocation& wanted_by) {
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  for (size_t i; (i = reason.find('\n')) != std::string::npos;) reason.replace(i, 1, "; ");
  file_is_unreadable(wanted_by, "cannot read image \"" + path + "\": " + reason);
}

bool image_obeys_encoding(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png";
}

ImagePtr read_image(const std::string& path, std::optional<ColorEncoding> encoding,
                    const SourceLocation& wanted_by) {
  // Alpha is a number of its own here: colours must not come multiplied by it.
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path, &wish);
  if (!input) image_is_unreadable(path, OIIO::geterror(), wanted_by);
  const OIIO::ImageSpec spec = input->spec();
  if (spec.deep || spec.depth > 1 || spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
    throw SceneError(wanted_by, "image \"" + path + "\" is deep, a volume or empty");
  const std::vector<int> wanted = wanted_channels(spec, path, wanted_by);
  const RgbColorSpace& space = color_space_of(spec);
  const ColorEncoding code =
      image_obeys_encoding(path) ? encoding.value_or(ColorEncoding::srgb()) : ColorEncoding::srgb();
  const auto make = [&](int channels, Image::Pixels pixels) {
    return std::make_shared<Image>(spec.width, spec.height, channels, std::move(pixels), space);
  };

  switch (spec.format.basetype) {
    case OIIO::TypeDesc::UINT8: {
      auto v = read_values<uint8_t>(*input, wanted, OIIO::TypeDesc::UINT8, path, wanted_by);
      const int n = drop_opaque_alpha<uint8_t>(v, wanted.size(), 255);
      return make(n, Image::Bytes{std::move(v), code.byte_table()});
    }
    case OIIO::TypeDesc::UINT16: {
      const auto v = read_values<uint16_t>(*input, wanted, OIIO::TypeDesc::UINT16, path, wanted_by);
      Image::Halves h(v.size());
      std::transform(v.begin(), v.end(), h.begin(), [&code](uint16_t s) {
        return Imath::half(code.decode(static_cast<float>(s) / 65535.0f));
      });
      const int n = drop_opaque_alpha<Imath::half>(h, wanted.size(), Imath::half(1.0f));
      return make(n, std::move(h));
    }
    case OIIO::TypeDesc::HALF: {
      auto v = read_values<Imath::half>(*input, wanted, OIIO::TypeDesc::HALF, path, wanted_by);
      const int n = drop_opaque_alpha<Imath::half>(v, wanted.size(), Imath::half(1.0f));
      return make(n, std::move(v));
    }
    default: {
      auto v = read_values<float>(*input, wanted, OIIO::TypeDesc::FLOAT, path, wanted_by);
      const int n = drop_opaque_alpha<float>(v, wanted.size(), 1.0f);
      return make(n, std::move(v));
    }
  }
}

std::string resolve_path(const std::string& directory, const std::string& file) {
  const std::filesystem::path path(file);
  if (path.is_absolute() || directory.empty()) return file;
  return (std::filesystem::path(directory) / path).string();
}

ImagePtr ImageCache::get(const std::string& path, std::optional<ColorEncoding> encoding,
                         const SourceLocation& wanted_by) {
  ImagePtr& image = images_[{path, encoding}];
  if (!image) image = read_image(path, encoding, wanted_by);
  return image;
}

}  // namespace nephroid
