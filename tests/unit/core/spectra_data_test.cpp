// The embedded tables: all are present, ordered, and contain numbers.
#include "core/spectra_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/color_fit.h"

namespace nephroid {
namespace {

TEST(SpectraData, TablesAreSortedAndFinite) {
  const auto tables = data_tables();
  ASSERT_FALSE(tables.empty());
  EXPECT_TRUE(std::is_sorted(tables.begin(), tables.end(),
                             [](const auto& a, const auto& b) { return a.name < b.name; }));
  for (const DataTable& table : tables)
    for (int c = 0; c < table.columns; ++c)
      for (const float x : table.column(c)) ASSERT_TRUE(std::isfinite(x)) << table.name;
}

TEST(SpectraData, TablesHaveTheirShape) {
  EXPECT_EQ(data_table("cie").rows, kTableNodes);
  EXPECT_EQ(data_table("cie").columns, 3);
  EXPECT_EQ(data_table("illuminant-D65").rows, kTableNodes);
  EXPECT_EQ(data_table("metal-Au").columns, 3);
  EXPECT_EQ(data_table("glass-BK7").columns, 2);
  EXPECT_EQ(data_table("srgb-nodes").rows, kTableResolution);
  EXPECT_EQ(data_table("srgb").rows, 9 * kTableResolution * kTableResolution * kTableResolution);
  EXPECT_THROW(data_table("no-such-table"), std::logic_error);
}

}  // namespace
}  // namespace nephroid
