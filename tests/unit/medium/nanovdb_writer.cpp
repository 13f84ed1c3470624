// Small NanoVDB files, see nanovdb_writer.h.
#include "unit/medium/nanovdb_writer.h"

#define NANOVDB_USE_ZIP
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

namespace nephroid::testing_medium {

namespace {

template <class T>
nanovdb::GridHandle<> build(const VoxelBox& box) {
  nanovdb::GridBuilder<T> builder(
      T(box.background), box.fog ? nanovdb::GridClass::FogVolume : nanovdb::GridClass::LevelSet);
  builder([&](const nanovdb::Coord& c) { return T(box.value(c[0], c[1], c[2])); },
          nanovdb::CoordBBox({box.first[0], box.first[1], box.first[2]},
                             {box.last[0], box.last[1], box.last[2]}));
  return builder.template getHandle<>(
      box.voxel_size, nanovdb::Vec3d(box.origin[0], box.origin[1], box.origin[2]), box.name);
}

}  // namespace

void write_nanovdb(const std::string& path, const std::vector<VoxelBox>& grids, bool zip) {
  std::vector<nanovdb::GridHandle<>> handles;
  for (const VoxelBox& box : grids)
    handles.push_back(box.doubles ? build<double>(box) : build<float>(box));
  nanovdb::io::writeGrids(path, handles, zip ? nanovdb::io::Codec::ZIP : nanovdb::io::Codec::NONE);
}

}  // namespace nephroid::testing_medium
