// Shapes of aperture stops: they transmit as much light as a round one, are the right way up, and
// know their reach.
#include "scene/camera/aperture_shape.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

double mean_over_square(const ApertureShape& shape) {
  constexpr int kPoints = 512;
  double sum = 0;
  for (int y = 0; y < kPoints; ++y)
    for (int x = 0; x < kPoints; ++x)
      sum +=
          static_cast<double>(shape.at(-1 + 2 * (x + 0.5) / kPoints, -1 + 2 * (y + 0.5) / kPoints));
  return sum / (kPoints * kPoints);
}

std::shared_ptr<const ApertureShape> stop(const std::string& name) {
  SceneFiles files;
  return make_aperture_shape(name, files, {});
}

TEST(ApertureShape, AsBrightAsARoundStop) {
  for (const char* name : {"gaussian", "square", "pentagon", "star"}) {
    const auto shape = stop(name);
    ASSERT_NE(shape, nullptr) << name;
    EXPECT_NEAR(mean_over_square(*shape), kPi / 4, 0.003) << name;
    // Nothing lies beyond the reach, something close to it.
    double furthest = 0;
    for (int y = -200; y <= 200; ++y)
      for (int x = -200; x <= 200; ++x)
        if (shape->at(x / 200.0, y / 200.0) > 0)
          furthest = std::max(furthest, std::hypot(x / 200.0, y / 200.0));
    EXPECT_LE(furthest, shape->reach()) << name;
    EXPECT_GT(furthest, shape->reach() - 0.04) << name;
  }
  EXPECT_EQ(stop(""), nullptr);
  EXPECT_EQ(stop("circular"), nullptr);
  EXPECT_THROW(stop("heart.png"), Error);
}

TEST(ApertureShape, ValuesOfTheBuiltInOnes) {
  const auto square = stop("square");
  EXPECT_NEAR(square->at(0.3, -0.4), kPi, 1e-4);
  EXPECT_EQ(square->at(0.3, -0.6), 0.0f);
  // The pentagon stands on its tip; the star has a tip towards -x.
  const auto pentagon = stop("pentagon");
  EXPECT_GT(pentagon->at(0, -0.75), 0.0f);
  EXPECT_EQ(pentagon->at(0, 0.75), 0.0f);
  const auto star = stop("star");
  EXPECT_GT(star->at(-0.9, 0), 0.0f);
  EXPECT_EQ(star->at(0.9, 0), 0.0f);
  const auto gaussian = stop("gaussian");
  EXPECT_NEAR(gaussian->at(0.5, 0.2) / gaussian->at(0, 0),
              (std::exp(-0.29) - std::exp(-1)) / (1 - std::exp(-1)), 1e-3);
}

TEST(ApertureShape, FirstRowOfAnImageIsTheTop) {
  const Image image(2, 2, 3, Image::Floats{0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0},
                    RgbColorSpace::srgb());
  const ApertureShape shape(image, {});
  EXPECT_NEAR(shape.at(0.5, 0.5), kPi, 1e-5);
  EXPECT_EQ(shape.at(-0.5, 0.5), 0.0f);
  EXPECT_EQ(shape.at(0.5, -0.5), 0.0f);
  EXPECT_THROW(ApertureShape(Image(1, 1, 1, Image::Floats{0}, RgbColorSpace::srgb()), {}),
               SceneError);
  EXPECT_THROW(ApertureShape(Image(1, 1, 1, Image::Floats{-1}, RgbColorSpace::srgb()), {}),
               SceneError);
}

}  // namespace
}  // namespace nephroid
