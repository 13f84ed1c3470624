// Reads a file of measured reflection into a MeasuredBrdf, and caches the surfaces that were read.
// It must not know lobes or textures. Format: the ".bsdf" files of Dupuy & Jakob 2018, as pbrt-v4
// reads them.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "input/tensor_file.h"
#include "scene/bsdf/measured.h"

namespace nephroid {

/// The surface that a file describes. Throws SceneError with the file, the field and what was
/// expected, if a field is missing or its type, shape or numbers are wrong.
MeasuredBrdf measured_brdf_from(const TensorFile& file);

/// Surfaces by file, shared by all materials that name the same file.
class MeasuredCache {
 public:
  /// Throws the errors of TensorFile::read and measured_brdf_from.
  std::shared_ptr<const MeasuredBrdf> get(SceneFiles& files, const std::string& path,
                                          const SourceLocation& wanted_by);

 private:
  std::map<std::string, std::shared_ptr<const MeasuredBrdf>> surfaces_;
};

}  // namespace nephroid
