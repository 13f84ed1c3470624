// Names from other renderers and everyday words, with the names that pbrt-v4 has for the same.
// One table, asked by did_you_mean where an unknown name is reported.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

/// `"eta"` or `"a", "b" or "c"`: what `word` is called among the candidates, letter case ignored.
/// `kind` is what is named, "light" for example: some rows are of one kind only. Empty if the table
/// has nothing.
std::string other_name(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view kind);

}  // namespace nephroid
