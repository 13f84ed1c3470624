// Plots curves with two logarithmic axes as self-contained SVG. It must not know what the curves
// mean.
#pragma once

#include <string>
#include <vector>

#include "bench/fit.h"

namespace nephroid {

struct PlotSeries {
  std::string name;
  size_t style = 0;  ///< colour and marker
  std::vector<CurvePoint> points;
  bool dashed = false;  ///< true for a reference line without markers
};

/// A plot of the series. Points that are not above 0 in both coordinates are left out. Without
/// points the plot says that there is no data.
std::string svg_log_plot(const std::string& title, const std::string& x_label,
                         const std::string& y_label, const std::vector<PlotSeries>& series);

/// A small sample of a style's line, for legends and tables.
std::string svg_line_sample(size_t style);

/// A tick of an axis from `low` to `high` (both above 0): powers of ten, with multiples if there
/// are few. `labelled` ticks have a number.
struct LogTick {
  double value = 0;
  bool labelled = false;
};
std::vector<LogTick> log_ticks(double low, double high);

}  // namespace nephroid
