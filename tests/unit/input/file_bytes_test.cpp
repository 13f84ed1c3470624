// Whole files, compressed or not, and errors that name them.
#include "input/file_bytes.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "unit/input/gzip_bytes.h"
#include "unit/input/parse_text.h"
#include "unit/input/temporary_directory.h"

namespace nephroid {
namespace {

using testing::error_of;
using testing::gzip;
using testing::TemporaryDirectory;

/// Poorly compressible bytes from a small linear congruential generator.
std::string noise(size_t size) {
  std::string bytes(size, '\0');
  uint32_t state = 1;
  for (char& c : bytes) {
    state = state * 1664525u + 1013904223u;
    c = static_cast<char>(state >> 24);
  }
  return bytes;
}

TEST(FileBytes, ReadsAnySize) {
  const TemporaryDirectory directory;
  for (const size_t size : {size_t{0}, size_t{1}, size_t{1000}, size_t{3000001}}) {
    const std::string bytes = noise(size);
    EXPECT_EQ(read_file_bytes(directory.write("f", bytes)), bytes);
    EXPECT_EQ(read_file_bytes(directory.write("f.gz", gzip(bytes))), bytes);
  }
}

TEST(FileBytes, UnpacksChainedMembersAndIgnoresPadding) {
  const TemporaryDirectory directory;
  const std::string path =
      directory.write("f.GZ", gzip("one ") + gzip("two") + std::string(10, '\0'));
  EXPECT_EQ(read_file_bytes(path), "one two");
}

TEST(FileBytes, RefusesToUnpackTooMuch) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("f.gz", gzip(std::string(5000, 'x')));
  EXPECT_EQ(read_file_bytes(path, 5000).size(), 5000u);
  EXPECT_EQ(error_of([&] { read_file_bytes(path, 4999); }),
            "cannot read \"" + path + "\": it unpacks to more than 4999 bytes");
}

TEST(FileBytes, PipesAreReadAndUnpackedByTheirContent) {
  const TemporaryDirectory directory;
  const std::string pipe = directory.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(is_stream(pipe));
  EXPECT_FALSE(is_stream(directory.write("file", "a")));
  EXPECT_FALSE(is_stream(directory.path("absent")));
  for (const std::string& bytes : {std::string("Shape"), gzip("Shape")}) {
    std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << bytes; });
    EXPECT_EQ(read_file_bytes(pipe), "Shape");
    writer.join();
  }
}

TEST(FileBytes, NamesTheFileAndTheReason) {
  const TemporaryDirectory directory;
  EXPECT_EQ(error_of([&] { read_file_bytes(directory.path("absent")); }),
            "cannot read \"" + directory.path("absent") + "\": No such file or directory");
  EXPECT_EQ(error_of([&] { read_file_bytes(directory.path()); }),
            "cannot read \"" + directory.path() + "\": it is a directory");
  try {
    read_file_bytes(directory.path("absent"));
    FAIL();
  } catch (const IoError& error) {
    EXPECT_EQ(error.status(), ExitStatus::kInputOutput);
  }
}

TEST(FileBytes, RefusesDamagedGzip) {
  const TemporaryDirectory directory;
  const std::string packed = gzip(noise(2000000));
  const std::string cut = directory.write("cut.gz", packed.substr(0, packed.size() / 2));
  EXPECT_EQ(error_of([&] { read_file_bytes(cut); }),
            "cannot read \"" + cut + "\": the gzip data ends too early");
  const std::string empty = directory.write("empty.gz", "");
  EXPECT_EQ(error_of([&] { read_file_bytes(empty); }),
            "cannot read \"" + empty + "\": the gzip data ends too early");
  const std::string plain = directory.write("plain.gz", "Shape");
  EXPECT_EQ(error_of([&] { read_file_bytes(plain); }),
            "cannot read \"" + plain + "\": not valid gzip data (incorrect header check)");
  std::string flipped = packed;
  flipped[flipped.size() - 6] = static_cast<char>(flipped[flipped.size() - 6] ^ 1);
  const std::string checksum = directory.write("checksum.gz", flipped);
  EXPECT_EQ(error_of([&] { read_file_bytes(checksum); }),
            "cannot read \"" + checksum + "\": not valid gzip data (incorrect data check)");
}

}  // namespace
}  // namespace nephroid
