// The directives of a pbrt-v4 scene: where they are allowed and how their arguments are parsed.
// Turns syntax into calls of the scene builder; keeps no state of the scene itself.
#pragma once

#include <vector>

#include "core/errors.h"
#include "input/description_builder.h"
#include "input/pbrt_v3.h"
#include "input/token_stream.h"

namespace nephroid {

/// A directive as in docs/scene-support.md.
struct FormatDirective {
  const char* name;
  const char* arguments;
  const char* note;
};

/// All directives of the format; all are rendered.
std::vector<FormatDirective> format_directives();

/// Reads directives up to the end of the file (and of all it includes) and passes them, upgraded by
/// `v3`, to `builder`. Returns the location of the end. Throws SceneError.
SourceLocation read_directives(TokenStream& tokens, DescriptionBuilder& builder, V3Upgrade& v3,
                               Diagnostics& diagnostics);

}  // namespace nephroid
