// Decodes frames as a page does.
#pragma once

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace nephroid::testing_support {

/// Header, and the halves of the payload.
struct DecodedFrame {
  nlohmann::json header;
  std::vector<float> values;
};

inline DecodedFrame decode(const std::string& bytes) {
  DecodedFrame decoded;
  EXPECT_EQ(bytes.substr(0, 4), "NPHV");
  uint32_t numbers[2];
  std::memcpy(numbers, bytes.data() + 4, sizeof(numbers));
  EXPECT_EQ(numbers[0], 1u);
  EXPECT_EQ((12 + numbers[1]) % 8, 0u);
  decoded.header = nlohmann::json::parse(bytes.substr(12, numbers[1]));
  for (size_t i = 12 + numbers[1]; i + 1 < bytes.size(); i += 2) {
    uint16_t bits;
    std::memcpy(&bits, bytes.data() + i, 2);
    Imath::half value;
    value.setBits(bits);
    decoded.values.push_back(value);
  }
  return decoded;
}

}  // namespace nephroid::testing_support
