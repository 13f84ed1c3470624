// Tiles come from OpenImageIO's ImageCache, which splits untiled files into tiles; see
// paged_image.h.
#include "scene/texture/paged_image.h"

#include <OpenImageIO/imagecache.h>

#include <algorithm>
#include <array>

#include "scene/texture/image_file.h"
#include "scene/texture/image_input.h"

namespace nephroid {

struct TileCache::Impl {
  OIIO::ImageCache* cache = nullptr;
};

namespace {

constexpr int kTileSide = 64;
/// Maximum channels of a pixel and pixels of a block in one fetch.
constexpr int kMaxChannels = 4, kMaxPixels = 4;

/// The range of a file's channels from the first wanted one to the last.
struct ChannelRun {
  int begin, end;
  int length() const { return end - begin; }
};

ChannelRun run_of(const std::vector<int>& channels) {
  const auto [low, high] = std::minmax_element(channels.begin(), channels.end());
  return {*low, *high + 1};
}

/// Decodes one stored value, exactly like read_image.
class Decoder {
 public:
  Decoder(StoredType type, const ColorEncoding& encoding) : encoding_(encoding) {
    if (type == StoredType::kByte) table_ = encoding.byte_table();
  }
  float operator()(uint8_t v) const { return table_[v]; }
  float operator()(uint16_t v) const {
    return static_cast<float>(Imath::half(encoding_.decode(v / 65535.0f)));
  }
  float operator()(Imath::half v) const { return v; }
  float operator()(float v) const { return v; }

 private:
  ColorEncoding encoding_;
  std::array<float, 256> table_{};
};

/// Calls f with a value of the C++ type for `type`.
template <class F>
auto with_type(StoredType type, F&& f) {
  switch (type) {
    case StoredType::kByte:
      return f(uint8_t{});
    case StoredType::kShort:
      return f(uint16_t{});
    case StoredType::kHalf:
      return f(Imath::half{});
    default:
      return f(float{});
  }
}

/// True if a stored alpha counts as 1. Bytes are compared undecoded, as in images read whole.
bool is_one(uint8_t v, const Decoder&) {
  return v == 255;
}
template <class T>
bool is_one(T v, const Decoder& decode) {
  return decode(v) == 1.0f;
}

/// True if a channel is 1 everywhere. Reads the file in strips.
template <class T>
bool is_opaque(const ImageInputFile& file, int channel, const Decoder& decode,
               const std::string& path, const SourceLocation& wanted_by) {
  const OIIO::ImageSpec& spec = file.spec;
  const OIIO::TypeDesc type = type_to_read(file.type);
  const bool tiled = spec.tile_width > 0;
  const int rows = tiled ? spec.tile_height : kTileSide;
  std::vector<T> strip(static_cast<size_t>(spec.width) * rows);
  for (int y = 0; y < spec.height; y += rows) {
    const int begin = spec.y + y, end = spec.y + std::min(y + rows, spec.height);
    const bool good =
        tiled ? file.input->read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z,
                                       spec.z + 1, channel, channel + 1, type, strip.data())
              : file.input->read_scanlines(0, 0, begin, end, spec.z, channel, channel + 1, type,
                                           strip.data());
    if (!good) image_is_unreadable(path, file.input->geterror(), wanted_by);
    const auto count = static_cast<std::ptrdiff_t>(spec.width) * (end - begin);
    if (!std::all_of(strip.begin(), strip.begin() + count, [&](T v) { return is_one(v, decode); }))
      return false;
  }
  return true;
}

class PagedPixels final : public PixelSource {
 public:
  PagedPixels(std::shared_ptr<TileCache> owner, OIIO::ImageCache* cache,
              OIIO::ImageCache::ImageHandle* handle, const ImageInputFile& file,
              const std::string& path, const SourceLocation& wanted_by)
      : owner_(std::move(owner)),
        cache_(cache),
        handle_(handle),
        x_(file.spec.x),
        y_(file.spec.y),
        z_(file.spec.z),
        channels_(file.channels),
        run_(run_of(file.channels)),
        type_(file.type),
        decode_(file.type, file.encoding),
        path_(path),
        wanted_by_(wanted_by) {}

