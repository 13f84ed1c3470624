// A sparse grid of floats from a NanoVDB file, checked when read: every node lies inside the grid's
// bytes and every value is finite, so that looking up needs no checks.
// Who calls it: nanovdb_medium.cpp. Its .cpp is the only file that includes NanoVDB. It must not
// know what the values mean.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/errors.h"
#include "core/math.h"

namespace nephroid {

class NanoVdbGrid {
 public:
  /// The grid `name` of a file with the bytes `file`; null if there is none of that name. Throws
  /// SceneError at `where` that names `path` if the file is broken or the grid is no fog volume of
  /// floats.
  static std::unique_ptr<NanoVdbGrid> read(const std::string& file, const std::string& name,
                                           const std::string& path, const SourceLocation& where);
  ~NanoVdbGrid();

  /// Index space to the file's world, which is medium space.
  const Mat44d& medium_from_index() const;
  /// The box of the active voxels in medium space, as the file says; it has a volume.
  const Vec3d& medium_min() const;
  const Vec3d& medium_max() const;

  /// The value at a point of index space, trilinear between the voxels' integer positions.
  float lookup(const Vec3d& index) const;
  /// The value where nothing is stored.
  float background() const;

  using BoxVisitor =
      std::function<void(const Imath::V3i& first, const Imath::V3i& last, float value)>;
  /// Calls `visit` with boxes of voxels, both ends included, that have one value above `least`.
  void visit_values_above(float least, const BoxVisitor& visit) const;

 private:
  struct Impl;
  explicit NanoVdbGrid(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid
