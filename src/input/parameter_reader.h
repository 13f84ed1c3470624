// Reads lists of parameters, "type name" values ..., from a token stream.
// Called by the directive parser. Knows the types of parameters, but not which parameters exist.
#pragma once

#include <string>
#include <vector>

#include "input/scene_description.h"
#include "input/token_stream.h"

namespace nephroid {

/// Takes all parameters up to the first token that is not a string. `color_space` is the one in
/// force. If a name stands twice the last one counts, with a warning. Throws SceneError for an
/// unknown type, for values that do not fit the type and for a wrong number of values.
std::vector<Parameter> read_parameters(TokenStream& tokens, const std::string& color_space,
                                       Diagnostics& diagnostics);

/// Takes the values behind a declaration, alone or in brackets, into `parameter`, whose type, name
/// and place are set already.
void read_parameter_values(TokenStream& tokens, Parameter& parameter);

}  // namespace nephroid
