#include "report_page/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report_page/html_text.h"

namespace nephroid {
namespace {

constexpr double kWidth = 560, kHeight = 380;
constexpr double kLeft = 66, kRight = 16, kTop = 34, kBottom = 48;

/// Colours that are distinct for any colour vision (Okabe & Ito), each with a marker.
constexpr std::array<const char*, 8> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#8a6d00", "#56b4e9", "#5b3a8c", "#333333"};
constexpr size_t kMarkers = 4;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Widens the range at both ends, to at least a factor of two.
  void pad() {
    const double room = std::max(std::pow(high / low, 0.04), std::sqrt(2 * low / high));
    low /= room;
    high *= room;
  }
  double position(double value) const { return std::log(value / low) / std::log(high / low); }
};

const char* color_of(size_t style) {
  return kColors[style % kColors.size()];
}

std::string marker(size_t style, double x, double y) {
  const char* color = color_of(style);
  // When the colours repeat, the marker shapes are shifted.
  switch ((style + style / kColors.size()) % kMarkers) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.8\" fill=\"{}\"/>", x, y,
                         color);
    case 1:
      return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"5\" height=\"5\" fill=\"{}\"/>",
                         x - 2.5, y - 2.5, color);
    case 2:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l3.4 6h-6.8z\" fill=\"{}\"/>", x, y - 3.6, color);
    default:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l3.6 3.6l-3.6 3.6l-3.6 -3.6z\" fill=\"{}\"/>", x,
                         y - 3.6, color);
  }
}

/// "0.01", "200", or "10" with a raised exponent.
std::string tick_label(double value) {
  const double exponent = std::floor(std::log10(value) + 1e-9);
  if (exponent >= -3 && exponent <= 3) return fmt::format("{:.4g}", value);
  const int factor = static_cast<int>(std::lround(value / std::pow(10.0, exponent)));
  return (factor == 1 ? std::string() : fmt::format("{}·", factor)) +
         fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{}{}</tspan>", exponent < 0 ? "−" : "",
                     std::abs(static_cast<int>(exponent)));
}

double x_of(const Range& range, double value) {
  return kLeft + range.position(value) * (kWidth - kLeft - kRight);
}
double y_of(const Range& range, double value) {
  return kHeight - kBottom - range.position(value) * (kHeight - kTop - kBottom);
}

std::string grid(const Range& x, const Range& y) {
  std::string svg;
  for (const LogTick& tick : log_ticks(x.low, x.high)) {
    const double at = x_of(x, tick.value);
    svg += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" class=\"{3}\"/>", at, kTop, kHeight - kBottom,
                       tick.labelled ? "grid" : "faint");
    if (tick.labelled)
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", at,
                         kHeight - kBottom + 17, tick_label(tick.value));
  }
  for (const LogTick& tick : log_ticks(y.low, y.high)) {
    const double at = y_of(y, tick.value);
    svg += fmt::format("<path d=\"M{0} {1:.1f}H{2}\" class=\"{3}\"/>", kLeft, at, kWidth - kRight,
                       tick.labelled ? "grid" : "faint");
    if (tick.labelled)
      svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft - 8,
                         at + 4, tick_label(tick.value));
  }
  return svg + fmt::format("<path d=\"M{} {}V{}H{}\" class=\"axis\"/>", kLeft, kTop,
                           kHeight - kBottom, kWidth - kRight);
}

std::string curve(const PlotSeries& series, const Range& x, const Range& y) {
  std::string line, markers;
  for (const CurvePoint& p : series.points) {
    if (!(p.x > 0 && p.y > 0)) continue;
    line += fmt::format("{:.1f},{:.1f} ", x_of(x, p.x), y_of(y, p.y));
    if (!series.dashed) markers += marker(series.style, x_of(x, p.x), y_of(y, p.y));
  }
  return fmt::format(
      "<g><title>{}</title><polyline points=\"{}\" fill=\"none\" stroke=\"{}\" "
      "{}/>{}</g>",
      html_escape(series.name), line, color_of(series.style),
      series.dashed ? "stroke-width=\"1.2\" stroke-dasharray=\"5 4\"" : "stroke-width=\"1.8\"",
      markers);
}

}  // namespace

std::vector<LogTick> log_ticks(double low, double high) {
  const int first = static_cast<int>(std::floor(std::log10(low))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  const auto inside = [&](double v) { return v >= low * 0.999999 && v <= high * 1.000001; };
  // With few decades there is room for numbers between powers of ten.
  const std::vector<std::vector<int>> choices = {{1}, {1, 2, 5}, {1, 2, 3, 4, 5, 6, 7, 8, 9}};
  const auto labelled_by = [&](const std::vector<int>& factors) {
    int count = 0;
    for (int d = first; d <= last; ++d)
      for (const int f : factors) count += inside(f * std::pow(10.0, d));
    return count;
  };
  size_t choice = 0;
  while (choice + 1 < choices.size() && labelled_by(choices[choice]) < 3) ++choice;
  const bool many = std::log10(high / low) > 5;
  std::vector<LogTick> ticks;
  for (int d = first; d <= last; ++d)
    for (int f = 1; f <= (many ? 1 : 9); ++f) {
      const double value = f * std::pow(10.0, d);
      if (!inside(value)) continue;
      const std::vector<int>& factors = choices[choice];
      ticks.push_back({value, std::find(factors.begin(), factors.end(), f) != factors.end()});
    }
  return ticks;
}

std::string svg_log_plot(const std::string& title, const std::string& x_label,
                         const std::string& y_label, const std::vector<PlotSeries>& series) {
  Range x, y;
  for (const PlotSeries& s : series)
    for (const CurvePoint& p : s.points)
      if (p.x > 0 && p.y > 0) {
        x.add(p.x);
        y.add(p.y);
      }
  std::string svg = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
      "<text x=\"{}\" y=\"20\" class=\"title\">{}</text>",
      kWidth, kHeight, html_escape(title), kLeft, html_escape(title));
  if (!(x.high > 0))
    return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">no data</text></svg>",
                             kWidth / 2, kHeight / 2);
  x.pad();
  y.pad();
  svg += grid(x, y);
  for (const PlotSeries& s : series) svg += curve(s, x, y);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                     (kLeft + kWidth - kRight) / 2, kHeight - 10, html_escape(x_label));
  svg += fmt::format(
      "<text transform=\"translate(15 {}) rotate(-90)\" text-anchor=\"middle\">{}</text></svg>",
      (kTop + kHeight - kBottom) / 2, html_escape(y_label));
  return svg;
}

std::string svg_line_sample(size_t style) {
  return fmt::format(
      "<svg class=\"sample\" viewBox=\"0 0 26 12\" aria-hidden=\"true\"><path d=\"M1 6H25\" "
      "stroke=\"{}\" stroke-width=\"1.8\"/>{}</svg>",
      color_of(style), marker(style, 13, 6));
}

}  // namespace nephroid
