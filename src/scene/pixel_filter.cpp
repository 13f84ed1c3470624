#include "scene/pixel_filter.h"

namespace nephroid {

namespace {

constexpr int kCells = 128;

using Parameters = std::array<float, 2>;

float box(float, float, const Parameters&) {
  return 1.0f;
}
float triangle(float x, float radius, const Parameters&) {
  return std::max(0.0f, radius - std::abs(x));
}
float gaussian(float x, float radius, const Parameters& p) {
  const auto g = [&](float t) { return std::exp(-t * t / (2 * p[0] * p[0])); };
  return std::max(0.0f, g(x) - g(radius));
}
float mitchell(float x, float radius, const Parameters& p) {
  const float b = p[0], c = p[1];
  const float t = std::abs(2 * x / radius);
  if (t <= 1)
    return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) / 6;
  if (t <= 2)
    return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t +
            (8 * b + 24 * c)) /
           6;
  return 0;
}
float sinc(float x) {
  const float t = kPi * x;
  return std::abs(t) < 1e-4f ? 1.0f : std::sin(t) / t;
}
float windowed_sinc(float x, float radius, const Parameters& p) {
  return std::abs(x) > radius ? 0.0f : sinc(x) * sinc(x / p[0]);
}

struct Row : FormatType {
  float (*function)(float, float, const Parameters&);
  float radius;
};
constexpr FormatParameter kBox[] = {
    {"float", "xradius", "0.5", "pixels"},
    {"float", "yradius", "0.5", "pixels"},
};
constexpr FormatParameter kTriangle[] = {
    {"float", "xradius", "2", "pixels"},
    {"float", "yradius", "2", "pixels"},
};
constexpr FormatParameter kGaussian[] = {
    {"float", "xradius", "1.5", "pixels"},
    {"float", "yradius", "1.5", "pixels"},
    {"float", "sigma", "0.5", "pixels"},
};
constexpr FormatParameter kMitchell[] = {
    {"float", "xradius", "2", "pixels"},
    {"float", "yradius", "2", "pixels"},
    {"float", "B", "1/3"},
    {"float", "C", "1/3"},
};
constexpr FormatParameter kSinc[] = {
    {"float", "xradius", "4", "pixels"},
    {"float", "yradius", "4", "pixels"},
    {"float", "tau", "3"},
};
constexpr Row kTable[] = {
    {{"box", {kBox}}, box, 0.5f},
    {{"triangle", {kTriangle}}, triangle, 2.0f},
    {{"gaussian", {kGaussian}, "the default"}, gaussian, 1.5f},
    {{"mitchell", {kMitchell}}, mitchell, 2.0f},
    {{"sinc", {kSinc}}, windowed_sinc, 4.0f},
};

}  // namespace

PixelFilter::PixelFilter(float (*function)(float, float, const Parameters&), Vec2f radius,
                         Parameters parameters_x, Parameters parameters_y) {
  for (int i = 0; i < 2; ++i) {
    Axis& axis = axes_[i];
    axis.function = function;
    axis.radius = radius[i];
    axis.parameters = i == 0 ? parameters_x : parameters_y;
    axis.integral = 0;
    axis.cdf.assign(kCells + 1, 0.0f);
    // A cell's probability is its mean |f| plus a small amount, so that cells in which the function
    // changes sign are sampled everywhere.
    double total = 0, integral = 0, peak = 0;
    std::vector<double> mass(kCells);
    constexpr int kPoints = 32;
    for (int c = 0; c < kCells; ++c) {
      for (int k = 0; k < kPoints; ++k) {
        const float x = axis.radius *
                        (2 * (static_cast<float>(c * kPoints + k) + 0.5f) / (kCells * kPoints) - 1);
        const double f = axis.value(x);
        mass[c] += std::abs(f) / kPoints;
        integral += f;
      }
      peak = std::max(peak, mass[c]);
    }
    for (double& m : mass) total += (m += function == box ? 0.0 : 1e-4 * peak);
    axis.integral = static_cast<float>(integral * 2 * axis.radius / (kCells * kPoints));
    double sum = 0;
    for (int c = 0; c < kCells; ++c) {
      sum += mass[c] / total;
      axis.cdf[c + 1] = static_cast<float>(sum);
    }
    axis.cdf[kCells] = 1.0f;
  }
}

void PixelFilter::Axis::sample(float u, float* x, float* weight) const {
  const auto it = std::upper_bound(cdf.begin(), cdf.end(), u);
  const auto c = std::clamp<int64_t>(it - cdf.begin() - 1, 0, kCells - 1);
  const float p = cdf[c + 1] - cdf[c];
  const float inside = std::min((u - cdf[c]) / p, kOneMinusEpsilon);
  *x = radius * (2 * (static_cast<float>(c) + inside) / kCells - 1);
  const float pdf = p * kCells / (2 * radius);
  *weight = value(*x) / (integral * pdf);
}

bool PixelFilter::can_be_sampled() const {
  return std::all_of(std::begin(axes_), std::end(axes_), [](const Axis& axis) {
    return axis.integral > 0 && std::isfinite(1 / axis.integral) && axis.cdf[1] >= 0;
  });
}

PixelFilter::Sample PixelFilter::sample(const Vec2f& u) const {
  Sample s;
  // The box is the most common filter and needs no table.
  if (axes_[0].function == box) {
    s.offset = {axes_[0].radius * (2 * u.x - 1), axes_[1].radius * (2 * u.y - 1)};
    return s;
  }
  float wx, wy;
  axes_[0].sample(u.x, &s.offset.x, &wx);
  axes_[1].sample(u.y, &s.offset.y, &wy);
  s.weight = wx * wy;
  return s;
}

float PixelFilter::eval(const Vec2f& offset) const {
  float f = 1;
  for (int i = 0; i < 2; ++i) {
    if (std::abs(offset[i]) > axes_[i].radius) return 0;
    f *= axes_[i].value(offset[i]) / axes_[i].integral;
  }
  return f;
}

std::vector<FormatType> pixel_filter_types() {
  return format_types(kTable);
}

std::unique_ptr<PixelFilter> make_pixel_filter(
    const std::optional<DirectiveDescription>& description, Diagnostics& diagnostics) {
  static const ParameterSet kNone;
  const std::string type = description ? description->type : "gaussian";
  const ParameterSet& p = description ? description->parameters : kNone;
  const Row& row = row_of(kTable, "pixel filter", type, p.where);
  const Vec2f radius(p.get_float("xradius", row.radius), p.get_float("yradius", row.radius));
  constexpr float kLargestRadius = 65536;
  if (!(radius.x > 0 && radius.y > 0 && radius.x <= kLargestRadius && radius.y <= kLargestRadius))
    throw SceneError(p.where, "the filter's radius must be positive and at most 65536 pixels");
  Parameters parameters{0, 0};
  if (type == "gaussian") parameters[0] = p.get_float("sigma", 0.5f);
  if (type == "mitchell") parameters = {p.get_float("B", 1.f / 3), p.get_float("C", 1.f / 3)};
  if (type == "sinc") parameters[0] = p.get_float("tau", 3.0f);
  if (type == "gaussian" && !(parameters[0] > 0))
    throw SceneError(p.where, "\"sigma\" of the gaussian filter must be positive");
  if (description) p.report_unused("pixel filter \"" + type + "\"", row, diagnostics);
  auto filter = std::make_unique<PixelFilter>(row.function, radius, parameters, parameters);
  if (!filter->can_be_sampled())
    throw SceneError(p.where, "the parameters of the pixel filter \"" + type +
                                  "\" make its integral zero or negative, expected a positive one");
  return filter;
}

}  // namespace nephroid
