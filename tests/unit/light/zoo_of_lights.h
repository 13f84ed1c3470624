// Light samplers of many lights, and a test of their probabilities.
#pragma once

#include "core/warps.h"
#include "scene/light/light_sampler.h"
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {

/// A light with bounds and power only.
class FakeLight final : public Light {
 public:
  FakeLight(const Vec3f& p, float power, const Vec3f& axis = {0, 0, 1}, float cos_o = -1,
            bool two_sided = false) {
    b_.bounds = Bounds3f(p);
    b_.power = power;
    b_.axis = axis;
    b_.cos_theta_o = cos_o;
    b_.two_sided = two_sided;
  }
  std::optional<LightSample> sample_towards(const Vec3f&, const Vec2f&,
                                            const SampledWavelengths&) const override {
    return std::nullopt;
  }
  float pdf_towards(const Vec3f&, const Vec3f&, const Vec3f&, const Vec3f&) const override {
    return 0;
  }
  std::optional<EmissionSample> sample_emission(const Vec2f&, const Vec2f&,
                                                const SampledWavelengths&) const override {
    return std::nullopt;
  }
  EmissionDensity emission_pdf(const Vec3f&, const Vec3f&) const override { return {}; }
  float power() const override { return b_.power; }
  std::optional<LightBounds> bounds() const override { return b_; }

 private:
  LightBounds b_;
};

/// `n` triangles, spots and points in a unit cube, and `infinite` infinite lights.
inline std::vector<LightPtr> zoo(int n, int infinite) {
  TestRandom random(21);
  std::vector<LightPtr> lights;
  for (int i = 0; i < infinite; ++i) lights.push_back(light_of("LightSource \"infinite\""));
  for (int i = 0; i < n; ++i) {
    const Vec3f p(random.next(), random.next(), random.next());
    const auto near = [&] {
      return p + (Vec3f(random.next(), random.next(), random.next()) - Vec3f(0.5f)) * 0.2f;
    };
    const auto text = [](const Vec3f& v) {
      return "[" + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) +
             "]";
    };
    const std::string scale = " \"float scale\" " + std::to_string(0.1f + random.next());
    if (i % 3 == 0) {
      MeshData m;
      m.positions = {p, near(), near()};
      m.triangles = {0, 1, 2};
      lights.push_back(area_light_of(scale + (i % 2 ? "\"bool twosided\" true" : ""),
                                     std::make_shared<TriangleMesh>(m, false)));
    } else if (i % 3 == 1) {
      const char* edge = i % 2 ? " \"float conedeltaangle\" 0" : "";
      lights.push_back(light_of("LightSource \"spot\" \"point3 from\" " + text(p) +
                                "\"point3 to\" " + text(near()) + edge + scale));
    } else {
      lights.push_back(light_of("LightSource \"point\" \"point3 from\" " + text(p) + scale));
    }
  }
  return lights;
}

/// Counts of samples against pmf(). Empty samples must be the missing rest.
inline void expect_frequencies(const LightSampler& sampler, const std::vector<LightPtr>& lights,
                               const Vec3f& p, const Vec3f& n, int count) {
  std::vector<double> observed(lights.size() + 1), expected(lights.size() + 1);
  double sum = 0;
  for (size_t i = 0; i < lights.size(); ++i) {
    const double pmf = sampler.pmf(p, n, static_cast<int>(i));
    sum += pmf;
    expected[i] = count * pmf;
  }
  EXPECT_LE(sum, 1 + 1e-5);
  expected.back() = count * std::max(0.0, 1 - sum);
  TestRandom random(31);
  for (int i = 0; i < count; ++i) {
    const auto choice = sampler.sample(p, n, random.next());
    if (!choice) {
      ++observed.back();
      continue;
    }
    ++observed[choice->light];
    ASSERT_EQ(choice->pdf_p, sampler.pmf(p, n, choice->light));
    ASSERT_GT(choice->pdf_p, 0.0f);
  }
  EXPECT_GT(chi_square_test(observed, expected), 1e-4) << lights.size() << " lights";
}

}  // namespace nephroid::testing_light
