// Writes the binary files that the scenes of this folder name: two small images, a measured BSDF
// and a grid of density and temperature. Run by hand to change one: ninja make_feature_assets &&
// bin/make_feature_assets FOLDER. It must not know what the scenes do with them.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "measured_ggx.h"
#include "unit/medium/nanovdb_writer.h"

namespace {

using namespace nephroid;

void write_pfm(const std::string& path, const char* kind, int size,
               const std::vector<float>& values) {
  std::ofstream out(path, std::ios::binary);
  out << kind << "\n" << size << ' ' << size << "\n-1.0\n";
  for (const float v : values) out.write(reinterpret_cast<const char*>(&v), sizeof v);
}

/// Eight by eight pixels: a bright and a dim corner, and colours that distinguish up from right.
void write_picture(const std::string& path) {
  std::vector<float> values;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const bool frame = x == 0 || y == 7;
      const float u = static_cast<float>(x) / 7.0f, v = static_cast<float>(y) / 7.0f;
      values.insert(values.end(),
                    {frame ? 1.5f : u * u, frame ? 1.4f : 0.3f * (u + v), frame ? 0.2f : v * v});
    }
  write_pfm(path, "PF", 8, values);
}

void write_heights(const std::string& path) {
  std::vector<float> values;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const float u = static_cast<float>(2 * x - 15) / 15.0f;
      const float v = static_cast<float>(2 * y - 15) / 15.0f;
      values.push_back(std::cos(5.0f * std::sqrt(u * u + v * v)));
    }
  write_pfm(path, "Pf", 16, values);
}

void write_measured(const std::string& path) {
  const testing_measured::GgxSurface surface{0.2f, 0.2f, 1, 1, 7, 20, 10, 2};
  std::ofstream(path, std::ios::binary)
      << testing_measured::bsdf_file_of(testing_measured::tables_of(surface));
}

/// A ball of smoke with a hot core, 11 voxels across, centred at the origin.
void write_puff(const std::string& path) {
  const auto radius = [](int x, int y, int z) {
    return std::sqrt(static_cast<float>(x * x + y * y + z * z)) / 5.0f;
  };
  testing_medium::VoxelBox density{.name = "density",
                                   .first = {-5, -5, -5},
                                   .last = {5, 5, 5},
                                   .value =
                                       [&](int x, int y, int z) {
                                         const float r = radius(x, y, z);
                                         return r > 1.0f ? 0.0f : 1.0f - 0.6f * r * r;
                                       },
                                   .voxel_size = 0.2};
  testing_medium::VoxelBox heat = density;
  heat.name = "heat";
  heat.value = [&](int x, int y, int z) {
    const float r = radius(x, y - 2, z);
    return r > 0.6f ? 0.0f : 1.0f - r;
  };
  testing_medium::write_nanovdb(path, {density, heat}, true);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: make_feature_assets FOLDER\n", stderr);
    return 2;
  }
  const std::string folder = arguments[1] + std::string("/");
  write_picture(folder + "picture.pfm");
  write_heights(folder + "heights.pfm");
  write_measured(folder + "measured.bsdf");
  write_puff(folder + "puff.nvdb");
}
