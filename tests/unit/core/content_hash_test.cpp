#include "core/content_hash.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace nephroid {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TEST(ContentHash, IsTheSameWhereverThePiecesAreCut) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += static_cast<char>(i * 37);
  for (size_t a = 0; a <= text.size(); ++a)
    for (size_t b = a; b <= text.size(); ++b) {
      ContentHash hash;
      hash.add(bytes_of(text.substr(0, a)));
      hash.add(bytes_of(text.substr(a, b - a)));
      hash.add(bytes_of(text.substr(b)));
      ASSERT_EQ(hash.value(), hash_of(bytes_of(text))) << a << " " << b;
    }
}

TEST(ContentHash, ChangesWithEveryBitAndWithTheLength) {
  std::set<uint64_t> seen;
  size_t texts = 0;
  for (size_t length = 0; length <= 24; ++length) {
    std::string text(length, '\0');
    seen.insert(hash_of(bytes_of(text)));
    ++texts;
    for (size_t bit = 0; bit < 8 * length; ++bit) {
      text[bit / 8] = static_cast<char>(1 << bit % 8);
      seen.insert(hash_of(bytes_of(text)));
      ++texts;
      text[bit / 8] = 0;
    }
  }
  EXPECT_EQ(seen.size(), texts);
}

}  // namespace
}  // namespace nephroid
