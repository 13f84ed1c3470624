// Reads whole image files, and decides which are paged instead; see image_file.h.
#include "scene/texture/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>

#include "input/file_bytes.h"
#include "input/spelling.h"
#include "scene/texture/image_input.h"
#include "scene/texture/paged_image.h"

namespace nephroid {

namespace {

/// Reads all pixels as T and keeps the wanted channels.
template <class T>
std::vector<T> read_values(OIIO::ImageInput& input, const std::vector<int>& wanted,
                           OIIO::TypeDesc type, const std::string& path,
                           const SourceLocation& wanted_by) {
  const OIIO::ImageSpec& spec = input.spec();
  const size_t pixels = static_cast<size_t>(spec.width) * spec.height;
  // Uninitialised: a header can claim more than the file has, or more than fits in memory.
  const std::unique_ptr<T[]> all(new (std::nothrow) T[pixels * spec.nchannels]);
  if (!all) throw std::bad_alloc();
  if (!input.read_image(0, 0, 0, spec.nchannels, type, all.get()))
    image_is_unreadable(path, input.geterror(), wanted_by);
  std::vector<T> kept(pixels * wanted.size());
  for (size_t p = 0; p < pixels; ++p)
    for (size_t c = 0; c < wanted.size(); ++c)
      kept[p * wanted.size() + c] = all[p * spec.nchannels + wanted[c]];
  return kept;
}

/// Drops an alpha that is `one` everywhere. Returns the number of channels left.
template <class T>
int drop_opaque_alpha(std::vector<T>& values, size_t channels, T one) {
  if (channels % 2 != 0) return static_cast<int>(channels);
  const size_t colors = channels - 1, pixels = values.size() / channels;
  for (size_t p = 0; p < pixels; ++p)
    if (values[p * channels + colors] != one) return static_cast<int>(channels);
  for (size_t p = 0; p < pixels; ++p)
    std::copy_n(values.begin() + p * channels, colors, values.begin() + p * colors);
  values.resize(pixels * colors);
  return static_cast<int>(colors);
}

}  // namespace

void image_is_unreadable(const std::string& path, std::string reason,
                         const SourceLocation& wanted_by) {
  while (!reason.empty() && reason.back() == '\n') reason.pop_back();
  for (size_t i; (i = reason.find('\n')) != std::string::npos;) reason.replace(i, 1, "; ");
  file_is_unreadable(wanted_by, "cannot read image \"" + path + "\": " + reason);
}

bool image_obeys_encoding(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string()) == ".png";
}

namespace {

ImagePtr read_pixels(const ImageInputFile& file, const std::string& path,
                     const SourceLocation& wanted_by) {
  const std::vector<int>& wanted = file.channels;
  const auto make = [&](int channels, Image::Pixels pixels) {
    return std::make_shared<Image>(file.spec.width, file.spec.height, channels, std::move(pixels),
                                   *file.space);
  };
  const OIIO::TypeDesc type = type_to_read(file.type);
  switch (file.type) {
    case StoredType::kByte: {
      auto v = read_values<uint8_t>(*file.input, wanted, type, path, wanted_by);
      const int n = drop_opaque_alpha<uint8_t>(v, wanted.size(), 255);
      return make(n, Image::Bytes{std::move(v), file.encoding.byte_table()});
    }
    case StoredType::kShort: {
      const auto v = read_values<uint16_t>(*file.input, wanted, type, path, wanted_by);
      Image::Halves h(v.size());
      std::transform(v.begin(), v.end(), h.begin(), [&file](uint16_t s) {
        return Imath::half(file.encoding.decode(s / 65535.0f));
      });
      const int n = drop_opaque_alpha<Imath::half>(h, wanted.size(), Imath::half(1.0f));
      return make(n, std::move(h));
    }
    case StoredType::kHalf: {
      auto v = read_values<Imath::half>(*file.input, wanted, type, path, wanted_by);
      const int n = drop_opaque_alpha<Imath::half>(v, wanted.size(), Imath::half(1.0f));
      return make(n, std::move(v));
    }
    default: {
      auto v = read_values<float>(*file.input, wanted, type, path, wanted_by);
      const int n = drop_opaque_alpha<float>(v, wanted.size(), 1.0f);
      return make(n, std::move(v));
    }
  }
}

/// Reads all pixels of an opened file.
ImagePtr read_whole(const ImageInputFile& file, const std::string& path,
                    const SourceLocation& wanted_by) {
  try {
    return read_pixels(file, path, wanted_by);
  } catch (const std::bad_alloc&) {
    image_is_unreadable(path, "it does not fit into memory", wanted_by);
  }
}

}  // namespace

ImagePtr read_image(const FileSource& source, std::optional<ColorEncoding> encoding,
                    const SourceLocation& wanted_by) {
  return read_whole(open_image(source, encoding, wanted_by), source.path, wanted_by);
}

ImagePtr read_stored_image(const FileSource& source, const SourceLocation& wanted_by) {
  return read_image(source, ColorEncoding::linear(), wanted_by);
}

ImageCache::ImageCache(uint64_t limit) : limit_(limit) {}
ImageCache::~ImageCache() = default;

ImagePtr ImageCache::get(const FileSource& source, std::optional<ColorEncoding> encoding,
                         const SourceLocation& wanted_by) {
  ImagePtr& image = images_[{source.path, encoding}];
  if (!image) image = load(source, encoding, wanted_by);
  return image;
}

namespace {
/// Images without parts are paged up to this size: unpacking more from the front for a few pixels
/// is slow enough to look like a hang.
constexpr uint64_t kSlowFromTheFront = uint64_t{256} << 20;
}  // namespace

ImagePtr ImageCache::load(const FileSource& source, std::optional<ColorEncoding> encoding,
                          const SourceLocation& wanted_by) {
  const std::string& path = source.path;
  ImageInputFile file = open_image(source, encoding, wanted_by);
  // A quarter of the limit is reserved for tiles of images that do not fit. They get no more, since
  // memory is budgeted before the render begins.
  const uint64_t for_whole = limit_ - limit_ / 4;
  ImagePtr image;
  // Nor can a file in memory be paged.
  const bool fits = whole_ + file.memory() <= for_whole;
  const bool can_be_paged =
      !source.bytes &&
      (file.memory() <= std::max(for_whole, kSlowFromTheFront) || file.has_parts());
  if (!fits && !can_be_paged)
    throw SceneError(
        wanted_by,
        fmt::format("image \"{}\" takes {} MB, but textures may take {} MB and its format cannot "
                    "be read in parts, expected a larger -D texture-cache, or an EXR or TIFF file",
                    path, file.memory() >> 20, for_whole >> 20));
  if (!fits) {
    if (!tiles_) tiles_ = TileCache::make();
    image = tiles_->open(file, path, wanted_by);
  }
  if (!image) {
    image = read_whole(file, path, wanted_by);
    whole_ += image->memory();
  }
  // Minimum, because OpenImageIO aborts when threads together hold ten times the limit.
  constexpr uint64_t kMinTileBytes = 1 << 20;
  if (tiles_) tiles_->set_limit(std::max(limit_ / 4, kMinTileBytes));
  return image;
}

uint64_t ImageCache::memory() const {
  return whole_ + (tiles_ ? tiles_->memory() : 0);
}

}  // namespace nephroid
