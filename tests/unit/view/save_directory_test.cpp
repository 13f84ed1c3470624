// --save-to: what the page saves goes to a directory, and nothing there is overwritten.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/errors.h"
#include "film/image_io.h"
#include "unit/view/live_scene.h"
#include "unit/view/small_exr.h"
#include "view/answers.h"
#include "view/picture_source.h"
#include "view/saved_file.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class SaveDirectory : public ::testing::Test {
 protected:
  SaveDirectory() { fs::create_directory(saves_); }

  /// The path that an answer names.
  std::string save(const std::string& kind, const std::string& mix = "") {
    const Answer answer = answers_.save({{"kind", kind}, {"mix", mix}}, "");
    EXPECT_EQ(answer.file_name, "") << "it is no download";
    return nlohmann::json::parse(answer.body)["saved"];
  }
  std::string saved(const std::string& name) const { return saves_ + "/" + name; }
  size_t count() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(saves_), {}));
  }

  TemporaryDirectory directory_;
  std::string path_ = directory_.file("cup.exr"), saves_ = directory_.file("saves");
  PictureSource source_{written(path_)};
  Comparisons comparisons_;
  Answers answers_{source_, comparisons_, saves_};

 private:
  static std::string written(const std::string& path) {
    testing_support::write_small_exr(path, testing_support::small_picture({"R", "G", "B"}));
    return path;
  }
};

TEST_F(SaveDirectory, TakesPicturesUnderTheNameOfTheView) {
  EXPECT_EQ(save("exr"), saved("cup.exr"));
  EXPECT_EQ(save("png"), saved("cup.png"));
  EXPECT_EQ(read_picture(saved("cup.exr")).width(), 3);
  EXPECT_EQ(content_of(saved("cup.png")).substr(1, 3), "PNG");
  EXPECT_EQ(count(), 2u) << "no other file is left";
}

TEST_F(SaveDirectory, NamesThatAreTakenGetNumbers) {
  std::ofstream(saved("cup.exr")) << "mine";
  fs::create_directory(saved("cup-2.exr"));
  EXPECT_EQ(save("exr"), saved("cup-3.exr"));
  EXPECT_EQ(save("exr"), saved("cup-4.exr"));
  EXPECT_EQ(content_of(saved("cup.exr")), "mine");
}

TEST_F(SaveDirectory, LinksAreNotFollowed) {
  const std::string outside = directory_.file("outside.exr");
  fs::create_symlink(outside, saved("cup.exr"));
  EXPECT_EQ(save("exr"), saved("cup-2.exr"));
  EXPECT_FALSE(fs::exists(outside));
  std::ofstream(outside) << "mine";
  EXPECT_EQ(save("exr"), saved("cup-3.exr"));
  EXPECT_EQ(content_of(outside), "mine");
}

TEST_F(SaveDirectory, SavesAtTheSameTimeGetNamesOfTheirOwn) {
  constexpr int kThreads = 8, kSavesOfEach = 8;
  const std::string bytes(1000, 'x');
  std::vector<std::set<std::string>> paths(kThreads);
  std::vector<std::thread> threads;
  for (std::set<std::string>& of_thread : paths)
    threads.emplace_back([&] {
      for (int i = 0; i < kSavesOfEach; ++i)
        of_thread.insert(save_new_file(saves_, "a.png", std::as_bytes(std::span(bytes))));
    });
  for (std::thread& thread : threads) thread.join();
  std::set<std::string> all;
  for (std::set<std::string>& of_thread : paths) all.merge(of_thread);
  EXPECT_EQ(all.size(), size_t{kThreads} * kSavesOfEach);
  for (const std::string& path : all) EXPECT_EQ(content_of(path), bytes) << path;
}

TEST_F(SaveDirectory, AFileThatCannotBeWrittenIsAnError) {
  fs::remove_all(saves_);
  EXPECT_THROW(save("exr"), IoError);
  EXPECT_THROW(save_new_file(saves_, "a", {}), IoError);
}

TEST_F(SaveDirectory, OtherKindsAreRefused) {
  EXPECT_THROW(save("jpg"), UsageError);
  EXPECT_THROW(save("scene"), UsageError);
  EXPECT_THROW(save("exr", R"({"caustic":2})"), UsageError);
  EXPECT_EQ(count(), 0u);
}

using LiveSave = testing_support::LiveTest;

TEST_F(LiveSave, TakesTheSceneWithItsCamera) {
  LiveRender live(request());
  ASSERT_TRUE(testing_support::has_picture(live));
  Comparisons comparisons;
  std::filesystem::create_directory(file("saves"));
  Answers answers(live, comparisons, file("saves"));
  answers.save({{"kind", "scene"}}, "");
  const std::string text = content_of(file("saves/scene-view.pbrt"));
  EXPECT_NE(text.find("Include \"scene.pbrt\""), std::string::npos) << text;
  EXPECT_NE(text.find("LookAt"), std::string::npos) << text;
  // The camera goes to the clipboard.
  const Answer camera = answers.save({{"kind", "camera"}}, "");
  EXPECT_NE(camera.body.find("LookAt"), std::string::npos);
  EXPECT_EQ(answers.save({{"kind", "exr"}, {"mix", R"({"diffuse":0.5})"}}, "").status, 200);
  EXPECT_TRUE(std::filesystem::exists(file("saves/scene.exr")));
}

}  // namespace
}  // namespace nephroid
