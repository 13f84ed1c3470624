// A set of passes as ranges, both ends included. It must not know what a pass is.
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
  /// Parses "0..63,100..199", the format of text(). Empty for anything else, or if the ranges do
  /// not increase.
  static std::optional<PassRanges> parse(const std::string& text);
  std::string text() const;

  /// In increasing order; adjacent ranges are joined.
  const std::vector<PassRange>& ranges() const { return ranges_; }
  bool empty() const { return ranges_.empty(); }
  uint64_t count() const;
  /// Number of passes in the range `within`.
  uint64_t count(PassRange within) const;
  bool contains(uint32_t pass) const;
  /// The lowest missing pass from `from` on. If none is missing, the greatest number, which is not
  /// a pass.
  uint32_t first_missing(uint32_t from) const;
  /// The first common range; empty if there is none.
  std::optional<PassRange> overlap(const PassRanges& other) const;

  /// Adds a pass that it does not contain.
  void add(uint32_t pass);
  /// Adds passes that do not overlap.
  void add(const PassRanges& other);

  bool operator==(const PassRanges&) const = default;

 private:
  void join();
  std::vector<PassRange> ranges_;
};

}  // namespace nephroid
