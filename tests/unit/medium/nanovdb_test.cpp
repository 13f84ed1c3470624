// Media from NanoVDB files: values, placement, majorants, and bad files.
#include <fstream>
#include <sstream>

#include "unit/film/scratch_directory.h"
#include "unit/medium/medium_fixture.h"
#include "unit/medium/nanovdb_writer.h"

namespace nephroid::testing_medium {
namespace {

const std::string kGrey =
    "\"spectrum sigma_a\" [ 200 1 900 1 ] \"spectrum sigma_s\" [ 200 2 900 2 ] ";

float wave(int x, int y, int z) {
  return 0.5f + 0.5f * std::sin(0.7f * float(x) + 0.3f * float(y) - 0.9f * float(z));
}
VoxelBox density_box() {
  return {.name = "density",
          .first = {-5, 2, 0},
          .last = {9, 13, 20},
          .value = wave,
          .voxel_size = 0.25,
          .origin = {1, 2, 3}};
}
MediumPtr read(const std::string& path, const std::string& more = "",
               const std::string& transform = "") {
  return medium_of("nanovdb", kGrey + "\"string filename\" \"" + path + "\" " + more, transform);
}
std::string file_message(const std::string& path, const std::string& more = "") {
  try {
    read(path, more);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}
std::string bytes_of(const std::string& path) {
  std::ostringstream s;
  s << std::ifstream(path, std::ios::binary).rdbuf();
  return s.str();
}
void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(NanoVdb, VoxelsLieAtIntegerPositionsOfTheGrid) {
  ScratchDirectory scratch;
  for (const bool zip : {false, true}) {
    const std::string path = scratch.file("a.nvdb");
    write_nanovdb(path, {density_box()}, zip);
    const MediumPtr m = read(path, "", "Translate 10 0 0");
    const auto at = [&](float x, float y, float z) {
      return m->at({11 + 0.25f * x, 2 + 0.25f * y, 3 + 0.25f * z}, test_wavelengths());
    };
    EXPECT_NEAR(at(3, 4, 5).sigma_a[0], wave(3, 4, 5), 1e-5f);
    EXPECT_NEAR(at(3, 4, 5).sigma_s[0], 2 * wave(3, 4, 5), 1e-5f);
    EXPECT_NEAR(at(-5, 13, 20).sigma_a[0], wave(-5, 13, 20), 1e-5f);
    EXPECT_NEAR(at(3.5f, 4, 5).sigma_a[0], 0.5f * (wave(3, 4, 5) + wave(4, 4, 5)), 1e-5f);
    EXPECT_NEAR(at(3, 4.25f, 5).sigma_a[0], 0.75f * wave(3, 4, 5) + 0.25f * wave(3, 5, 5), 1e-5f);
    EXPECT_EQ(at(-100, 4, 5).sigma_a[0], 0);
    EXPECT_FALSE(m->is_emissive());
  }
}

TEST(NanoVdb, TemperaturesGlow) {
  ScratchDirectory scratch;
  const std::string path = scratch.file("a.nvdb");
  VoxelBox heat{.name = "heat",
                .first = {0, 3, 1},
                .last = {7, 12, 30},
                .value = [](int, int, int) { return 15.0f; },
                .voxel_size = 0.25,
                .origin = {1, 2, 3}};
  write_nanovdb(path, {heat, density_box()});
  const MediumPtr m = read(path,
                           "\"string temperaturename\" \"heat\" \"float Lescale\" 3 "
                           "\"float temperatureoffset\" 5 \"float temperaturescale\" 300");
  EXPECT_TRUE(m->is_emissive());
  const auto lambda = test_wavelengths();
  const Vec3f inside(1 + 0.25f * 4, 2 + 0.25f * 5, 3 + 0.25f * 6);
  EXPECT_NEAR(m->at(inside, lambda).le[2], 3 * sample_blackbody(3000, lambda)[2], 1e-5f);
  // Hot but empty, and dense but cold.
  EXPECT_TRUE(m->at({2, 3.25f, 3 + 0.25f * 28}, lambda).le.is_black());
  EXPECT_TRUE(m->at({0, 3.25f, 4}, lambda).le.is_black());
  EXPECT_FALSE(m->at({0, 3.25f, 4}, lambda).sigma_a.is_black());
  // The ray passes through both boxes.
  auto pieces = m->majorants({{2, 3.25f, 0}, {0, 0, 1}, kInfinity, 0}, kInfinity, lambda);
  float end = 0;
  while (const auto s = pieces.next()) end = s->t_max;
  EXPECT_NEAR(end, 3 + 0.25f * 31, 1e-4f);
}

TEST(NanoVdb, MajorantsBoundEvenInactiveValues) {
  ScratchDirectory scratch;
  const std::string path = scratch.file("a.nvdb");
  VoxelBox sparse = density_box();
  sparse.last = {60, 70, 50};  // more voxels than cells along an axis, and tiles
  sparse.value = [](int x, int y, int z) {
    if (x > 20 && y > 20) return 0.25f;
    return (x * 7 + y * 3 + z) % 11 == 0 ? wave(x, y, z) : 0.0f;
  };
  for (const float background : {0.0f, 0.1f}) {
    sparse.background = background;
    write_nanovdb(path, {sparse});
    const MediumPtr m = read(path, "", kUneven);
    TestRandom random(4);
    int met = 0;
    for (int n = 0; n < 1500; ++n) {
      const Ray ray = random_ray(random, {10, 3, 15}, 40);
      auto pieces = m->majorants(ray, kInfinity, test_wavelengths());
      while (const auto s = pieces.next())
        for (int i = 0; i < 10; ++i) {
          const float t = s->t_min + (s->t_max - s->t_min) * random.next();
          const MediumProperties p = m->at(ray.o + ray.d * t, test_wavelengths());
          ASSERT_LE(p.sigma_a[0] + p.sigma_s[0], s->sigma_maj[0] * (1 + 1e-6f));
          met += p.sigma_a[0] > 0;
        }
    }
    EXPECT_GT(met, 500);
  }
}

TEST(NanoVdb, SaysWhatIsWrongWithAFile) {
  ScratchDirectory scratch;
  const std::string path = scratch.file("a.nvdb");
  const auto expect = [&](const std::string& found, const std::string& what) {
    EXPECT_NE(found.find(what), std::string::npos)
        << "message: " << found << "\nexpected: " << what;
    EXPECT_NE(found.find("t.pbrt:2:"), std::string::npos) << found;
  };
  expect(file_message(scratch.file("none.nvdb")), "none.nvdb");
  write_bytes(path, "");
  expect(file_message(path), "is empty");
  write_bytes(path, "a text that is longer than a header is");
  expect(file_message(path), "does not begin with the magic number of NanoVDB");
  write_nanovdb(path, {density_box()});
  expect(file_message(path, "\"string gridname\" \"smoke\""), "has no grid \"smoke\"");
  std::string version = bytes_of(path);
  version[11] = 0x03;
  write_bytes(path, version);
  expect(file_message(path), "of the format, expected 32");
  VoxelBox box = density_box();
  box.doubles = true;
  write_nanovdb(path, {box});
  expect(file_message(path), "has values of another type, expected float");
  box = density_box();
  box.fog = false;
  write_nanovdb(path, {box});
  expect(file_message(path), "is of another class, expected a fog volume");
  box = density_box();
  box.value = [](int x, int, int) { return x == 3 ? kInfinity : 1.0f; };
  write_nanovdb(path, {box});
  expect(file_message(path), "infinite or not a number");
}

TEST(NanoVdb, BrokenFilesAreErrorsAndNeverCrashes) {
  ScratchDirectory scratch;
  const std::string path = scratch.file("a.nvdb"), broken = scratch.file("b.nvdb");
  for (const bool zip : {false, true}) {
    VoxelBox box = density_box();
    box.last = {3, 9, 7};
    write_nanovdb(path, {box}, zip);
    const std::string whole = bytes_of(path);
    ASSERT_FALSE(whole.empty());
    int refused = 0;
    TestRandom random(8);
    constexpr int kTries = 60;
    for (int n = 0; n < kTries; ++n) {
      std::string bytes = whole;
      if (n % 4 == 0) {
        bytes.resize(static_cast<size_t>(random.next() * static_cast<float>(whole.size())));
      } else {
        // Mostly in the headers, which hold sizes and offsets.
        const float reach = n % 4 == 1 ? static_cast<float>(whole.size()) : 1100.0f;
        for (int k = 0; k < 6; ++k)
          bytes[static_cast<size_t>(random.next() * reach) % bytes.size()] =
              static_cast<char>(random.next() * 256);
      }
      write_bytes(broken, bytes);
      try {
        const MediumPtr m = read(broken);
        m->at({1, 3, 4}, test_wavelengths());
      } catch (const SceneError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, kTries / 4);
  }
}

}  // namespace
}  // namespace nephroid::testing_medium
