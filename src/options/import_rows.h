// The options about scene files, which all commands with a scene share. It must not know commands.
#pragma once

#include <vector>

#include "options/options.h"

namespace nephroid {

/// The rows for a command of the table. They fill CommandLine::import.
std::vector<OptionDescription> import_rows(const char* command);

}  // namespace nephroid
