// A file is written through AtomicFile, a few rows at a time: all layers in memory would take a
// quarter of the film's size.
#include "film/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "core/errors.h"
#include "core/parallel.h"
#include "film/atomic_file.h"
#include "film/chromaticities.h"

namespace nephroid {

namespace {

/// The encoder's output. The encoder swallows exceptions while it writes its offset tables, so the
/// first error is kept.
class AtomicOutput : public Imf::OStream {
 public:
  AtomicOutput(const std::string& path, AtomicFile& file) : OStream(path.c_str()), file_(file) {}
  void write(const char* data, int size) override {
    try {
      file_.write(position_, std::as_bytes(std::span(data, size)));
    } catch (const IoError& error) {
      if (!error_) error_ = error;
      throw;
    }
    position_ += size;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  void throw_if_failed() const {
    if (error_) throw *error_;
  }

 private:
  AtomicFile& file_;
  uint64_t position_ = 0;
  std::optional<IoError> error_;
};

/// Rows of a ZIP block, and number of blocks in memory.
constexpr int kRowsOfBlock = 16, kExrBlocksAtOnce = 4;

uint64_t bytes_of_block(int width, size_t channels) {
  return sizeof(float) * kRowsOfBlock * static_cast<uint64_t>(width) * channels;
}

int rows_at_once(int width, size_t channels) {
  const bool fit = kExrBlocksAtOnce * bytes_of_block(width, channels) <= kMaxEncoderBytes / 3;
  return fit ? kExrBlocksAtOnce * kRowsOfBlock : kRowsOfBlock;
}

/// Threads of the library; 0: the calling thread. For each thread it keeps two blocks, packed,
/// unpacked and sorted.
int encoder_threads(int width, size_t channels) {
  const uint64_t of_thread = 2 * 3 * bytes_of_block(width, channels);
  const auto fit = static_cast<int>(std::min<uint64_t>(
      kExrBlocksAtOnce, kMaxEncoderBytes / 3 / std::max<uint64_t>(1, of_thread)));
  return std::min(fit, Imf::globalThreadCount());
}

/// Compression level, 1 to 9. Higher ones take longer and hardly shrink noisy pictures.
constexpr int kZipLevel = 2;

Imf::Header header_of(const PictureHead& head, const std::vector<bool>& is_half) {
  const PixelBounds& w = head.window;
  Imf::Header header({{0, 0}, {head.full_width - 1, head.full_height - 1}},
                     {{w.x0, w.y0}, {w.x1 - 1, w.y1 - 1}}, 1.0f, {0, 0}, 1.0f, Imf::INCREASING_Y,
                     Imf::ZIP_COMPRESSION);
  header.zipCompressionLevel() = kZipLevel;
  const RgbColorSpace* space = head.color_space;
  if (space != nullptr && space->name() != "srgb") {
    const auto c = chromaticities(*space);
    Imf::addChromaticities(header, {{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}});
  }
  for (size_t i = 0; i < head.channels.size(); ++i)
    header.channels().insert(head.channels[i], Imf::Channel(is_half[i] ? Imf::HALF : Imf::FLOAT));
  // Metadata of a picture that was read may repeat attributes of the file, such as its compression.
  for (const auto& [key, value] : head.metadata)
    if (header.find(key) == header.end()) header.insert(key, Imf::StringAttribute(value));
  return header;
}

/// Rows in the encoder's layout: channel by channel, each row by row.
class Strip {
 public:
  Strip(const PictureHead& head, const std::vector<bool>& is_half)
      : head_(head),
        is_half_(is_half),
        width_(head.width()),
        rows_(rows_at_once(head.width(), is_half.size())) {
    size_t bytes = 0;
    for (const bool half : is_half) {
      offsets_.push_back(bytes);
      bytes += size_t{half ? 2u : 4u} * width_ * rows_;
    }
    bytes_.resize(bytes);
    largest_.resize(rows_ * channels());
  }
  size_t channels() const { return is_half_.size(); }
  /// Capacity in rows.
  int rows() const { return rows_; }

