// Curves in a plot with two logarithmic axes, as SVG that stands by itself inside a page.
// It must not know what the curves mean.
#pragma once

#include <string>
#include <vector>

#include "bench/fit.h"

namespace nephroid {

struct PlotSeries {
  std::string name;
  size_t style = 0;  ///< colour and marker
  std::vector<CurvePoint> points;
  bool dashed = false;  ///< a line to compare with, without markers
};

/// Points that are not above 0 in both are left out; without any the plot says that it has no data.
std::string svg_log_plot(const std::string& title, const std::string& x_label,
                         const std::string& y_label, const std::vector<PlotSeries>& series);

/// A little sample of a style's line, for legends and tables.
std::string svg_line_sample(size_t style);

/// Marks of an axis from `low` to `high` (both above 0): powers of ten, with their multiples where
/// there are few; `labelled` have a number.
struct LogTick {
  double value = 0;
  bool labelled = false;
};
std::vector<LogTick> log_ticks(double low, double high);

}  // namespace nephroid
