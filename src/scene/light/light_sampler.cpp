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
/// Visibility of more infinite lights than this is not learned one by one.
constexpr size_t kMaxLearnedGroups = 16;
/// The group of all lights that are not infinite.
constexpr int kBounded = -1;

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
    group_of.assign(lights.size(), kBounded);
    for (size_t i = 0; i < infinite.size(); ++i) group_of[infinite[i]] = static_cast<int>(i);
    group_count = infinite.size() + (items.empty() ? 0 : 1);
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
  /// `shares` are those of the few lights' slots, or null.
  FewImportances few_importances(const Vec3f& p, const Vec3f& n, const float* shares) const {
    FewImportances w;
    for (int i = 0; i < few_count; ++i) w.sum += w.of[i] = few[i].importance(p, n);
    if (!shares || !(w.sum > 0.0)) return w;
    double arrives = 0.0;
    for (int i = 0; i < few_count; ++i) arrives += w.of[i] * shares[i];
    if (!(arrives > 0.0)) return w;
    FewImportances learned{.of = {}, .sum = 1.0};
    for (int i = 0; i < few_count; ++i)
      learned.of[i] = learned_probability(w.of[i], shares[i], w.sum, arrives);
    return learned;
  }
  FewImportances few_importances_along(const Ray& ray, float t_max) const {
    FewImportances w;
    for (int i = 0; i < few_count; ++i) w.sum += w.of[i] = few[i].importance_along(ray, t_max);
    return w;
  }

  /// What was learned at a point; null if nothing was.
  const float* shares_at(const Vec3f& p, const Vec3f& n) const {
    const bool has_normal = n.x != 0.0f || n.y != 0.0f || n.z != 0.0f;
    return has_normal && !visibility.empty() ? visibility.at(p) : nullptr;
  }
  /// Slots begin with those of the groups, that of the bounded lights last.
  size_t group_slots() const { return group_count <= kMaxLearnedGroups ? group_count : 0; }
  const float* shares_of_bounded(const float* shares) const {
    return shares ? shares + group_slots() : nullptr;
  }
  /// Brightness of a group, for choosing among groups. The squares of light from an infinite light
  /// are averaged, as its samples differ from each other.
  double brightness(size_t group, const float* shares) const {
    return group < infinite.size() ? std::sqrt(shares[group]) : shares[group];
  }
  double brightness_of_all(const float* shares) const {
    double sum = 0.0;
    for (size_t i = 0; i < group_count; ++i) sum += brightness(i, shares);
    return sum;
  }
  double group_probability(size_t group, const float* shares, double brightness_of_all) const {
    return learned_probability(1.0, brightness(group, shares), static_cast<double>(group_count),
                               brightness_of_all);
  }
  double group_probability(size_t group, const float* shares) const {
    if (!learns_groups(shares)) return 1.0 / static_cast<double>(group_count);
    return group_probability(group, shares, brightness_of_all(shares));
  }
  bool learns_groups(const float* shares) const { return shares && group_slots() > 1; }
  struct GroupChoice {
    size_t group = 0;
    double probability = 1;
    double rest = 0;  ///< what is left of the random number, in [0,1)
  };
  /// Samples a group by `u` in [0,1).
  GroupChoice choose_group(double u, const float* shares) const {
    GroupChoice choice;
    if (learns_groups(shares)) {
      const double all = brightness_of_all(shares);
      for (;; ++choice.group) {
        choice.probability = group_probability(choice.group, shares, all);
        if (u < choice.probability || choice.group + 1 == group_count) break;
        u -= choice.probability;
      }
      choice.rest = u / choice.probability;
    } else {
      const auto count = static_cast<double>(group_count);
      choice.group = std::min(static_cast<size_t>(u * count), group_count - 1);
      choice.probability = 1.0 / count;
      choice.rest = u * count - static_cast<double>(choice.group);
    }
    choice.rest = std::min(choice.rest, 1.0 - 0x1p-53);
    return choice;
  }

  std::vector<int> infinite;
  std::vector<int> group_of;  ///< [light] index in `infinite`, or kBounded
  size_t group_count = 0;     ///< infinite lights, and one for all bounded lights
  LightVisibility visibility;
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
  if (d.group_count == 0) return std::nullopt;
  const float* shares = d.shares_at(p, n);
  const Impl::GroupChoice group = d.choose_group(refine(u, p), shares);
  const double v = group.rest, bounded = group.probability;
  if (group.group < d.infinite.size())
    return LightChoice{d.infinite[group.group], static_cast<float>(group.probability)};
  shares = d.shares_of_bounded(shares);
  if (d.tree) {
    const auto choice = d.tree->sample(p, n, v, bounded, shares);
    if (!choice) return std::nullopt;
    return LightChoice{choice->light, static_cast<float>(choice->probability)};
  }
  const Impl::FewImportances w = d.few_importances(p, n, shares);
  if (!(w.sum > 0.0)) return std::nullopt;
  const int i = w.choose(v * w.sum, d.few_count);
  return LightChoice{d.few_lights[i], static_cast<float>(bounded * (w.of[i] / w.sum))};
}

