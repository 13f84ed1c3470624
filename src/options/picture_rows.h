// The rows of the option table for the commands that read pictures: merge, mix and compare.
#pragma once

#include <vector>

#include "options/options.h"

namespace nephroid {

std::vector<OptionDescription> picture_rows();

}  // namespace nephroid
