// Compares films bit by bit: light, errors, biases and features.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "film/film.h"

namespace nephroid::testing_support {

inline void expect_same_bits(const Film& a, const Film& b, const std::string& what) {
  const PixelBounds& bounds = a.bounds();
  for (int y = bounds.y0; y < bounds.y1; ++y)
    for (int x = bounds.x0; x < bounds.x1; ++x) {
      ASSERT_EQ(a.depth(x, y), b.depth(x, y)) << what << ": depth of pixel " << x << ' ' << y;
      ASSERT_EQ(a.bias(x, y), b.bias(x, y)) << what << ": bias of " << x << ' ' << y;
      ASSERT_EQ(a.bias_error(x, y), b.bias_error(x, y)) << what << ' ' << x << ' ' << y;
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(a.albedo(x, y)[c], b.albedo(x, y)[c]) << what << ": albedo of " << x << ' ' << y;
        ASSERT_EQ(a.normal(x, y)[c], b.normal(x, y)[c]) << what << ": normal of " << x << ' ' << y;
        ASSERT_EQ(a.standard_error(x, y)[c], b.standard_error(x, y)[c])
            << what << ": standard error of " << x << ' ' << y;
      }
      for (int r = 0; r < static_cast<int>(a.layout().routes.size()); ++r) {
        const Rgb u = a.route_value(r, x, y), v = b.route_value(r, x, y);
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(u[c], v[c]) << what << ": pixel " << x << ' ' << y << " route " << r;
      }
      for (int aov = 0; aov < static_cast<int>(a.layout().aovs.size()); ++aov) {
        const Rgb u = a.aov_value(aov, x, y), v = b.aov_value(aov, x, y);
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(u[c], v[c]) << what << ": pixel " << x << ' ' << y << " AOV " << aov;
      }
    }
}

}  // namespace nephroid::testing_support
