// Words are written as they lie in memory.
#include "film/exr_layout.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>

#include "core/content_hash.h"

namespace nephroid {

static_assert(std::endian::native == std::endian::little);

Imf::FrameBuffer frame_of(const PixelBounds& window, const std::vector<std::string>& channels,
                          Imf::PixelType type, const void* memory) {
  Imf::FrameBuffer frame;
  const size_t item = 4 * channels.size(), row = item * window.width();
  // Where the pixel (0, 0) would be.
  const auto origin = reinterpret_cast<intptr_t>(memory) - static_cast<intptr_t>(item) * window.x0 -
                      static_cast<intptr_t>(row) * window.y0;
  for (size_t i = 0; i < channels.size(); ++i)
    frame.insert(channels[i], Imf::Slice(type, reinterpret_cast<char*>(origin) + 4 * i, item, row));
  return frame;
}

PixelBounds window_of_stream(size_t words) {
  // What is not of pixels is a picture of this width.
  constexpr size_t kStreamWidth = 1024;
  const size_t width = std::clamp<size_t>(words, 1, kStreamWidth);
  return {0, 0, static_cast<int>(width),
          static_cast<int>(std::max<size_t>(1, (words + width - 1) / width))};
}

std::vector<std::string> channels_of_words(size_t words) {
  std::vector<std::string> names;
  for (size_t i = 0; i < words; ++i) names.push_back(fmt::format("w{:03}", i));
  return names;
}

std::array<uint32_t, 2> words_of_hash(uint64_t hash) {
  return {static_cast<uint32_t>(hash), static_cast<uint32_t>(hash >> 32)};
}

bool is_of_state(const Imf::Header& header) {
  if (!header.hasType() || header.type() != Imf::SCANLINEIMAGE) return false;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    if (c.channel().type != Imf::UINT) return false;
  return header.compression() == kStateCompression;
}

std::string hash_of_texts(const Imf::Header& header) {
  std::string texts;
  for (auto a = header.begin(); a != header.end(); ++a)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
      texts += std::string(a.name()) + '\0' + text->value() + '\0';
  return fmt::format("{:016x}", hash_of(std::as_bytes(std::span(texts))));
}

}  // namespace nephroid
