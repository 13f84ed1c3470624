// Reads lists of parameters, "type name" values ..., from a token stream. It knows the types of
// parameters; it must not know which parameters exist.
#pragma once

#include <string>
#include <vector>

#include "input/scene_description.h"
#include "input/token_stream.h"

namespace nephroid {

/// Reads all parameters up to the first token that is not a string. `color_space` is the current
/// one. If a name occurs twice, the last one counts, with a warning. Throws SceneError for an
/// unknown type, for values that do not fit the type and for a wrong number of values.
std::vector<Parameter> read_parameters(TokenStream& tokens, const std::string& color_space,
                                       Diagnostics& diagnostics);

/// Reads the values after a declaration, alone or in brackets, into `parameter`, whose type, name
/// and location are already set.
void read_parameter_values(TokenStream& tokens, Parameter& parameter);

}  // namespace nephroid
