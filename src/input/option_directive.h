// The directive Option "name" value and the options that pbrt-v4 knows.
// Called by the directive parser. Knows names and types, not what the options do.
#pragma once

#include <optional>

#include "input/scene_description.h"
#include "input/token_stream.h"

namespace nephroid {

/// Takes the arguments of an Option directive. The name comes back in lower case without "-" and
/// "_", as pbrt-v4 compares it. Warns of an unknown name and returns nothing for it; throws
/// SceneError for a value of another type.
std::optional<Parameter> read_option(TokenStream& tokens, Diagnostics& diagnostics);

}  // namespace nephroid
