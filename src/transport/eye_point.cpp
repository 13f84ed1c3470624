#include "transport/eye_point.h"

namespace nephroid {

namespace {

/// Printed by tools/choose_dimensions.
constexpr std::array<uint8_t, kEyePathDimensions> kOrder = {
    0,  1,  39, 2,  4,  6,  3,  5,  27, 66, 8,  7,  20, 63, 10, 17, 32, 9,  12, 30, 49, 19, 48, 40,
    84, 18, 21, 83, 59, 55, 52, 23, 28, 51, 60, 80, 65, 91, 92, 29, 34, 31, 62, 77, 94, 36, 11, 13,
    14, 15, 16, 22, 24, 25, 26, 33, 35, 37, 38, 41, 42, 43, 44, 45, 46, 47, 50, 53, 54, 56, 57, 58,
    61, 64, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 78, 79, 81, 82, 85, 86, 87, 88, 89, 90, 93, 95,
};

}  // namespace

int eye_dimension(int d) {
  return kOrder[static_cast<size_t>(d)];
}

SobolPoint eye_point(uint32_t index, int dimensions) {
  return SobolPoint(index, dimensions, kOrder);
}

}  // namespace nephroid
