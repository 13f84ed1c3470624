// Blocks are packed and unpacked in parallel, a few at a time, and written and read in order. Files
// are not trusted: they may be damaged or malicious.
#include "film/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/content_hash.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/atomic_file.h"
#include "film/packed_blocks.h"
#include "film/state_index.h"

namespace nephroid {
namespace {

constexpr std::array<char, 8> kBegin = {'N', 'E', 'P', 'H', 'S', 'T', 'A', 4};

/// True if these are the first bytes of a state of any version.
bool begins_a_state(const std::array<char, 8>& begin) {
  return std::equal(begin.begin(), begin.end() - 1, kBegin.begin());
}

/// The last bytes of a file.
struct Footer {
  uint64_t index_offset = 0, index_bytes = 0, index_hash = 0;
  std::array<char, 8> end = kBegin;
};

/// Number of blocks in memory.
constexpr size_t kStateBlocksAtOnce = 16;
using Blocks = std::array<PackedBlock, kStateBlocksAtOnce>;

/// The byte range of a block within its section.
struct Extent {
  size_t offset = 0, size = 0;
};
Extent extent_of_block(const StateIndex::Section& section, size_t block) {
  const size_t offset = block * section.block_bytes();
  return {offset, std::min<size_t>(section.block_bytes(), section.bytes - offset)};
}

/// Calls body(i) for each i < count in parallel.
template <class Body>
void for_each_of(size_t count, const Body& body) {
  parallel_chunks(static_cast<int64_t>(count), 1, [&](int64_t, int64_t begin, int64_t end) {
    for (int64_t i = begin; i < end; ++i) body(static_cast<size_t>(i));
  });
}

class Output {
 public:
  explicit Output(const std::string& path) : file_(path) {
    write(std::as_bytes(std::span(kBegin)));
  }

  StateIndex::Section write_section(const std::string& name, size_t words,
                                    std::span<const std::byte> bytes) {
    StateIndex::Section section{
        name, static_cast<uint32_t>(words), bytes.size(), hash_of(bytes), offset_, {}};
    const size_t blocks = section.block_count();
    for (size_t first = 0; first < blocks; first += kStateBlocksAtOnce) {
      const size_t count = std::min(kStateBlocksAtOnce, blocks - first);
      for_each_of(count, [&](size_t i) {
        const Extent extent = extent_of_block(section, first + i);
        pack_block(bytes.subspan(extent.offset, extent.size), section.stride(), blocks_[i]);
      });
      for (size_t i = 0; i < count; ++i) {
        section.blocks.push_back(static_cast<uint32_t>(blocks_[i].packed.size()));
        write(blocks_[i].packed);
      }
    }
    return section;
  }
  void finish(const StateIndex& index) {
    const std::vector<std::byte> bytes = index.to_bytes();
    const Footer footer{offset_, bytes.size(), hash_of(bytes)};
    write(bytes);
    write(std::as_bytes(std::span(&footer, 1)));
    file_.commit();
  }

 private:
  void write(std::span<const std::byte> bytes) {
    file_.write(offset_, bytes);
    offset_ += bytes.size();
  }
  AtomicFile file_;
  uint64_t offset_ = 0;
  Blocks blocks_;
};

}  // namespace

std::string state_path_beside(const std::string& picture_path) {
  return std::filesystem::path(picture_path).replace_extension(".state").string();
}

void write_state(const std::string& path, const StateHead& head, const RenderState& state) {
  Output out(path);
  StateIndex index{head.resolution, head.window, head.metadata, {}};
  for (const RenderState::Array& array : state.arrays)
    index.sections.push_back(out.write_section(array.name, array.words, array.bytes));
  for (const RenderState::Stream& stream : state.streams) {
    const std::vector<uint32_t> words = stream.save();
    index.sections.push_back(out.write_section(stream.name, 1, std::as_bytes(std::span(words))));
  }
  out.finish(index);
}

struct StateFile::Input {
  std::string path;
  uint64_t bytes = 0;
  std::ifstream file;
  StateIndex index;
  Blocks blocks;

  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(path + ": cannot read this state of a render: " + what);
  }
  void read(uint64_t offset, std::span<std::byte> into) {
    file.seekg(static_cast<std::streamoff>(offset));
    file.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
    if (!file) fail("the file is shorter than its index says");
  }
  void open(const std::string& name) {
    path = name;
    file.open(path, std::ios::binary);
    std::error_code error;
    bytes = std::filesystem::file_size(path, error);
    if (!file || error) throw IoError(path + ": cannot read");
    std::array<char, 8> begin{};
    if (bytes < sizeof(begin) + sizeof(Footer))
      fail("it is damaged, expected the state of a render");
    read(0, std::as_writable_bytes(std::span(begin)));
    if (!begins_a_state(begin))
      fail("it is not the state of a render, or damaged, expected such a state");
    if (begin.back() != kBegin.back())
      fail("another version of this program wrote it, expected a state of this version");
    Footer footer;
    read(bytes - sizeof(footer), std::as_writable_bytes(std::span(&footer, 1)));
    const uint64_t before_footer = bytes - sizeof(footer);
    if (footer.end != kBegin || footer.index_bytes > before_footer ||
        footer.index_offset != before_footer - footer.index_bytes)
      fail("its end is missing or damaged");
    std::vector<std::byte> of_index(footer.index_bytes);
    read(footer.index_offset, of_index);
    if (hash_of(of_index) != footer.index_hash) fail("its index is damaged");
    try {
      index = StateIndex::from_bytes(of_index, footer.index_offset);
    } catch (const IoError& error_of_index) {
      fail(error_of_index.what());
    }
  }

