// The table of estimators: complete rows and unique names.
#include "integrator/presets/estimator_table.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "integrator/estimator/estimator.h"

namespace nephroid {
namespace {

TEST(EstimatorTable, HasCompleteRowsWithNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const EstimatorDescriptor* row : estimator_table()) {
    SCOPED_TRACE(row->traits.name);
    EXPECT_NE(std::string(row->traits.name), "");
    EXPECT_NE(std::string(row->traits.help), "");
    EXPECT_TRUE(names.insert(row->traits.name).second);
    EXPECT_NE(row->make, nullptr);
    EXPECT_NE(row->bytes_per_pixel, nullptr);
    EXPECT_NE(row->exposed_pixels, nullptr);
    EXPECT_NE(row->traits.why_never_sampled, nullptr);
    EXPECT_EQ(&descriptor_of({.estimator = &row->traits, .routes = {}, .parts = {}}), row);
  }
}

TEST(EstimatorTable, RefusesAnEstimatorWithoutARow) {
  constexpr EstimatorTraits kOther{.name = "other"};
  EXPECT_THROW(descriptor_of({.estimator = &kOther, .routes = {}, .parts = {}}), std::logic_error);
}

}  // namespace
}  // namespace nephroid
