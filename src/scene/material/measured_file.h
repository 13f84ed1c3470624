// From a file of measured reflection to a MeasuredBrdf, and the surfaces that were read already.
// Who calls it: the material "measured". It must not know lobes or textures.
// Format: the ".bsdf" files of Dupuy & Jakob 2018, as pbrt-v4 reads them.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "input/tensor_file.h"
#include "scene/bsdf/measured.h"

namespace nephroid {

/// The surface that a file describes. Throws SceneError that names the file, the field and what
/// was expected, if one is missing or its type, shape or numbers do not fit.
MeasuredBrdf measured_brdf_from(const TensorFile& file);

/// Surfaces by file, shared by all materials that name the same one.
class MeasuredCache {
 public:
  /// Throws as TensorFile::read and measured_brdf_from.
  std::shared_ptr<const MeasuredBrdf> get(SceneFiles& files, const std::string& path,
                                          const SourceLocation& wanted_by);

 private:
  std::map<std::string, std::shared_ptr<const MeasuredBrdf>> surfaces_;
};

}  // namespace nephroid
