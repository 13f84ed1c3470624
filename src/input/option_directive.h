// The directive Option "name" value, with the names and types of pbrt-v4's options. It must not
// know their effects (scene/scene_options.h).
#pragma once

#include <optional>

#include "input/format_rows.h"
#include "input/token_stream.h"

namespace nephroid {

/// All options of the format. Names are in lower case without "-" and "_".
FormatParameters format_options();

/// Reads the arguments of an Option directive. The name is returned in lower case without "-" and
/// "_", as pbrt-v4 compares it. Empty, with a warning, for an unknown name. Throws SceneError for a
/// value of another type.
std::optional<Parameter> read_option(TokenStream& tokens, Diagnostics& diagnostics);

}  // namespace nephroid