  void fetch(int x, int y, int width, int height, float* values) const override {
    with_type(type_, [&](auto example) {
      using T = decltype(example);
      std::array<T, kMaxPixels * kMaxChannels> stored;
      if (!cache_->get_pixels(handle_, nullptr, 0, 0, x_ + x, x_ + x + width, y_ + y,
                              y_ + y + height, z_, z_ + 1, run_.begin, run_.end,
                              type_to_read(type_), stored.data(), OIIO::AutoStride,
                              OIIO::AutoStride, OIIO::AutoStride, run_.begin, run_.end))
        image_is_unreadable(path_, cache_->geterror(), wanted_by_);
      for (int pixel = 0; pixel < width * height; ++pixel)
        for (const int channel : channels_)
          *values++ = decode_(stored[pixel * run_.length() + channel - run_.begin]);
    });
  }

 private:
  std::shared_ptr<TileCache> owner_;
  OIIO::ImageCache* cache_;
  OIIO::ImageCache::ImageHandle* handle_;
  int x_, y_, z_;  ///< coordinates of the first pixel in the file's numbering
  std::vector<int> channels_;
  ChannelRun run_;
  StoredType type_;
  Decoder decode_;
  std::string path_;
  SourceLocation wanted_by_;
};

}  // namespace

TileCache::TileCache() : impl_(std::make_unique<Impl>()) {
  impl_->cache = OIIO::ImageCache::create(false);
  impl_->cache->attribute("autotile", kTileSide);
  impl_->cache->attribute("automip", 0);
  impl_->cache->attribute("unassociatedalpha", 1);
}

TileCache::~TileCache() {
  OIIO::ImageCache::destroy(impl_->cache, true);
}

std::shared_ptr<TileCache> TileCache::make() {
  return std::shared_ptr<TileCache>(new TileCache());
}

void TileCache::set_limit(uint64_t bytes) {
  impl_->cache->attribute("max_memory_MB", static_cast<float>(double(bytes) / (1 << 20)));
}

uint64_t TileCache::memory() const {
  int64_t bytes = 0;
  impl_->cache->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
  return bytes;
}

std::shared_ptr<const Image> TileCache::open(ImageInputFile& file, const std::string& path,
                                             const SourceLocation& wanted_by) {
  if (run_of(file.channels).length() > kMaxChannels) return nullptr;
  if (file.channels.size() % 2 == 0) {
    const Decoder decode(file.type, file.encoding);
    const bool opaque = with_type(file.type, [&](auto example) {
      return is_opaque<decltype(example)>(file, file.channels.back(), decode, path, wanted_by);
    });
    if (opaque) file.channels.pop_back();
  }
  file.input.reset();
  OIIO::ImageCache* cache = impl_->cache;
  cache->add_file(OIIO::ustring(path), file.create);
  OIIO::ImageCache::ImageHandle* handle = cache->get_image_handle(OIIO::ustring(path));
  if (!handle || !cache->good(handle)) image_is_unreadable(path, cache->geterror(), wanted_by);
  auto pixels =
      std::make_shared<PagedPixels>(shared_from_this(), cache, handle, file, path, wanted_by);
  // Detects truncated files now, not in the middle of a render.
  std::array<float, kMaxChannels> corner;
  pixels->fetch(0, 0, 1, 1, corner.data());
  pixels->fetch(file.spec.width - 1, file.spec.height - 1, 1, 1, corner.data());
  return std::make_shared<Image>(file.spec.width, file.spec.height,
                                 static_cast<int>(file.channels.size()), std::move(pixels),
                                 *file.space);
}

}  // namespace nephroid
