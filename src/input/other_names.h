// A table of names from other renderers and everyday words, with pbrt-v4's names for the same.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

/// `"eta"` or `"a", "b" or "c"`: the candidates that mean `word`, ignoring case. `kind` is the kind
/// of the named thing, such as "light"; some rows belong to one kind. Empty if there are none.
std::string other_name(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view kind);

}  // namespace nephroid
