// Opens image files with OpenImageIO and says what is in them, see image_input.h.
#include "scene/texture/image_input.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/texture/image_file.h"

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

}  // namespace

uint64_t ImageInputFile::memory() const {
  const uint64_t bytes = type == StoredType::kByte ? 1 : type == StoredType::kFloat ? 4 : 2;
  return uint64_t(spec.width) * uint64_t(spec.height) * channels.size() * bytes;
}

ImageInputFile open_image(const std::string& path, std::optional<ColorEncoding> encoding,
                          const SourceLocation& wanted_by) {
  ImageInputFile file;
  // Alpha is a number of its own here: colours must not come multiplied by it.
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);
  file.input = OIIO::ImageInput::open(path, &wish);
  if (!file.input) image_is_unreadable(path, OIIO::geterror(), wanted_by);
  file.spec = file.input->spec();
  const OIIO::ImageSpec& spec = file.spec;
  if (spec.deep || spec.depth > 1 || spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
    throw SceneError(wanted_by, "image \"" + path + "\" is deep, a volume or empty");
  file.channels = wanted_channels(spec, path, wanted_by);
  file.space = &color_space_of(spec);
  file.encoding =
      image_obeys_encoding(path) ? encoding.value_or(ColorEncoding::srgb()) : ColorEncoding::srgb();
  switch (spec.format.basetype) {
    case OIIO::TypeDesc::UINT8:
      file.type = StoredType::kByte;
      break;
    case OIIO::TypeDesc::UINT16:
      file.type = StoredType::kShort;
      break;
    case OIIO::TypeDesc::HALF:
      file.type = StoredType::kHalf;
      break;
    default:
      file.type = StoredType::kFloat;
  }
  return file;
}

OIIO::TypeDesc type_to_read(StoredType type) {
  switch (type) {
    case StoredType::kByte:
      return OIIO::TypeDesc::UINT8;
    case StoredType::kShort:
      return OIIO::TypeDesc::UINT16;
    case StoredType::kHalf:
      return OIIO::TypeDesc::HALF;
    default:
      return OIIO::TypeDesc::FLOAT;
  }
}

}  // namespace nephroid
