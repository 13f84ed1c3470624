// Parses argv into a CommandLine by the option table. It must not know what commands do.
#pragma once

#include <string>
#include <vector>

#include "options/options.h"

namespace nephroid {

/// Parses the arguments after the program's name. Help, version and the hidden --options-markdown
/// and --scene-support-markdown are returned as Action::kPrint with their text. Throws UsageError.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

}  // namespace nephroid
