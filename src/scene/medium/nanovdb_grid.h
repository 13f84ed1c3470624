// A sparse grid of floats from a NanoVDB file, validated when read: all nodes lie inside the grid's
// bytes and all values are finite, so lookups need no checks. Its .cpp is the only file that
// includes NanoVDB. It must not know what the values mean.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/errors.h"
#include "core/math.h"

namespace nephroid {

class NanoVdbGrid {
 public:
  /// Reads the grid `name` of a file with the bytes `file`. Null if there is no such grid. Throws
  /// SceneError at `where`, naming `path`, if the file is broken or the grid is not a fog volume of
  /// floats.
  static std::unique_ptr<NanoVdbGrid> read(const std::string& file, const std::string& name,
                                           const std::string& path, const SourceLocation& where);
  ~NanoVdbGrid();

  /// Index space to the file's world space, which is medium space.
  const Mat44d& medium_from_index() const;
  /// The box of the active voxels in medium space, as stored in the file; its volume is not zero.
  const Vec3d& medium_min() const;
  const Vec3d& medium_max() const;

  /// The value at a point of index space, trilinear between voxels at integer positions.
  float lookup(const Vec3d& index) const;
  /// The value where no voxel is stored.
  float background() const;

  using BoxVisitor =
      std::function<void(const Imath::V3i& first, const Imath::V3i& last, float value)>;
  /// Calls `visit` with boxes of voxels, both ends included, whose single value is above `least`.
  void visit_values_above(float least, const BoxVisitor& visit) const;

 private:
  struct Impl;
  explicit NanoVdbGrid(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid
