// A PNG is encoded in memory and then written as one file, so that every disk error is noticed: an
// encoder's own stream may swallow those of its last buffer.
#include "film/image_io.h"

#include <OpenEXR/ImfThreading.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>
#include <thread>

#include "core/errors.h"
#include "core/srgb.h"
#include "film/atomic_file.h"
#include "film/chromaticities.h"
#include "input/claimed_size.h"
#include "input/exr_header.h"

namespace nephroid {
namespace {

/// The colour space with the file's chromaticities; null if it has none or they are unknown.
const RgbColorSpace* color_space_of(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* found = spec.find_attribute("chromaticities");
  if (found == nullptr || found->type().basetype != OIIO::TypeDesc::FLOAT ||
      found->type().basevalues() * found->nvalues() != 8)
    return nullptr;
  return color_space_with(std::span(static_cast<const float*>(found->data()), 8));
}

/// The picture encoded by the plugin for `format`; `path` is its name in messages.
std::vector<unsigned char> encoded(const std::string& path, const char* format,
                                   const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                   const void* pixels) {
  OIIO::Filesystem::IOVecOutput buffer;
  const std::string inner_name = std::string("picture.") + format;
  const auto out = OIIO::ImageOutput::create(inner_name, &buffer);
  if (!out) throw IoError(path + ": cannot write: " + OIIO::geterror());
  const bool written = out->open(inner_name, spec) && out->write_image(type, pixels);
  // Closing writes the rest; the first error is the one to report.
  const std::string reason = written ? std::string() : out->geterror();
  const bool closed = out->close();
  if (!written || !closed)
    throw IoError(path + ": cannot encode: " + (reason.empty() ? out->geterror() : reason));
  return std::move(buffer.buffer());
}

OIIO::ImageSpec png_spec(int width, int height) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // A low level of 1 to 9: previews are written often, and noise does not compress.
  spec.attribute("png:compressionLevel", 3);
  return spec;
}

std::unique_ptr<OIIO::ImageInput> open_picture(const std::string& path) {
  if (const std::string fault = fault_of_exr_header(path); !fault.empty())
    throw IoError(path + ": cannot read: " + fault);
  if (!std::filesystem::exists(path)) throw IoError(path + ": cannot read: there is no such file");
  OIIO::ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);  // sRGB code values must not be multiplied
  auto in = OIIO::ImageInput::open(path, &wish);
  if (!in) {
    const std::string reason = OIIO::geterror();
    const bool is_unknown = reason.empty() || reason.find("format reader") != std::string::npos;
    throw IoError(path + ": cannot read: " +
                  (is_unknown
                       ? "this is no picture in a format that the program knows, expected EXR, "
                         "PNG, JPEG, WebP, HDR, PFM, TGA, TIFF or BMP"
                       : reason));
  }
  return in;
}

/// Colours stored as integers, as in a PNG, are sRGB code values; an alpha is not.
void decode_integers(const OIIO::ImageSpec& spec, std::vector<float>& pixels) {
  if (spec.format.is_floating_point()) return;
  for (size_t i = 0; i < pixels.size(); ++i)
    if (static_cast<int>(i % spec.nchannels) != spec.alpha_channel)
      pixels[i] = decode_srgb(pixels[i]);
}

PictureHead head_of(const OIIO::ImageSpec& spec) {
  PictureHead head;
  head.full_width = spec.full_width;
  head.full_height = spec.full_height;
  head.window = {spec.x, spec.y, spec.x + spec.width, spec.y + spec.height};
  head.channels = spec.channelnames;
  head.color_space = color_space_of(spec);
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING)
      head.metadata.emplace_back(attribute.name().string(), attribute.get_string());
  return head;
}

}  // namespace

std::string value_of(const Metadata& metadata, const std::string& key) {
  for (const auto& [k, value] : metadata)
    if (k == key) return value;
  return {};
}

int Picture::find_channel(const std::string& name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

void write_png(const std::string& path, int width, int height, const std::vector<uint8_t>& rgb) {
  const std::vector<unsigned char> bytes =
      encoded(path, "png", png_spec(width, height), OIIO::TypeDesc::UINT8, rgb.data());
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

std::vector<uint8_t> encode_png(int width, int height, const std::vector<uint8_t>& rgb) {
  return encoded("a PNG", "png", png_spec(width, height), OIIO::TypeDesc::UINT8, rgb.data());
}

PictureHead read_picture_head(const std::string& path) {
  return head_of(open_picture(path)->spec());
}

Picture read_picture(const std::string& path) {
  const auto in = open_picture(path);
  const OIIO::ImageSpec& spec = in->spec();
  Picture picture{head_of(spec), {}};
  if (!is_possible_size(spec.image_bytes(true), path))
    throw IoError(path + ": cannot read: its header claims more pixels than the file can hold");
  picture.pixels.resize(spec.image_pixels() * spec.nchannels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.pixels.data()))
    throw IoError(path + ": cannot read: " + in->geterror());
  decode_integers(spec, picture.pixels);
  return picture;
}

Rgb converted(Rgb color, const RgbColorSpace* from, const RgbColorSpace* to) {
  const RgbColorSpace& source = from != nullptr ? *from : RgbColorSpace::srgb();
  const RgbColorSpace& target = to != nullptr ? *to : RgbColorSpace::srgb();
  return source.name() == target.name() ? color : target.from_xyz(source.to_xyz(color));
}

uint8_t encode_srgb8(float linear) {
  if (!(linear > 0.0f)) return 0;
  if (linear >= 1.0f) return 255;
  const float encoded =
      linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
  return static_cast<uint8_t>(encoded * 255.0f + 0.5f);
}

void limit_image_threads(int threads) {
  if (threads <= 0) threads = std::thread::hardware_concurrency();
  threads = std::clamp(threads, 1, kMaxImageThreads);
  Imf::setGlobalThreadCount(threads);
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads);
}

}  // namespace nephroid
