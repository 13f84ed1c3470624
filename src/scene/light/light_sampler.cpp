#include "scene/light/light_sampler.h"

#include "scene/light/light_tree.h"

namespace nephroid {

struct LightSampler::Impl {
  std::vector<int> infinite;
  std::vector<char> is_infinite;
  std::unique_ptr<LightTree> tree;
  float infinite_share = 0;    ///< probability of choosing any one infinite light
  std::vector<float> cdf;      ///< of power, by light; the last entry is 1
  std::vector<float> power_p;  ///< probability by power, by light
};

LightSampler::LightSampler(const std::vector<LightPtr>& lights) : impl_(std::make_unique<Impl>()) {
  std::vector<std::pair<int, LightBounds>> bounded;
  std::vector<double> power;
  double total = 0;
  for (size_t i = 0; i < lights.size(); ++i) {
    const std::optional<LightBounds> bounds = lights[i]->bounds();
    impl_->is_infinite.push_back(!bounds);
    if (bounds)
      bounded.emplace_back(static_cast<int>(i), *bounds);
    else
      impl_->infinite.push_back(static_cast<int>(i));
    power.push_back(std::max(0.0, static_cast<double>(lights[i]->power())));
    total += power.back();
  }
  impl_->tree = std::make_unique<LightTree>(bounded, static_cast<int>(lights.size()));
  // Each infinite light counts as much as all of the others together.
  const size_t parts = impl_->infinite.size() + (impl_->tree->empty() ? 0 : 1);
  impl_->infinite_share = parts > 0 ? 1.0f / static_cast<float>(parts) : 0.0f;
  double sum = 0;
  for (const double p : power) {
    sum += p;
    impl_->power_p.push_back(total > 0 ? static_cast<float>(p / total) : 0.0f);
    impl_->cdf.push_back(total > 0 ? static_cast<float>(sum / total) : 0.0f);
  }
}

LightSampler::~LightSampler() = default;
LightSampler::LightSampler(LightSampler&&) noexcept = default;

std::optional<LightChoice> LightSampler::sample(const Vec3f& p, const Vec3f& n, float u) const {
  const float share = impl_->infinite_share;
  const float all_infinite = share * static_cast<float>(impl_->infinite.size());
  if (u < all_infinite) {
    const size_t k = std::min(static_cast<size_t>(u / share), impl_->infinite.size() - 1);
    return LightChoice{impl_->infinite[k], share};
  }
  if (impl_->tree->empty()) return std::nullopt;
  u = std::min((u - all_infinite) / (1 - all_infinite), kOneMinusEpsilon);
  std::optional<LightChoice> choice = impl_->tree->sample(p, n, u);
  if (choice) choice->pdf_p *= 1 - all_infinite;
  return choice;
}

float LightSampler::pmf(const Vec3f& p, const Vec3f& n, int light) const {
  if (impl_->is_infinite[static_cast<size_t>(light)]) return impl_->infinite_share;
  const float all_infinite =
      impl_->infinite_share * static_cast<float>(impl_->infinite.size());
  return impl_->tree->pmf(p, n, light) * (1 - all_infinite);
}

std::optional<LightChoice> LightSampler::sample_by_power(float& u) const {
  const auto it = std::upper_bound(impl_->cdf.begin(), impl_->cdf.end(), u);
  if (it == impl_->cdf.end()) return std::nullopt;
  const size_t i = static_cast<size_t>(it - impl_->cdf.begin());
  const float before = i == 0 ? 0.0f : impl_->cdf[i - 1];
  u = std::clamp((u - before) / (impl_->cdf[i] - before), 0.0f, kOneMinusEpsilon);
  return LightChoice{static_cast<int>(i), impl_->power_p[i]};
}

float LightSampler::pmf_by_power(int light) const {
  return impl_->power_p[static_cast<size_t>(light)];
}

const std::vector<int>& LightSampler::infinite_lights() const { return impl_->infinite; }

}  // namespace nephroid
