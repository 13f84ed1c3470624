#include "session/checkpoint/pass_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <limits>
#include <string_view>

namespace nephroid {
namespace {

/// Removes the number at the beginning of `text` and returns it; empty if there is none.
std::optional<uint32_t> take_number(std::string_view& text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(end - text.data());
  return value;
}

bool take(std::string_view& text, std::string_view what) {
  if (!text.starts_with(what)) return false;
  text.remove_prefix(what.size());
  return true;
}

}  // namespace

std::optional<PassRanges> PassRanges::parse(const std::string& text) {
  PassRanges result;
  std::string_view rest = text;
  if (rest.empty()) return result;
  do {
    const auto first = take_number(rest);
    if (!first || !take(rest, "..")) return std::nullopt;
    const auto last = take_number(rest);
    // The greatest number is not a pass, so that passes can be counted.
    if (!last || *last < *first || *last == std::numeric_limits<uint32_t>::max())
      return std::nullopt;
    if (!result.empty() && *first <= result.ranges_.back().last) return std::nullopt;
    result.ranges_.push_back({*first, *last});
  } while (take(rest, ","));
  result.join();
  if (!rest.empty()) return std::nullopt;
  return result;
}

std::string PassRanges::text() const {
  std::string text;
  for (const PassRange& r : ranges_)
    text += fmt::format("{}{}..{}", text.empty() ? "" : ",", r.first, r.last);
  return text;
}

uint64_t PassRanges::count() const {
  uint64_t sum = 0;
  for (const PassRange& r : ranges_) sum += uint64_t{r.last} - r.first + 1;
  return sum;
}

uint64_t PassRanges::count(PassRange within) const {
  uint64_t sum = 0;
  for (const PassRange& r : ranges_) {
    const uint32_t first = std::max(r.first, within.first), last = std::min(r.last, within.last);
    if (first <= last) sum += uint64_t{last} - first + 1;
  }
  return sum;
}

bool PassRanges::contains(uint32_t pass) const {
  return std::any_of(ranges_.begin(), ranges_.end(),
                     [&](const PassRange& r) { return r.first <= pass && pass <= r.last; });
}

uint32_t PassRanges::first_missing(uint32_t from) const {
  for (const PassRange& r : ranges_) {
    if (from < r.first) return from;
    if (from > r.last) continue;
    from = r.last + 1;
  }
  return from;
}

std::optional<PassRange> PassRanges::overlap(const PassRanges& other) const {
  // Both are sorted, so they are compared in parallel.
  auto a = ranges_.begin(), b = other.ranges_.begin();
  while (a != ranges_.end() && b != other.ranges_.end()) {
    if (a->first <= b->last && b->first <= a->last)
      return PassRange{std::max(a->first, b->first), std::min(a->last, b->last)};
    ++(a->last < b->last ? a : b);
  }
  return std::nullopt;
}

void PassRanges::add(uint32_t pass) {
  assert(!contains(pass));
  ranges_.push_back({pass, pass});
  join();
}

void PassRanges::add(const PassRanges& other) {
  assert(!overlap(other));
  ranges_.insert(ranges_.end(), other.ranges_.begin(), other.ranges_.end());
  join();
}

void PassRanges::join() {
  std::sort(ranges_.begin(), ranges_.end(),
            [](const PassRange& a, const PassRange& b) { return a.first < b.first; });
  std::vector<PassRange> joined;
  for (const PassRange& r : ranges_)
    if (!joined.empty() && joined.back().last + uint64_t{1} == r.first)
      joined.back().last = r.last;
    else
      joined.push_back(r);
  ranges_ = std::move(joined);
}

}  // namespace nephroid
