// Reads whole files and unpacks gzip data (RFC 1952) with zlib. The output grows with the bytes
// that are unpacked, never with the claims of a header.
#include "input/file_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <system_error>

namespace nephroid {
namespace {

constexpr size_t kChunk = size_t{1} << 20;
constexpr size_t kFirstGuess = size_t{1} << 16;

[[noreturn]] void cannot_read(const std::string& path, const std::string& reason) {
  throw IoError("cannot read \"" + path + "\": " + reason);
}

std::string reason_of(int error_number) {
  return std::generic_category().message(error_number);
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Reads to the end, first `expected` bytes. The size is limited, since pipes may never end.
std::string read_all(std::FILE& file, const std::string& path, size_t expected) {
  std::string bytes;
  size_t used = 0;
  for (;;) {
    if (used == bytes.size())
      bytes.resize(used == 0 ? expected : used + std::max(used / 2, kChunk));
    const size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, &file);
    used += got;
    if (used > std::max<uint64_t>(expected, kMaxUnpackedBytes))
      cannot_read(path, "it does not end within " + std::to_string(kMaxUnpackedBytes) + " bytes");
    if (used < bytes.size()) {
      if (std::ferror(&file)) cannot_read(path, reason_of(errno));
      if (std::feof(&file)) break;
    }
  }
  bytes.resize(used);
  return bytes;
}

std::string read_raw(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status)) cannot_read(path, "it is a directory");
  // Some devices never end.
  if (std::filesystem::is_block_file(status) ||
      (std::filesystem::is_character_file(status) && path != "/dev/null" && path != "/dev/stdin"))
    cannot_read(path, "it is a device");
  // The size is only a hint: pipes have none, and files may change while they are read.
  size_t expected = kFirstGuess;
  if (std::filesystem::is_regular_file(status)) {
    const auto size = std::filesystem::file_size(path, ignored);
    if (!ignored) expected = size + 1;
  }
  errno = 0;
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) cannot_read(path, reason_of(errno));
  return read_all(*file, path, expected);
}

bool is_gzip(const std::string& bytes) {
  return bytes.starts_with("\x1f\x8b");
}

struct EndInflate {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

/// Unpacks gzip data. gzread is not used: it takes a descriptor instead of bytes, passes unpacked
/// data through, and does not report empty files.
std::string unpack(const std::string& path, const std::string& packed, uint64_t max_unpacked) {
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) cannot_read(path, "zlib could not start");
  const std::unique_ptr<z_stream, EndInflate> end(&stream);

  std::string bytes;
  const auto chunk = std::make_unique<char[]>(kChunk);
  size_t offset = 0;
  bool inside_member = true;  // even an empty gzip file has a header
  while (inside_member) {
    const size_t feed = std::min<size_t>(packed.size() - offset, std::numeric_limits<uInt>::max());
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + offset));
    stream.avail_in = static_cast<uInt>(feed);
    stream.next_out = reinterpret_cast<Bytef*>(chunk.get());
    stream.avail_out = static_cast<uInt>(kChunk);
    const int result = inflate(&stream, Z_NO_FLUSH);
    offset += feed - stream.avail_in;
    const size_t produced = kChunk - stream.avail_out;
    if (bytes.size() + produced > max_unpacked)
      cannot_read(path, "it unpacks to more than " + std::to_string(max_unpacked) + " bytes");
    bytes.append(chunk.get(), produced);

    if (result == Z_STREAM_END) {
      // gzip files may be chained; anything else after the end is padding, as in gzip itself.
      inside_member =
          packed.size() - offset >= 2 && packed[offset] == '\x1f' && packed[offset + 1] == '\x8b';
      if (inside_member) inflateReset(&stream);
    } else if (result == Z_BUF_ERROR) {  // the input ends inside of the data
      cannot_read(path, "the gzip data ends too early");
    } else if (result != Z_OK) {
      cannot_read(path, std::string("not valid gzip data") +
                            (stream.msg ? std::string(" (") + stream.msg + ")" : ""));
    }
  }
  return bytes;
}

}  // namespace

void file_is_unreadable(const SourceLocation& named_by, const std::string& message) {
  if (named_by.file) throw SceneError(named_by, message);
  throw IoError(message);
}

bool has_suffix(const std::string& path, const std::string& suffix) {
  return path.size() >= suffix.size() &&
         std::equal(suffix.rbegin(), suffix.rend(), path.rbegin(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) ==
                  std::tolower(static_cast<unsigned char>(b));
         });
}

std::string read_file_bytes(const std::string& path, uint64_t max_unpacked) {
  const bool streams = is_stream(path);
  std::string bytes = read_raw(path);
  const bool packed = streams ? is_gzip(bytes) : has_suffix(path, ".gz");
  return packed ? unpack(path, bytes, max_unpacked) : bytes;
}

std::string read_standard_input(uint64_t max_unpacked) {
  const std::string name = "standard input";
  std::string bytes = read_all(*stdin, name, kFirstGuess);
  return is_gzip(bytes) ? unpack(name, bytes, max_unpacked) : bytes;
}

bool is_stream(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::is_other(status);
}

}  // namespace nephroid