  /// Fills the rows [y0, y0 + rows) and updates each channel's `largest` magnitude.
  void fill(const FillRow& fill_row, int y0, int rows, std::vector<float>& largest) {
    std::ranges::fill(largest_, 0.0f);
    parallel_chunks(rows, kRowsOfBlock, [&](int64_t, int64_t begin, int64_t end) {
      std::vector<float> row(channels() * width_);
      for (int64_t r = begin; r < end; ++r) {
        fill_row(y0 + static_cast<int>(r), row.data());
        for (size_t c = 0; c < channels(); ++c) put(row, static_cast<size_t>(r), c);
      }
    });
    for (size_t i = 0; i < largest_.size(); ++i)
      largest[i % channels()] = std::max(largest[i % channels()], largest_[i]);
  }
  Imf::FrameBuffer frame(int y0) const {
    Imf::FrameBuffer frame;
    for (size_t c = 0; c < channels(); ++c) {
      const auto size = static_cast<intptr_t>(is_half_[c] ? 2 : 4), row = size * width_;
      // The address that pixel (0, 0) would have.
      const auto origin = reinterpret_cast<intptr_t>(bytes_.data() + offsets_[c]) -
                          size * head_.window.x0 - row * y0;
      frame.insert(head_.channels[c], Imf::Slice(is_half_[c] ? Imf::HALF : Imf::FLOAT,
                                                 reinterpret_cast<char*>(origin), size, row));
    }
    return frame;
  }

 private:
  void put(const std::vector<float>& row, size_t r, size_t c) {
    float largest = 0;
    const auto copy = [&]<class T>(T* out) {
      for (int x = 0; x < width_; ++x) {
        const float value = row[x * channels() + c];
        largest = std::max(largest, std::abs(value));
        out[x] = T(value);
      }
    };
    std::byte* const memory = bytes_.data() + offsets_[c];
    if (is_half_[c])
      copy(reinterpret_cast<half*>(memory) + r * width_);
    else
      copy(reinterpret_cast<float*>(memory) + r * width_);
    largest_[r * channels() + c] = largest;
  }
  const PictureHead& head_;
  const std::vector<bool>& is_half_;
  int width_, rows_;
  std::vector<size_t> offsets_;  ///< [channel]
  std::vector<std::byte> bytes_;
  std::vector<float> largest_;  ///< [row][channel], magnitudes
};

/// Writes the file without committing it. Returns the largest magnitude of each channel.
std::vector<float> encode(const std::string& path, AtomicFile& file, const PictureHead& head,
                          const std::vector<bool>& is_half, const FillRow& fill) {
  AtomicOutput output(path, file);
  std::vector<float> largest(head.channels.size(), 0.0f);
  try {
    Imf::OutputFile out(output, header_of(head, is_half),
                        encoder_threads(head.width(), head.channels.size()));
    Strip strip(head, is_half);
    for (int y = head.window.y0; y < head.window.y1; y += strip.rows()) {
      const int rows = std::min(strip.rows(), head.window.y1 - y);
      strip.fill(fill, y, rows, largest);
      out.setFrameBuffer(strip.frame(y));
      out.writePixels(rows);
    }
  } catch (const std::bad_alloc&) {
    output.throw_if_failed();
    throw;
  } catch (const std::exception& error) {
    output.throw_if_failed();
    throw IoError(path + ": cannot encode: " + error.what());
  }
  output.throw_if_failed();
  return largest;
}

std::string layer_of(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  return dot == std::string::npos ? std::string() : channel.substr(0, dot);
}

/// False if a layer's values exceed the range of 16-bit floats or would lose digits.
bool fits_half(float largest) {
  return largest == 0 || (largest >= HALF_NRM_MIN && largest <= HALF_MAX);
}

}  // namespace

uint64_t encoder_bytes(int width, size_t channels) {
  const int blocks = rows_at_once(width, channels) / kRowsOfBlock;
  // The strip, a row for each thread that fills it, and the library's buffers.
  const int of_library = 3 * std::max(1, 2 * encoder_threads(width, channels));
  return static_cast<uint64_t>(2 * blocks + of_library) * bytes_of_block(width, channels);
}

void write_exr(const std::string& path, const PictureHead& head,
               const std::vector<bool>& may_be_half, const FillRow& fill) {
  std::vector<bool> is_half = may_be_half;
  for (;;) {
    AtomicFile file(path);
    const std::vector<float> largest = encode(path, file, head, is_half, fill);
    // Known only now, and rare: a lamp in view with a radiance above 65504, or a very dark picture.
    bool again = false;
    for (size_t c = 0; c < is_half.size(); ++c) {
      if (!may_be_half[c]) continue;
      float of_layer = 0;
      for (size_t k = 0; k < is_half.size(); ++k)
        if (layer_of(head.channels[k]) == layer_of(head.channels[c]))
          of_layer = std::max(of_layer, largest[k]);
      const bool fits = fits_half(of_layer);
      again |= !fits && is_half[c];
      is_half[c] = fits;
    }
    if (!again) return file.commit();
  }
}

void write_exr(const std::string& path, const Picture& picture) {
  const size_t row = static_cast<size_t>(picture.width()) * picture.channels.size();
  write_exr(path, picture, std::vector<bool>(picture.channels.size(), false),
            [&](int y, float* out) {
              std::copy_n(picture.pixels.begin() + (y - picture.window.y0) * row, row, out);
            });
}

}  // namespace nephroid
