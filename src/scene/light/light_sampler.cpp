// Choice of a light: a share for each infinite light, and a light tree (or, for a handful, their
// importances) for the others; and the choice by power. See light_sampler.h.
#include "scene/light/light_sampler.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "core/sampler.h"
#include "scene/light/light_tree.h"

namespace nephroid {

namespace {

/// Up to this number of lights, importances are compared one by one.
constexpr int kFew = 4;

/// u with the bits that a float lacks filled from a hash, so that choices among very many lights
/// keep their probabilities.
double refine(float u, const Vec3f& p) {
  const uint64_t bits = hash_combine(std::bit_cast<uint32_t>(u), std::bit_cast<uint32_t>(p.x),
                                     std::bit_cast<uint32_t>(p.y), std::bit_cast<uint32_t>(p.z));
  const double fine = u + static_cast<double>(bits >> 40) * 0x1p-48;
  return std::min(fine, 1.0 - 0x1p-53);
}

}  // namespace

struct LightSampler::Impl {
  explicit Impl(const std::vector<LightPtr>& lights) {
    std::vector<LightTree::Item> items;
    powers.reserve(lights.size());
    for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
      const float power = lights[i]->power();
      // In an enormous scene the power of an infinite light can overflow.
      constexpr float kMaxPower = std::numeric_limits<float>::max();
      powers.push_back(power > 0.0f ? std::min(power, kMaxPower) : 0.0f);
      const auto bounds = lights[i]->bounds();
      if (!bounds)
        infinite.push_back(i);
      else if (bounds->power > 0.0f && std::isfinite(bounds->power) &&
               is_finite(bounds->bounds.min) && is_finite(bounds->bounds.max))
        items.push_back({*bounds, i});
    }
    is_infinite.assign(lights.size(), false);
    for (const int i : infinite) is_infinite[i] = true;
    const int groups = static_cast<int>(infinite.size()) + (items.empty() ? 0 : 1);
    if (groups > 0) infinite_share = 1.0 / groups;
    bounded_share = items.empty() ? 0.0 : infinite_share;
    if (items.size() <= kFew) {
      for (const LightTree::Item& item : items) {
        few_lights[few_count] = item.light;
        few[few_count++] = LightCluster(item.bounds);
      }
    } else {
      tree = std::make_unique<LightTree>(std::move(items), static_cast<int>(lights.size()));
    }
    double total = 0.0;
    for (const float p : powers) total += p;
    double sum = 0.0;
    for (const float p : powers) {
      sum += p;
      cumulative.push_back(total > 0.0 ? sum / total : 0.0);
    }
    total_power = total;
  }

  /// Importances of the few lights, and their sum.
  struct FewImportances {
    std::array<double, kFew> of{};
    double sum = 0.0;
    /// The light that `rest` in [0, sum) chooses.
    int choose(double rest, int count) const {
      int last = 0;
      for (int i = 0; i < count; ++i) {
        if (of[i] == 0.0) continue;
        last = i;
        if (rest < of[i]) break;
        rest -= of[i];
      }
      return last;
    }
  };
  FewImportances few_importances(const Vec3f& p, const Vec3f& n) const {
    FewImportances w;
    for (int i = 0; i < few_count; ++i) w.sum += w.of[i] = few[i].importance(p, n);
    return w;
  }
  FewImportances few_importances_along(const Ray& ray, float t_max) const {
    FewImportances w;
    for (int i = 0; i < few_count; ++i) w.sum += w.of[i] = few[i].importance_along(ray, t_max);
    return w;
  }

  std::vector<int> infinite;
  std::vector<bool> is_infinite;
  double infinite_share = 0.0;  ///< probability of each infinite light
  double bounded_share = 0.0;   ///< probability of all bounded lights together
  std::array<LightCluster, kFew> few;
  std::array<int, kFew> few_lights{};
  int few_count = 0;
  std::unique_ptr<LightTree> tree;  ///< null if there are only a few lights
  std::vector<float> powers;
  std::vector<double> cumulative;  ///< distribution by power, upper ends
  double total_power = 0.0;
};

LightSampler::LightSampler(const std::vector<LightPtr>& lights)
    : impl_(std::make_unique<Impl>(lights)) {}
LightSampler::~LightSampler() = default;
LightSampler::LightSampler(LightSampler&&) noexcept = default;

