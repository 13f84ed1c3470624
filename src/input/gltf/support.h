// The table of glTF features and extensions: loaded, approximated, ignored or refused. Warnings,
// errors and docs/gltf-support.md are made from it.
#pragma once

#include <span>
#include <string>

#include "input/gltf/document.h"

namespace nephroid::gltf {

enum class FeatureSupport {
  kLoaded,
  kApproximated,  ///< shown nearly right; a warning says so where it matters
  kIgnored,       ///< the picture does not need it, or a warning says what is lost
  kRefused,       ///< an error
};

struct Feature {
  const char* name;  ///< of an extension, or of a part of the format
  FeatureSupport support;
  const char* note;
};

/// Extensions by name; and parts of the format itself.
std::span<const Feature> extension_table();
std::span<const Feature> feature_table();

/// Throws SceneError for an extension in "extensionsRequired" that is unknown or refused, and warns
/// of unknown ones in "extensionsUsed".
void check_extensions(const Document& document);

}  // namespace nephroid::gltf
