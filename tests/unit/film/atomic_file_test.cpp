// Whole-file replacement: either the new content or the old one, and no leftovers.
#include "film/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/errors.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

void write_text(const std::string& path, const std::string& text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}
std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}
std::string error_of(const std::string& path) {
  try {
    write_text(path, "x");
  } catch (const IoError& error) {
    EXPECT_EQ(error.status(), ExitStatus::kInputOutput);
    return error.what();
  }
  return "";
}

TEST(AtomicFile, WritesAndReplaces) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.bin");
  write_text(path, "first, the longer one");
  EXPECT_EQ(read_text(path), "first, the longer one");
  write_text(path, "second");
  EXPECT_EQ(read_text(path), "second");
  write_text(path, "");
  EXPECT_EQ(read_text(path), "");
  EXPECT_EQ(directory.entries(), 1u);
}

TEST(AtomicFile, DirectoryAsTarget) {
  const ScratchDirectory directory;
  const std::string path = directory.file("taken");
  fs::create_directory(path);
  EXPECT_EQ(error_of(path), path + ": cannot write: it is a directory");
  EXPECT_THROW(check_file_can_be_written(path), IoError);
  EXPECT_EQ(directory.entries(), 1u);
}

TEST(AtomicFile, DeviceAsTargetIsNotReplaced) {
  EXPECT_NE(error_of("/dev/null").find("not a regular file"), std::string::npos);
}

TEST(AtomicFile, MissingDirectoryNamesTheReason) {
  const ScratchDirectory directory;
  const std::string path = directory.file("nowhere/out.bin");
  const std::string error = error_of(path);
  EXPECT_NE(error.find(path), std::string::npos);
  EXPECT_NE(error.find("No such file or directory"), std::string::npos);
  EXPECT_THROW(check_file_can_be_written(path), IoError);
}

TEST(AtomicFile, FileAsDirectory) {
  const ScratchDirectory directory;
  write_text(directory.file("plain"), "x");
  EXPECT_NE(error_of(directory.file("plain/out.bin")).find("Not a directory"), std::string::npos);
}

TEST(AtomicFile, UnwritableDirectory) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const ScratchDirectory directory;
  fs::permissions(directory.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(error_of(directory.file("out.bin")).find("Permission denied"), std::string::npos);
  EXPECT_THROW(check_file_can_be_written(directory.file("out.bin")), IoError);
}

// A file size limit makes write() fail, as a full disk does.
TEST(AtomicFile, DiskErrorLeavesTheOldFileAndNothingElse) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.bin");
  write_text(path, "old");
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit limited = before;
  limited.rlim_cur = 1024;
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limited);
  std::string error;
  try {
    write_text(path, std::string(100000, 'x'));
  } catch (const IoError& e) {
    error = e.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(error.find("File too large"), std::string::npos) << error;
  EXPECT_EQ(read_text(path), "old");
  EXPECT_EQ(directory.entries(), 1u);
}

// Leftovers of dead processes of this machine are removed, no others.
TEST(AtomicFile, LeftoversOfTheDeadAreRemoved) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.bin");
  const pid_t child = ::fork();
  if (child == 0) {
    AtomicFile file(path);
    ::kill(::getpid(), SIGKILL);
  }
  ASSERT_GT(child, 0);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(directory.entries(), 1u);
  // After a container restart, an earlier process may have had our process id.
  const std::string leftover = fs::directory_iterator(directory.file(""))->path().string();
  const size_t number = leftover.rfind('@') + 1;
  write_text(leftover.substr(0, number) + std::to_string(::getpid()) + "-7", "an earlier start's");
  AtomicFile ours(path);
  write_text(directory.file(".out.bin.tmp-elsewhere@" + std::to_string(child) + "-0"),
             "another machine's");
  write_text(directory.file(".out.bin.tmp-notes"), "somebody's");
  write_text(directory.file(".other.bin.tmp-" + std::to_string(child)), "another file's");
  EXPECT_EQ(directory.entries(), 6u);
  check_file_can_be_written(path);
  EXPECT_EQ(directory.entries(), 4u);
}

// Another container of this host writes the file: we cannot see its process.
TEST(AtomicFile, WhatSomebodyHoldsIsNoLeftover) {
  const ScratchDirectory directory;
  const std::string path = directory.file("out.bin");
  std::optional<AtomicFile> theirs(path);
  const std::string held = fs::directory_iterator(directory.file(""))->path().string();
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ::waitpid(gone, nullptr, 0);
  fs::rename(held, held.substr(0, held.rfind('@') + 1) + std::to_string(gone) + "-0");
  check_file_can_be_written(path);
  EXPECT_EQ(directory.entries(), 1u);
  theirs.reset();
  check_file_can_be_written(path);
  EXPECT_EQ(directory.entries(), 0u);
}

TEST(AtomicFile, FollowsLinks) {
  const ScratchDirectory directory;
  fs::create_directory(directory.file("elsewhere"));
  fs::create_symlink("elsewhere/real", directory.file("link"));
  write_text(directory.file("link"), "content");
  EXPECT_TRUE(fs::is_symlink(directory.file("link")));
  EXPECT_EQ(read_text(directory.file("elsewhere/real")), "content");
  fs::create_symlink("loop", directory.file("loop"));
  EXPECT_NE(error_of(directory.file("loop")).find("cannot follow the link"), std::string::npos);
}

TEST(AtomicFile, CheckLeavesNothingBehind) {
  const ScratchDirectory directory;
  check_file_can_be_written(directory.file("out.bin"));
  EXPECT_EQ(directory.entries(), 0u);
  write_text(directory.file("out.bin"), "old");
  check_file_can_be_written(directory.file("out.bin"));
  EXPECT_EQ(read_text(directory.file("out.bin")), "old");
}

TEST(AtomicFile, NameWithoutDirectoryAndLongName) {
  const ScratchDirectory directory;
  EXPECT_THROW(check_file_can_be_written(""), IoError);
  // File names may have 255 bytes; temporary names must not exceed that.
  write_text(directory.file(std::string(250, 'n')), "x");
  EXPECT_EQ(directory.entries(), 1u);
}

}  // namespace
}  // namespace nephroid
