// Files that change after they were read.
#include "view/watched_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "view/temporary_directory.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

class Watched : public ::testing::Test {
 protected:
  Watched() { write(file_, "old"); }

  static void write(const std::string& path, const std::string& text) {
    std::ofstream(path) << text;
  }
  /// Sets another time of the last change, so that no test waits for the clock.
  static void touch(const std::string& path, int seconds) {
    fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(seconds));
  }
  FileStamps read() const { return {{file_, stamp_of(file_)}, {missing_, stamp_of(missing_)}}; }

  TemporaryDirectory directory_;
  std::string file_ = directory_.file("scene.pbrt"), missing_ = directory_.file("ball.pbrt");
};

TEST_F(Watched, FilesStayAsTheyAre) {
  const FileStamps as_read = read();
  EXPECT_FALSE(have_changed(as_read));
  EXPECT_FALSE(have_changed(as_read));
  EXPECT_FALSE(have_changed({}));
}

TEST_F(Watched, AnotherTimeIsAChange) {
  const FileStamps as_read = read();
  touch(file_, 2);
  EXPECT_TRUE(have_changed(as_read));
  EXPECT_TRUE(have_changed(as_read)) << "until the file is read again";
  EXPECT_FALSE(have_changed(read()));
}

TEST_F(Watched, AnEarlierTimeIsAChange) {
  const FileStamps as_read = read();
  touch(file_, -3600);  // an older version was moved there
  EXPECT_TRUE(have_changed(as_read));
}

TEST_F(Watched, AnotherSizeAtTheSameTimeIsAChange) {
  const FileStamps as_read = read();
  const auto time = fs::last_write_time(file_);
  write(file_, "old, and more");
  fs::last_write_time(file_, time);
  EXPECT_TRUE(have_changed(as_read));
}

TEST_F(Watched, AFileThatIsMissingAtOneLookHasNotChanged) {
  const FileStamps as_read = read();
  const std::string aside = directory_.file("aside");
  fs::rename(file_, aside);
  EXPECT_FALSE(have_changed(as_read));
  fs::rename(aside, file_);
  EXPECT_FALSE(have_changed(as_read));
}

TEST_F(Watched, AFileThatIsRemovedAndWrittenAnewHasChanged) {
  const FileStamps as_read = read();
  fs::remove(file_);
  EXPECT_FALSE(have_changed(as_read));
  write(file_, "new");
  touch(file_, 2);
  EXPECT_TRUE(have_changed(as_read));
}

TEST_F(Watched, AFileThatAppearsIsAChange) {
  const FileStamps as_read = read();
  EXPECT_FALSE(have_changed(as_read));
  write(missing_, "here");
  EXPECT_TRUE(have_changed(as_read));
}

}  // namespace
}  // namespace nephroid
