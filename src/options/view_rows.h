// Options of `nephroid view`.
#pragma once

#include <span>
#include <vector>

#include "options/options.h"

namespace nephroid {

/// Its own options, and those that it has in common with `render`, taken from `table`.
std::vector<OptionDescription> view_rows(std::span<const OptionDescription> table);

}  // namespace nephroid