  /// Null if the section is missing.
  const StateIndex::Section* find(const std::string& name) const {
    const auto found = std::ranges::find(index.sections, name, &StateIndex::Section::name);
    return found == index.sections.end() ? nullptr : &*found;
  }
  const StateIndex::Section& at(const std::string& name) const {
    const StateIndex::Section* found = find(name);
    if (!found) fail("'" + name + "' is missing");
    return *found;
  }
  void read_stream(const RenderState::Stream& stream) {
    const StateIndex::Section& section = at(stream.name);
    if (section.words != 1 || section.bytes > 4 * stream.most_words)
      fail("'" + stream.name + "' has the wrong size");
    std::vector<uint32_t> words(section.bytes / 4);
    read_section(section, std::as_writable_bytes(std::span(words)));
    try {
      stream.load(words);
    } catch (const IoError& error) {
      fail(fmt::format("'{}': {}", stream.name, error.what()));
    }
  }
  /// Reads all blocks of a section into memory of its size.
  void read_section(const StateIndex::Section& section, std::span<std::byte> into) {
    uint64_t offset = section.offset;
    std::atomic<bool> is_whole = true;
    for (size_t first = 0; first < section.blocks.size(); first += kStateBlocksAtOnce) {
      const size_t count = std::min(kStateBlocksAtOnce, section.blocks.size() - first);
      for (size_t i = 0; i < count; ++i) {
        std::vector<std::byte>& packed = blocks[i].packed;
        packed.resize(section.blocks[first + i]);
        read(offset, packed);
        offset += packed.size();
      }
      for_each_of(count, [&](size_t i) {
        const Extent extent = extent_of_block(section, first + i);
        if (!unpack_block(blocks[i], section.stride(), into.subspan(extent.offset, extent.size)))
          is_whole = false;
      });
    }
    if (!is_whole || hash_of(into) != section.hash) fail("'" + section.name + "' is damaged");
  }
};

StateFile::StateFile(const std::string& path) : input_(std::make_unique<Input>()) {
  input_->open(path);
}

StateFile::~StateFile() = default;
StateFile::StateFile(StateFile&&) noexcept = default;
StateFile& StateFile::operator=(StateFile&&) noexcept = default;

const std::string& StateFile::path() const {
  return input_->path;
}

const Metadata& StateFile::metadata() const {
  return input_->index.metadata;
}

Vec2i StateFile::resolution() const {
  return input_->index.resolution;
}

PixelBounds StateFile::window() const {
  return input_->index.window;
}

uint64_t StateFile::size() const {
  return input_->bytes;
}

std::vector<std::string> StateFile::load(const RenderState& state) {
  Input& in = *input_;
  if (in.index.sections.size() != state.arrays.size() + state.streams.size())
    for (const StateIndex::Section& section : in.index.sections) {
      const auto has_name = [&](const auto& item) { return item.name == section.name; };
      if (std::ranges::none_of(state.arrays, has_name) &&
          std::ranges::none_of(state.streams, has_name) &&
          !RenderState::Stream::is_optional(section.name))
        in.fail("'" + section.name + "' is stored, which this render does not have");
    }
  for (const RenderState::Array& array : state.arrays) {
    const StateIndex::Section& section = in.at(array.name);
    if (section.bytes != array.bytes.size() || section.words != array.words)
      in.fail("'" + array.name + "' has the wrong size");
    in.read_section(section, array.bytes);
  }
  return load_streams(state);
}

bool StateFile::is_state(const std::string& path) {
  std::array<char, 8> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return begins_a_state(begin);
}

bool StateFile::has_words(const std::string& section) const {
  const StateIndex::Section* found = input_->find(section);
  return found != nullptr && found->bytes > 0;
}

std::vector<std::string> StateFile::load_streams(const RenderState& state) {
  Input& in = *input_;
  std::vector<std::string> passed_over;
  for (const RenderState::Stream& stream : state.streams) {
    if (stream.is_optional() && !in.find(stream.name)) continue;
    try {
      in.read_stream(stream);
    } catch (const IoError& error) {
      if (!stream.is_optional()) throw;
      passed_over.emplace_back(error.what());
    }
  }
  return passed_over;
}

}  // namespace nephroid
