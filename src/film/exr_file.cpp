// A file is written through AtomicFile, row by row from the memory of its owners: a state is as
// large as the film, and a copy of it would be twice the memory.
#include "film/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <optional>

#include "core/content_hash.h"
#include "core/errors.h"
#include "film/atomic_file.h"
#include "film/chromaticities.h"
#include "film/exr_layout.h"

namespace nephroid {

namespace {

/// Where the encoder's bytes go. It writes its tables of offsets where nobody sees an exception, so
/// the first error is kept.
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

Imath::Box2i box_of(const PixelBounds& b) {
  return {{b.x0, b.y0}, {b.x1 - 1, b.y1 - 1}};
}

/// What the parts of a file must agree on, and a part's own place in it.
Imf::Header header_of(const Picture& picture, const PixelBounds& window, const std::string& name,
                      Imf::Compression compression) {
  Imf::Header header({{0, 0}, {picture.full_width - 1, picture.full_height - 1}}, box_of(window),
                     1.0f, {0, 0}, 1.0f, Imf::INCREASING_Y, compression);
  header.setType(Imf::SCANLINEIMAGE);
  header.setName(name);
  const RgbColorSpace* space = picture.color_space;
  if (space != nullptr && space->name() != "srgb") {
    const auto c = chromaticities(*space);
    Imf::addChromaticities(header, {{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}, {c[6], c[7]}});
  }
  return header;
}

Imf::Header picture_header(const Picture& picture) {
  Imf::Header header = header_of(picture, picture.window, "picture", Imf::ZIP_COMPRESSION);
  for (const std::string& channel : picture.channels)
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  // A picture that was read may bring what the file says for itself, its compression for one.
  for (const auto& [key, value] : picture.metadata)
    if (header.find(key) == header.end()) header.insert(key, Imf::StringAttribute(value));
  return header;
}

/// A part of the state: `words` in each of `window`'s pixels.
struct Part {
  std::string name;
  PixelBounds window;
  size_t words = 1;
  std::span<const std::byte> bytes;  ///< what is used of it
  std::vector<uint32_t> owned;       ///< all of it, if nobody else has it
  const void* memory() const {
    if (!owned.empty()) return owned.data();
    return bytes.data();
  }
};

Part part_of_stream(std::string name, std::vector<uint32_t> words) {
  const size_t used = words.size();
  Part part{std::move(name), window_of_stream(used), 1, {}, std::move(words)};
  part.owned.resize(part.window.area());
  part.bytes = std::as_bytes(std::span(part.owned).first(used));
  return part;
}

bool is_of_pixels(const RenderState::Array& array, const PixelBounds& window) {
  return array.items() == static_cast<size_t>(window.area());
}

std::vector<uint32_t> words_of(std::span<const std::byte> bytes) {
  std::vector<uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), 4 * words.size());
  return words;
}

Imf::Header part_header(const Picture& picture, const Part& part) {
  Imf::Header header = header_of(picture, part.window, kPartPrefix + part.name, kStateCompression);
  for (const std::string& channel : channels_of_words(part.words))
    header.channels().insert(channel, Imf::Channel(Imf::UINT));
  header.insert(kWordsKey, Imf::StringAttribute(std::to_string(part.bytes.size() / 4)));
  return header;
}

std::vector<Part> parts_of(const RenderState& state, const PixelBounds& window) {
  std::vector<Part> parts;
  for (const RenderState::Array& array : state.arrays)
    if (is_of_pixels(array, window))
      parts.push_back({array.name, window, array.words, array.bytes, {}});
    else
      parts.push_back(part_of_stream(array.name, words_of(array.bytes)));
  for (const RenderState::Stream& stream : state.streams)
    parts.push_back(part_of_stream(stream.name, stream.save()));
  std::vector<uint32_t> checksums;
  for (const Part& part : parts) {
    const auto words = words_of_hash(hash_of(part.bytes));
    checksums.insert(checksums.end(), words.begin(), words.end());
  }
  parts.push_back(part_of_stream(kChecksums, std::move(checksums)));
  return parts;
}

/// What the encoder makes room for, for each buffer: rows of all parts, packed and unpacked, and
/// what it sorts their bytes in.
uint64_t bytes_of_rows(int width, size_t channels, size_t state_words) {
  constexpr uint64_t kRowsOfZip = 16, kCopies = 3;
  return 4 * kCopies * width * (kRowsOfZip * channels + state_words);
}

/// Two buffers for each; without any, the caller's thread encodes, with one.
int encoder_threads(uint64_t bytes_of_buffer) {
  const uint64_t fit = kMaxEncoderBytes / (2 * bytes_of_buffer);
  return static_cast<int>(std::min<uint64_t>(fit, Imf::globalThreadCount()));
}

}  // namespace

uint64_t encoder_bytes(int width, size_t channels, size_t state_words) {
  const uint64_t each = bytes_of_rows(width, channels, state_words);
  return std::max(each, 2 * each * encoder_threads(each));
}

void write_exr(const std::string& path, const Picture& picture, const RenderState* state) {
  AtomicFile file(path);
  AtomicOutput output(path, file);
  std::vector<Part> parts;
  if (state) parts = parts_of(*state, picture.window);
  try {
    std::vector<Imf::Header> headers{picture_header(picture)};
    for (const Part& part : parts) headers.push_back(part_header(picture, part));
    if (state) headers.back().insert(kTextsKey, Imf::StringAttribute(hash_of_texts(headers[0])));
    size_t state_words = 0;
    for (const Part& part : parts) state_words += part.words;
    Imf::MultiPartOutputFile out(
        output, headers.data(), static_cast<int>(headers.size()), false,
        encoder_threads(
            bytes_of_rows(picture.window.width(), picture.channels.size(), state_words)));
    const auto write = [&](size_t i, const Imf::FrameBuffer& frame, const PixelBounds& window) {
      Imf::OutputPart part(out, static_cast<int>(i));
      part.setFrameBuffer(frame);
      part.writePixels(window.height());
    };
    write(0, frame_of(picture.window, picture.channels, Imf::FLOAT, picture.pixels.data()),
          picture.window);
    for (size_t i = 0; i < parts.size(); ++i)
      write(i + 1,
            frame_of(parts[i].window, channels_of_words(parts[i].words), Imf::UINT,
                     parts[i].memory()),
            parts[i].window);
  } catch (const std::bad_alloc&) {
    output.throw_if_failed();
    throw;
  } catch (const std::exception& error) {
    output.throw_if_failed();
    throw IoError(path + ": cannot encode: " + error.what());
  }
  output.throw_if_failed();
  file.commit();
}

}  // namespace nephroid
