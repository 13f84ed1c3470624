// The directive Option "name" value and the options that pbrt-v4 knows.
// Called by the directive parser. Knows names and types; what the options do is elsewhere
// (scene/scene_options.h).
#pragma once

#include <optional>

#include "input/format_rows.h"
#include "input/token_stream.h"

namespace nephroid {

/// All options of the format. Names are in lower case without "-" and "_".
FormatParameters format_options();

/// Takes the arguments of an Option directive. The name comes back in lower case without "-" and
/// "_", as pbrt-v4 compares it. Warns of an unknown name and returns nothing for it; throws
/// SceneError for a value of another type.
std::optional<Parameter> read_option(TokenStream& tokens, Diagnostics& diagnostics);

}  // namespace nephroid
