// Files that the agreement scenes refer to.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/math.h"
#include "measured_ggx.h"

namespace nephroid {

/// A smooth height field, a small colour image and a measured BSDF. Deleted with the object.
class SceneAssets {
 public:
  SceneAssets() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "nephroid-agreement-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw IoError("no temporary directory");
    directory_ = pattern;
    constexpr int kSize = 64;
    std::vector<float> waves, picture;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / kSize,
                    v = (static_cast<float>(y) + 0.5f) / kSize;
        waves.push_back(0.02f * std::sin(12 * kPi * u) * std::sin(8 * kPi * v));
      }
    for (int i = 0; i < 64; ++i)
      for (const int period : {5, 3, 7}) picture.push_back(1.0f + static_cast<float>(i % period));
    write("/waves.pfm", "Pf", kSize, waves);
    write("/picture.pfm", "PF", 8, picture);
    const testing_measured::GgxSurface brushed{0.3f, 0.6f, 9, 1, 7, 24, 10, 2};
    std::ofstream(directory_ + "/brushed.bsdf", std::ios::binary)
        << testing_measured::bsdf_file_of(testing_measured::tables_of(brushed));
  }
  ~SceneAssets() {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }
  SceneAssets(const SceneAssets&) = delete;
  SceneAssets& operator=(const SceneAssets&) = delete;

  const std::string& directory() const { return directory_; }

 private:
  void write(const char* name, const char* kind, int size, const std::vector<float>& values) const {
    std::ofstream out(directory_ + name, std::ios::binary);
    out << kind << "\n" << size << ' ' << size << "\n-1.0\n";
    for (const float v : values) out.write(reinterpret_cast<const char*>(&v), sizeof v);
  }

  std::string directory_;
};

}  // namespace nephroid