float LightSampler::pmf(const Vec3f& p, const Vec3f& n, int light) const {
  const Impl& d = *impl_;
  if (light < 0 || light >= static_cast<int>(d.group_of.size())) return 0.0f;
  const float* shares = d.shares_at(p, n);
  const bool is_infinite = d.group_of[light] != kBounded;
  const double of_group =
      d.group_probability(is_infinite ? d.group_of[light] : d.infinite.size(), shares);
  if (is_infinite) return static_cast<float>(of_group);
  shares = d.shares_of_bounded(shares);
  if (d.tree) return static_cast<float>(d.tree->pmf(p, n, light, of_group, shares));
  const Impl::FewImportances w = d.few_importances(p, n, shares);
  if (!(w.sum > 0.0)) return 0.0f;
  for (int i = 0; i < d.few_count; ++i)
    if (d.few_lights[i] == light) return static_cast<float>(of_group * (w.of[i] / w.sum));
  return 0.0f;
}

size_t LightSampler::slot_count() const {
  const Impl& d = *impl_;
  const size_t bounded = d.tree ? d.tree->slot_count() : d.few_count;
  return d.group_slots() > 1 || bounded > 1 ? d.group_slots() + bounded : 0;
}

void LightSampler::survey(const Vec3f& p, const Vec3f& n, float u,
                          const std::function<float(int)>& arrives,
                          std::vector<SlotSample>& samples) const {
  const Impl& d = *impl_;
  const auto slots_of_groups = static_cast<uint32_t>(d.group_slots());
  const auto [group, group_probability, rest] = d.choose_group(refine(u, p), nullptr);
  if (group < d.infinite.size()) {
    const float light = arrives(d.infinite[group]);
    if (slots_of_groups > 0) samples.push_back({static_cast<uint32_t>(group), sqr(light)});
    return;
  }
  float found = 0.0f;
  if (d.tree) {
    std::vector<LightTree::Turn> turns;
    const auto choice = d.tree->survey(p, n, rest, turns);
    if (choice) found = static_cast<float>(arrives(choice->light) / choice->probability);
    for (const LightTree::Turn& turn : turns)
      samples.push_back({slots_of_groups + turn.slot,
                         static_cast<float>(found * turn.probability / turn.importance)});
  } else {
    const Impl::FewImportances w = d.few_importances(p, n, nullptr);
    const auto lights = static_cast<double>(d.few_count);
    const int i = std::min(static_cast<int>(rest * lights), d.few_count - 1);
    if (w.of[i] > 0.0) {
      const float light = arrives(d.few_lights[i]);
      samples.push_back({slots_of_groups + i, static_cast<float>(light / w.of[i])});
      found = static_cast<float>(light * lights);
    }
  }
  if (slots_of_groups > 0) samples.push_back({slots_of_groups - 1, found});
}

void LightSampler::learn(LightVisibility visibility) {
  impl_->visibility = std::move(visibility);
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
