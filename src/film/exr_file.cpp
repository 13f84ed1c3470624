// A file is written through AtomicFile, row by row from the memory of its owners: a state is as
// large as the film, and a copy of it would be twice the memory.
#include "film/exr_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>

#include "core/content_hash.h"
#include "core/errors.h"
#include "film/atomic_file.h"
#include "film/chromaticities.h"
#include "input/exr_header.h"

namespace nephroid {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr const char* kPartPrefix = "state.";
/// What is not of pixels is a picture of this width.
constexpr size_t kStreamWidth = 1024;
/// The last part: two words for each other one, and two for the picture's texts, by which damage is
/// seen.
constexpr const char* kChecksums = "checksums";
constexpr const char* kWordsKey = "nephroid:words";

/// Where the encoder's bytes go. It writes its tables of offsets where nobody sees an exception, so
/// the first error is kept.
class AtomicOutput : public Imf::OStream {
 public:
  AtomicOutput(const std::string& path, AtomicFile& file) : OStream(path.c_str()), file_(file) {}
  void write(const char* data, int size) override {
    try {
      file_.write(position_, std::as_bytes(std::span(data, static_cast<size_t>(size))));
    } catch (const IoError& error) {
      if (!error_) error_ = error;
      throw;
    }
    position_ += static_cast<uint64_t>(size);
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

/// Items of a part, or of the picture, as they lie in memory: `channels` 32-bit numbers together.
Imf::FrameBuffer frame_of(const PixelBounds& window, const std::vector<std::string>& channels,
                          Imf::PixelType type, const void* memory) {
  Imf::FrameBuffer frame;
  const size_t item = 4 * channels.size(), row = item * static_cast<size_t>(window.width());
  // Where the pixel (0, 0) would be.
  const auto origin = reinterpret_cast<intptr_t>(memory) - static_cast<intptr_t>(item) * window.x0 -
                      static_cast<intptr_t>(row) * window.y0;
  for (size_t i = 0; i < channels.size(); ++i)
    frame.insert(channels[i], Imf::Slice(type, reinterpret_cast<char*>(origin) + 4 * i, item, row));
  return frame;
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

PixelBounds window_of_stream(size_t words) {
  const size_t width = std::clamp<size_t>(words, 1, kStreamWidth);
  return {0, 0, static_cast<int>(width),
          static_cast<int>(std::max<size_t>(1, (words + width - 1) / width))};
}

Part part_of_stream(std::string name, std::vector<uint32_t> words) {
  const size_t used = words.size();
  Part part{std::move(name), window_of_stream(used), 1, {}, std::move(words)};
  part.owned.resize(static_cast<size_t>(part.window.area()));
  part.bytes = std::as_bytes(std::span(part.owned).first(used));
  return part;
}

std::vector<std::string> channels_of_words(size_t words) {
  std::vector<std::string> names;
  for (size_t i = 0; i < words; ++i) names.push_back(fmt::format("w{:03}", i));
  return names;
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
  // Sums are noise below and nearly nothing above, of which this finds all that there is to find.
  Imf::Header header =
      header_of(picture, part.window, kPartPrefix + part.name, Imf::RLE_COMPRESSION);
  for (const std::string& channel : channels_of_words(part.words))
    header.channels().insert(channel, Imf::Channel(Imf::UINT));
  header.insert(kWordsKey, Imf::StringAttribute(std::to_string(part.bytes.size() / 4)));
  return header;
}

void add_words(uint64_t hash, std::vector<uint32_t>* words) {
  words->push_back(static_cast<uint32_t>(hash));
  words->push_back(static_cast<uint32_t>(hash >> 32));
}

/// Of all texts, which say what the picture is.
uint64_t hash_of_texts(const Imf::Header& header) {
  std::string texts;
  for (auto a = header.begin(); a != header.end(); ++a)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
      texts += std::string(a.name()) + '\0' + text->value() + '\0';
  return hash_of(std::as_bytes(std::span(texts)));
}

std::vector<Part> parts_of(const RenderState& state, const PixelBounds& window,
                           const Imf::Header& picture) {
  std::vector<Part> parts;
  for (const RenderState::Array& array : state.arrays)
    if (is_of_pixels(array, window))
      parts.push_back({array.name, window, array.words, array.bytes, {}});
    else
      parts.push_back(part_of_stream(array.name, words_of(array.bytes)));
  for (const RenderState::Stream& stream : state.streams)
    parts.push_back(part_of_stream(stream.name, stream.save()));
  std::vector<uint32_t> checksums;
  for (const Part& part : parts) add_words(hash_of(part.bytes), &checksums);
  add_words(hash_of_texts(picture), &checksums);
  parts.push_back(part_of_stream(kChecksums, std::move(checksums)));
  return parts;
}

/// What the encoder makes room for, for each buffer: rows of all parts, packed and unpacked, and
/// what it sorts their bytes in.
uint64_t bytes_of_rows(int width, size_t channels, size_t state_words) {
  constexpr uint64_t kRowsOfZip = 16, kCopies = 3;
  return 4 * kCopies * static_cast<uint64_t>(width) * (kRowsOfZip * channels + state_words);
}

/// Two buffers for each; without any, the caller's thread encodes, with one.
int encoder_threads(uint64_t bytes_of_buffer) {
  const uint64_t fit = kMostEncoderBytes / (2 * bytes_of_buffer);
  return static_cast<int>(std::min<uint64_t>(fit, static_cast<uint64_t>(Imf::globalThreadCount())));
}

}  // namespace

uint64_t encoder_bytes(int width, size_t channels, size_t state_words) {
  const uint64_t each = bytes_of_rows(width, channels, state_words);
  return std::max(each, 2 * each * static_cast<uint64_t>(encoder_threads(each)));
}

void write_exr(const std::string& path, const Picture& picture, const RenderState* state) {
  AtomicFile file(path);
  AtomicOutput output(path, file);
  try {
    std::vector<Imf::Header> headers{picture_header(picture)};
    std::vector<Part> parts;
    if (state) parts = parts_of(*state, picture.window, headers[0]);
    for (const Part& part : parts) headers.push_back(part_header(picture, part));
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
  } catch (const std::exception& error) {
    output.throw_if_failed();
    throw IoError(path + ": cannot encode: " + error.what());
  }
  output.throw_if_failed();
  file.commit();
}

struct StateFile::Input {
  std::string path;
  uint64_t bytes = 0;
  std::unique_ptr<Imf::MultiPartInputFile> file;
  struct Place {
    int part = 0;
    PixelBounds window;
    size_t words = 0;        ///< of a pixel
    size_t total_words = 0;  ///< as the file claims
  };
  std::map<std::string, Place> parts;

  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(path + ": cannot read its state: " + what);
  }
  const Place& find(const std::string& name) const {
    const auto found = parts.find(name);
    if (found == parts.end()) fail("'" + name + "' is missing");
    return found->second;
  }

  /// Reads a part into memory that has room for all of it.
  void read(const std::string& name, const Place& place, void* memory) const {
    try {
      Imf::InputPart part(*file, place.part);
      part.setFrameBuffer(
          frame_of(place.window, channels_of_words(place.words), Imf::UINT, memory));
      part.readPixels(place.window.y0, place.window.y1 - 1);
    } catch (const std::exception& error) {
      fail(fmt::format("'{}' cannot be read: {}", name, error.what()));
    }
  }

  std::vector<uint32_t> read_stream(const std::string& name, size_t most_words) const {
    const Place& place = find(name);
    const PixelBounds wanted = window_of_stream(std::min(place.total_words, most_words));
    if (place.words != 1 || place.total_words > most_words ||
        place.window.width() != wanted.width() || place.window.height() != wanted.height())
      fail("'" + name + "' has a size that it cannot have");
    std::vector<uint32_t> words(static_cast<size_t>(wanted.area()));
    read(name, place, words.data());
    words.resize(place.total_words);
    return words;
  }
};

namespace {

/// As part_header makes them. The library takes other memory for other kinds.
bool is_of_state(const Imf::Header& header) {
  if (!header.hasType() || header.type() != Imf::SCANLINEIMAGE) return false;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    if (c.channel().type != Imf::UINT) return false;
  return header.compression() == Imf::RLE_COMPRESSION;
}

}  // namespace

StateFile::StateFile(const std::string& path) : input_(std::make_unique<Input>()) {
  Input& in = *input_;
  in.path = path;
  // Runs of equal bytes are unpacked as fast as they are read, and every thread would have buffers.
  constexpr int kThreads = 0;
  if (const std::string fault = fault_of_exr_header(path, kThreads); !fault.empty())
    throw IoError(path + ": cannot read: " + fault);
  try {
    in.bytes = std::filesystem::file_size(path);
    in.file = std::make_unique<Imf::MultiPartInputFile>(path.c_str(), kThreads);
    const Imf::Header& first = in.file->header(0);
    for (auto a = first.begin(); a != first.end(); ++a)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
        metadata_.emplace_back(a.name(), text->value());
    const std::string prefix = kPartPrefix;
    for (int i = 1; i < in.file->parts(); ++i) {
      const Imf::Header& header = in.file->header(i);
      const auto* words = header.findTypedAttribute<Imf::StringAttribute>(kWordsKey);
      if (!words || !header.hasName() || !header.name().starts_with(prefix)) continue;
      if (!is_of_state(header))
        throw IoError(fmt::format("'{}' is no part of this program's", header.name()));
      const Imath::Box2i& box = header.dataWindow();
      Input::Place place{i, {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}, 0, 0};
      for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++place.words;
      const std::string& text = words->value();
      std::from_chars(text.data(), text.data() + text.size(), place.total_words);
      in.parts[header.name().substr(prefix.size())] = place;
    }
  } catch (const std::exception& error) {
    throw IoError(path + ": cannot read: " + error.what());
  }
}

StateFile::~StateFile() = default;
StateFile::StateFile(StateFile&&) noexcept = default;
StateFile& StateFile::operator=(StateFile&&) noexcept = default;

const std::string& StateFile::path() const {
  return input_->path;
}

Vec2i StateFile::resolution() const {
  const Imath::Box2i& box = input_->file->header(0).displayWindow();
  return {box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
}

PixelBounds StateFile::window() const {
  const Imath::Box2i& box = input_->file->header(0).dataWindow();
  return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
}

uint64_t StateFile::size() const {
  return input_->bytes;
}

bool StateFile::has_state() const {
  return !input_->parts.empty();
}

void StateFile::load(const RenderState& state) {
  const Input& in = *input_;
  std::vector<uint64_t> found;
  for (const RenderState::Array& array : state.arrays) {
    const Input::Place& place = in.find(array.name);
    if (place.total_words * 4 != array.bytes.size())
      in.fail("'" + array.name + "' has a size that it cannot have");
    if (place.words == array.words && static_cast<size_t>(place.window.area()) == array.items()) {
      in.read(array.name, place, array.bytes.data());
    } else {
      const std::vector<uint32_t> words = in.read_stream(array.name, array.bytes.size() / 4);
      std::memcpy(array.bytes.data(), words.data(), array.bytes.size());
    }
    found.push_back(hash_of(array.bytes));
  }
  std::vector<std::vector<uint32_t>> streams;
  for (const RenderState::Stream& stream : state.streams) {
    streams.push_back(in.read_stream(stream.name, stream.most_words));
    found.push_back(hash_of(std::as_bytes(std::span(streams.back()))));
  }
  const std::vector<uint32_t> checksums = in.read_stream(kChecksums, 2 * found.size() + 2);
  if (checksums.size() != 2 * found.size() + 2) in.fail("its parts are not those of this render");
  const auto is_whole = [&](size_t i, uint64_t hash) {
    return hash == (checksums[2 * i] | uint64_t{checksums[2 * i + 1]} << 32);
  };
  if (!is_whole(found.size(), hash_of_texts(in.file->header(0))))
    in.fail("what its metadata say is damaged");
  for (size_t i = 0; i < found.size(); ++i)
    if (!is_whole(i, found[i]))
      in.fail(fmt::format("'{}' is damaged", i < state.arrays.size()
                                                 ? state.arrays[i].name
                                                 : state.streams[i - state.arrays.size()].name));
  for (size_t i = 0; i < streams.size(); ++i) try {
      state.streams[i].load(streams[i]);
    } catch (const IoError& error) {
      in.fail(fmt::format("'{}': {}", state.streams[i].name, error.what()));
    }
}

}  // namespace nephroid
