// Which passes of a render have been done: ranges, both ends included. It must not know what a pass
// is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid {

struct PassRange {
  uint32_t first = 0, last = 0;  ///< first <= last
  bool operator==(const PassRange&) const = default;
};

class PassRanges {
 public:
  PassRanges() = default;
  explicit PassRanges(PassRange range) : ranges_{range} {}
  /// "0..63,100..199", as text() writes it; empty if it is anything else, or if the ranges do not
  /// increase.
  static std::optional<PassRanges> parse(const std::string& text);
  std::string text() const;

  /// In increasing order, none next to another.
  const std::vector<PassRange>& ranges() const { return ranges_; }
  bool empty() const { return ranges_.empty(); }
  uint64_t count() const;
  /// Of those from first to last of `within`.
  uint64_t count(PassRange within) const;
  bool contains(uint32_t pass) const;
  /// The lowest pass from `from` on that is not in it; the greatest number, which is no pass, if
  /// all are.
  uint32_t first_missing(uint32_t from) const;
  /// What both have; empty if nothing.
  std::optional<PassRange> overlap(const PassRanges& other) const;

  /// One that is not in it.
  void add(uint32_t pass);
  /// Others that do not overlap.
  void add(const PassRanges& other);

  bool operator==(const PassRanges&) const = default;

 private:
  void join();
  std::vector<PassRange> ranges_;
};

}  // namespace nephroid