std::optional<LightChoice> LightSampler::sample(const Vec3f& p, const Vec3f& n, float u) const {
  const Impl& d = *impl_;
  double v = refine(u, p);
  const auto infinite_count = static_cast<double>(d.infinite.size());
  const double all_infinite = infinite_count * d.infinite_share;
  if (d.bounded_share == 0.0 || v < all_infinite) {
    if (d.infinite.empty()) return std::nullopt;
    const auto i = std::min(static_cast<size_t>(v / d.infinite_share), d.infinite.size() - 1);
    return LightChoice{d.infinite[i], static_cast<float>(d.infinite_share)};
  }
  v = std::min((v - all_infinite) / d.bounded_share, 1.0 - 0x1p-53);
  if (d.tree) {
    const auto choice = d.tree->sample(p, n, v, d.bounded_share);
    if (!choice) return std::nullopt;
    return LightChoice{choice->light, static_cast<float>(choice->probability)};
  }
  const Impl::FewImportances w = d.few_importances(p, n);
  if (!(w.sum > 0.0)) return std::nullopt;
  const int i = w.choose(v * w.sum, d.few_count);
  return LightChoice{d.few_lights[i], static_cast<float>(d.bounded_share * (w.of[i] / w.sum))};
}

float LightSampler::pmf(const Vec3f& p, const Vec3f& n, int light) const {
  const Impl& d = *impl_;
  if (light < 0 || light >= static_cast<int>(d.is_infinite.size())) return 0.0f;
  if (d.is_infinite[light]) return static_cast<float>(d.infinite_share);
  if (d.tree) return static_cast<float>(d.tree->pmf(p, n, light, d.bounded_share));
  const Impl::FewImportances w = d.few_importances(p, n);
  if (!(w.sum > 0.0)) return 0.0f;
  for (int i = 0; i < d.few_count; ++i)
    if (d.few_lights[i] == light) return static_cast<float>(d.bounded_share * (w.of[i] / w.sum));
  return 0.0f;
}

std::optional<LightAlong> LightSampler::sample_along(const Ray& ray, float t_max, float u) const {
  const Impl& d = *impl_;
  const double v = refine(u, ray.o);
  if (d.tree) {
    if (!d.tree->shines_along(ray, t_max)) return std::nullopt;
    const auto choice = d.tree->sample_along(ray, t_max, v);
    if (!choice) return LightAlong();
    return LightAlong{choice->light, static_cast<float>(choice->probability),
                      d.tree->leaf(choice->light)->along(ray, t_max)};
  }
  const Impl::FewImportances w = d.few_importances_along(ray, t_max);
  if (!(w.sum > 0.0)) return std::nullopt;
  const int i = w.choose(v * w.sum, d.few_count);
  return LightAlong{d.few_lights[i], static_cast<float>(w.of[i] / w.sum),
                    d.few[i].along(ray, t_max)};
}

std::optional<LightAlong> LightSampler::find_along(const Ray& ray, float t_max, int light) const {
  const Impl& d = *impl_;
  LightAlong found{light, 0, {}};
  if (d.tree) {
    const LightCluster* leaf = d.tree->leaf(light);
    if (leaf == nullptr) return std::nullopt;
    found.pdf_p = static_cast<float>(d.tree->pmf_along(ray, t_max, light));
    found.distances = leaf->along(ray, t_max);
  } else {
    const Impl::FewImportances w = d.few_importances_along(ray, t_max);
    if (!(w.sum > 0.0)) return std::nullopt;
    for (int i = 0; i < d.few_count; ++i) {
      if (d.few_lights[i] != light) continue;
      found.pdf_p = static_cast<float>(w.of[i] / w.sum);
      found.distances = d.few[i].along(ray, t_max);
    }
  }
  if (!(found.pdf_p > 0.0f)) return std::nullopt;
  return found;
}

std::optional<LightChoice> LightSampler::sample_by_power(float& u) const {
  const Impl& d = *impl_;
  if (!(d.total_power > 0.0)) return std::nullopt;
  const auto it =
      std::upper_bound(d.cumulative.begin(), d.cumulative.end(), static_cast<double>(u));
  auto i = std::min<size_t>(it - d.cumulative.begin(), d.cumulative.size() - 1);
  // The last lights can be black; u below 1 never selects one of them.
  while (d.powers[i] == 0.0f) --i;
  const double lower = i > 0 ? d.cumulative[i - 1] : 0.0;
  u = std::clamp(static_cast<float>((u - lower) / (d.cumulative[i] - lower)), 0.0f,
                 kOneMinusEpsilon);
  return LightChoice{static_cast<int>(i), pmf_by_power(static_cast<int>(i))};
}

float LightSampler::pmf_by_power(int light) const {
  if (!(impl_->total_power > 0.0)) return 0.0f;
  return static_cast<float>(impl_->powers[light] / impl_->total_power);
}

const std::vector<int>& LightSampler::infinite_lights() const {
  return impl_->infinite;
}

}  // namespace nephroid
