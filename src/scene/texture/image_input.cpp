// Opens image files with OpenImageIO and describes their content; see image_input.h.
#include "scene/texture/image_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

#include "core/counted.h"
#include "input/claimed_size.h"
#include "input/exr_header.h"
#include "input/file_bytes.h"
#include "scene/texture/image_file.h"

namespace nephroid {

namespace {

using Creator = OIIO::ImageInput::Creator;

struct Format {
  std::vector<std::string_view> beginnings;  ///< any of these bytes starts the file
  std::string_view suffix;                   ///< file name suffix, if the content does not tell
  Creator create;
  bool from_memory = false;  ///< files in memory may have this format, too
};

/// Only these readers of OpenImageIO's many (films among them): fewer can be attacked by a hostile
/// file.
std::span<const Format> formats() {
  using namespace std::string_view_literals;
  static const Format kFormats[] = {
      {{"\x76\x2f\x31\x01"sv}, {}, [] { return OIIO::ImageInput::create("openexr").release(); }},
      {{"\x89PNG"sv}, {}, [] { return OIIO::ImageInput::create("png").release(); }, true},
      {{"\xff\xd8\xff"sv}, {}, [] { return OIIO::ImageInput::create("jpeg").release(); }, true},
      {{"RIFF"sv}, {}, [] { return OIIO::ImageInput::create("webp").release(); }, true},
      {{"#?"sv}, {}, [] { return OIIO::ImageInput::create("hdr").release(); }},
      {{"PF"sv, "Pf"sv, "P1"sv, "P2"sv, "P3"sv, "P4"sv, "P5"sv, "P6"sv},
       {},
       [] { return OIIO::ImageInput::create("pnm").release(); },
       true},
      {{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv},
       {},
       [] { return OIIO::ImageInput::create("tiff").release(); }},
      {{"BM"sv}, {}, [] { return OIIO::ImageInput::create("bmp").release(); }},
      {{}, ".tga", [] { return OIIO::ImageInput::create("targa").release(); }},
  };
  return kFormats;
}

/// The first bytes of a file. Throws like open_image if it cannot be read.
std::string first_bytes(const FileSource& source, const SourceLocation& wanted_by) {
  if (source.bytes) return source.bytes->substr(0, 8);
  const std::string& path = source.path;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    image_is_unreadable(path, "it is no file", wanted_by);
  std::ifstream file(path, std::ios::binary);
  if (!file) image_is_unreadable(path, std::strerror(errno), wanted_by);
  std::array<char, 8> bytes{};
  file.read(bytes.data(), bytes.size());
  return {bytes.data(), static_cast<size_t>(file.gcount())};
}

/// Throws like open_image if the file cannot be read or has no known format.
Creator reader_of(const FileSource& source, const SourceLocation& wanted_by) {
  const std::string begin = first_bytes(source, wanted_by);
  for (const Format& format : formats()) {
    const bool is_it =
        std::ranges::any_of(format.beginnings, [&](auto b) { return begin.starts_with(b); }) ||
        (!format.suffix.empty() && has_suffix(source.path, std::string(format.suffix)));
    if (is_it && (!source.bytes || format.from_memory)) return format.create;
  }
  image_is_unreadable(source.path,
                      source.bytes
                          ? "it is none of the formats PNG, JPEG, WebP and PFM"
                          : "it is none of the formats EXR, PNG, JPEG, WebP, HDR, PFM, TGA, TIFF "
                            "and BMP",
                      wanted_by);
}

/// False if `claimed` bytes of pixels cannot be in the file.
bool is_possible(uint64_t claimed, const FileSource& source) {
  return source.bytes ? is_possible_size(claimed, source.bytes->size())
                      : is_possible_size(claimed, source.path);
}

/// Indices of the file's channels that the image keeps: grey, rgb, and alpha after them.
std::vector<int> wanted_channels(const OIIO::ImageSpec& spec, const std::string& path,
                                 const SourceLocation& wanted_by) {
  const int a = spec.channelindex("A");
  if (spec.nchannels == 2 && a >= 0) return {1 - a, a};
  if (spec.nchannels <= 2) return {0};
  const int r = spec.channelindex("R"), g = spec.channelindex("G"), b = spec.channelindex("B");
  if (r < 0 || g < 0 || b < 0)
    throw SceneError(
        wanted_by,
        "image \"" + path + "\" has no channels named R, G and B, expected these or a grey image");
  if (a < 0) return {r, g, b};
  return {r, g, b, a};
}

/// The colour space whose primaries an EXR file names; sRGB if it names none or unknown ones.
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

bool ImageInputFile::has_parts() const {
  const std::string_view format = input->format_name();
  return spec.tile_width > 0 || format == "openexr" || format == "tiff";
}

ImageInputFile open_image(const FileSource& source, std::optional<ColorEncoding> encoding,
                          const SourceLocation& wanted_by) {
  const std::string& path = source.path;
  ImageInputFile file;
  file.source = source;
  // Alpha is separate data here, so colours must not be premultiplied.
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);
  file.create = reader_of(source, wanted_by);
  if (const std::string fault = source.bytes ? "" : fault_of_exr_header(path); !fault.empty())
    image_is_unreadable(path, fault, wanted_by);
  file.input.reset(file.create());
  if (source.bytes && file.input) {
    file.memory_reader =
        std::make_unique<OIIO::Filesystem::IOMemReader>(source.bytes->data(), source.bytes->size());
    if (!file.input->set_ioproxy(file.memory_reader.get()))
      image_is_unreadable(path, "its format cannot be read from memory", wanted_by);
  }
  if (!file.input || !file.input->open(path, file.spec, wish))
    image_is_unreadable(path, file.input ? file.input->geterror() : OIIO::geterror(), wanted_by);
  const OIIO::ImageSpec& spec = file.spec;
  if (spec.deep || spec.depth > 1 || spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
    throw SceneError(wanted_by,
                     "image \"" + path + "\" is deep, a volume or empty, expected a flat image");
  if (!is_possible(spec.image_bytes(true), source))
    throw SceneError(wanted_by,
                     fmt::format("image \"{}\" is damaged: its header claims {} x {} pixels of ",
                                 path, spec.width, spec.height) +
                         counted(spec.nchannels, "channel") + ", more than the file can hold");
  file.channels = wanted_channels(spec, path, wanted_by);
  file.space = &color_space_of(spec);
  file.encoding = encoding.value_or(ColorEncoding::srgb());
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
