// "Did you mean ...?" for misspelt names.
// Called where the parser reports a name that it does not know. Knows nothing of what is named.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

/// `, did you mean "X"?` for the candidate that `word` is another name of (other_names.h; `kind` is
/// what is named, "light" for example), else for the nearest one (edit distance, letter case
/// ignored), or nothing if none is near. The first of equally near candidates wins.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         std::string_view kind = {});

}  // namespace nephroid
