// Writes small NanoVDB files with the library's own builder.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::testing_medium {

/// A dense box of voxels [first, last] with values of a function. The grid is placed by the voxel
/// size and the world position of voxel (0, 0, 0).
struct VoxelBox {
  std::string name;
  std::array<int, 3> first, last;
  std::function<float(int x, int y, int z)> value;
  double voxel_size = 1;
  std::array<double, 3> origin{0, 0, 0};
  bool fog = true;       ///< a fog volume, else a level set
  bool doubles = false;  ///< values of type double
  float background = 0;
};

/// Compressed with zlib if `zip`.
void write_nanovdb(const std::string& path, const std::vector<VoxelBox>& grids, bool zip = false);

}  // namespace nephroid::testing_medium
