// The goniometric light: a point whose intensity over directions is a measured diagram, an
// equal-area octahedral map that is constant within each pixel. Directions are sampled in
// proportion to it.
#include "core/equal_area_map.h"
#include "scene/light/light_table.h"
#include "scene/light/piecewise_constant_2d.h"
#include "scene/light/point_emitter.h"

namespace nephroid {

namespace {

class GoniometricLight final : public PointEmitter {
 public:
  /// `diagram` holds size x size factors of the intensity; +z of the local frame is the centre.
  GoniometricLight(const Transform& local_to_world, const EmissionSpectrum& intensity,
                   std::vector<float> diagram, int size)
      : PointEmitter(local_to_world),
        size_(size),
        intensity_(intensity),
        diagram_(diagram),
        distribution_(std::move(diagram), size, size) {
    bounds_.power = kPi * mean_intensity();
  }

  std::optional<EmissionSample> sample_emission(const Vec2f&, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    const auto s = distribution_.sample(u_direction);
    if (!s) return std::nullopt;
    return emission(equal_area_square_to_sphere(s->point), s->pdf * kInv4Pi,
                    intensity_.sample(lambda) * factor(s->x, s->y));
  }

  float power() const override { return 4.0f * kPi * mean_intensity(); }

 private:
  SampledSpectrum intensity(const Vec3f& local, const SampledWavelengths& lambda) const override {
    const Vec2f st = equal_area_sphere_to_square(local) * static_cast<float>(size_);
    return intensity_.sample(lambda) * factor(std::min(static_cast<int>(st.x), size_ - 1),
                                              std::min(static_cast<int>(st.y), size_ - 1));
  }
  float direction_pdf(const Vec3f& local) const override {
    const Vec2f st = equal_area_sphere_to_square(local) * static_cast<float>(size_);
    return distribution_.pdf(std::min(static_cast<int>(st.x), size_ - 1),
                             std::min(static_cast<int>(st.y), size_ - 1)) *
           kInv4Pi;
  }
  float factor(int x, int y) const { return diagram_[static_cast<size_t>(y) * size_ + x]; }
  float mean_intensity() const {
    return intensity_.mean() * static_cast<float>(distribution_.mean());
  }

  int size_;
  EmissionSpectrum intensity_;
  std::vector<float> diagram_;
  PiecewiseConstant2D distribution_;
};

}  // namespace

LightPtr make_goniometric_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  const EmissionColor e = read_emission(p, "I", scope.files, scope.color_space);
  int size = 1;
  std::vector<float> diagram = {1.0f};
  if (p.get_string("filename", "").empty()) {
    scope.diagnostics.warn(description.where,
                           "the goniometric light has no \"filename\", so it shines equally in all "
                           "directions");
  } else {
    const ImagePtr image = read_sphere_image(p, scope.files, "a goniometric light");
    size = image->width();
    diagram.clear();
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        diagram.push_back(positive_mean(image->texel(x, y, WrapMode::kClamp)));
  }
  float scale = e.scale;
  const float power = p.get_float("power", -1.0f);
  if (power > 0.0f) {
    double sum = 0.0;
    for (const float v : diagram) sum += v;
    const double per_intensity = 4.0 * kPi * sum / static_cast<double>(diagram.size());
    scale = scale_to(*p.find("power"), power, per_intensity, scale);
  }
  // The map's pole is the y axis of the light's frame.
  const Transform swap_y_and_z(Mat44d(1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1));
  return std::make_unique<GoniometricLight>(swap_y_and_z * Transform(description.transform.start),
                                            EmissionSpectrum(*e.spectrum, scale),
                                            std::move(diagram), size);
}

}  // namespace nephroid
