// Nothing is taken for granted: a file may be damaged, or made to do harm.
#include "film/state_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <map>

#include "core/content_hash.h"
#include "core/errors.h"
#include "film/exr_layout.h"
#include "input/exr_header.h"

namespace nephroid {

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
    std::vector<uint32_t> words(wanted.area());
    read(name, place, words.data());
    words.resize(place.total_words);
    return words;
  }
};

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
  const auto checksums = in.parts.find(kChecksums);
  if (checksums == in.parts.end()) return;  // there is no state, or it cannot be loaded
  const auto* texts =
      in.file->header(checksums->second.part).findTypedAttribute<Imf::StringAttribute>(kTextsKey);
  if (!texts) in.fail("it was written by an earlier build of this program");
  if (texts->value() != hash_of_texts(in.file->header(0))) in.fail("its metadata are damaged");
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
  const std::vector<uint32_t> checksums = in.read_stream(kChecksums, 2 * found.size());
  if (checksums.size() != 2 * found.size()) in.fail("its parts are not those of this render");
  for (size_t i = 0; i < found.size(); ++i)
    if (const auto words = words_of_hash(found[i]);
        !std::equal(words.begin(), words.end(), checksums.begin() + 2 * i))
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
