// argv -> CommandLine, by the option table. It must not know what commands do.
#pragma once

#include <string>
#include <vector>

#include "options/options.h"

namespace nephroid {

/// Understands the arguments after the program's name. Help, version and the hidden
/// --options-markdown and --scene-support-markdown come back as Action::kPrint with the text.
/// Throws UsageError.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

}  // namespace nephroid
