// Other names first, then the nearest name by edit distance (Levenshtein 1966).
#include "input/spelling.h"

#include <algorithm>
#include <cctype>
#include <numeric>

#include "input/other_names.h"

namespace nephroid {
namespace {

size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                         std::string_view kind) {
  const std::string other = other_name(word, candidates, kind);
  if (!other.empty()) return ", did you mean " + other + "?";
  // A third of the letters may be wrong; very long words are not treated as typing errors.
  constexpr size_t kLongestWord = 64;
  if (word.empty() || word.size() > kLongestWord) return {};
  const std::string wanted = lower_case(word);
  const std::string* best = nullptr;
  size_t best_distance = std::max<size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.empty() || candidate.size() > kLongestWord) continue;
    const size_t distance = edit_distance(wanted, lower_case(candidate));
    if (distance < best_distance) {
      best = &candidate;
      best_distance = distance;
    }
  }
  return best ? ", did you mean \"" + *best + "\"?" : std::string();
}

}  // namespace nephroid
