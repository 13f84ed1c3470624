// The measured spectra and the sRGB coefficients that are linked into the program, by name. Their
// file is written by tools/tables/make_tables.cpp, which includes this header for the layout. It
// must not know what the tables mean.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace nephroid {

/// A named table: `columns` runs of `rows` floats each.
struct DataTable {
  std::string_view name;
  int rows = 0;
  int columns = 0;
  const float* values = nullptr;
  std::span<const float> column(int i) const {
    return {values + static_cast<std::size_t>(i) * rows, static_cast<std::size_t>(rows)};
  }
};

/// All tables, sorted by name:
///   "cie"                   x, y, z at 360, 361, ..., 830 nm
///   "daylight"              S0, S1, S2 at the same wavelengths
///   "illuminant-NAME"       power at the same wavelengths, scaled so that the integral of power
///                           times y is kCieYIntegral
///   "metal-NAME"            wavelength (nm), eta, k; both ends of the range continued
///   "glass-NAME"            wavelength (nm), eta; likewise
///   "srgb-nodes", "srgb"    SigmoidTable::nodes and ::coefficients of sRGB under D65
std::vector<DataTable> data_tables();

/// The table `name`. Throws std::logic_error if there is none: a fault of the build.
DataTable data_table(std::string_view name);

/// Layout of the file: a DataHeader, `count` DataEntry, then floats at the given offsets from the
/// start, in bytes.
struct DataHeader {
  std::int32_t count;
};
struct DataEntry {
  char name[24];  // ends with 0
  std::int32_t rows, columns, offset;
};

}  // namespace nephroid
