// "Did you mean ...?" for misspelt names, and words in small letters. It must not know what is
// named.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nephroid {

/// With the letters A to Z small.
std::string lower_case(std::string_view word);

/// `, did you mean "X"?` for a candidate. It is another name of `word` (other_names.h; `kind` is
/// the kind of the named thing, such as "light"), or else the nearest by edit distance, ignoring
/// case. Empty if none is near. The first of equally near candidates wins.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         std::string_view kind = {});

}  // namespace nephroid
