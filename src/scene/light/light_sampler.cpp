// Choice of a light: a share for each infinite light, and a light tree (or, for a handful, their
// importances) for the others; and the choice by power. See light_sampler.h.
#include "scene/light/light_sampler.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "core/sampler.h"
#include "scene/light/light_tree.h"

namespace nephroid {

namespace {

/// Up to this number of lights, importances are compared one by one.
constexpr int kFew = 4;
/// With more infinite lights (and one for all others), groups are equally probable.
constexpr size_t kMaxLearnedGroups = 16;
/// Light that arrives from an even lamp is 1 / pi of its importance. From a node of the tree it can
/// be much more, beside one of its lamps: then a single sample would decide for a cell.
constexpr double kMostOfSample = 25.0 / kPiDouble;
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
  FewImportances few_importances(const Vec3f& p, const Vec3f& n) const {
    FewImportances w;
    for (int i = 0; i < few_count; ++i) w.sum += w.of[i] = few[i].importance(p, n);
    return w;
  }
  /// Importances times what was learned; the importances if nothing is known.
  FewImportances learned_importances(const FewImportances& plain, const float* shares) const {
    if (!shares) return plain;
    FewImportances w;
    for (int i = 0; i < few_count; ++i) {
      if (!(plain.of[i] > 0.0)) continue;
      if (shares[i] < 0.0f) return plain;
      w.sum += w.of[i] = plain.of[i] * shares[i];
    }
    return w.sum > 0.0 ? w : plain;
  }
  FewImportances few_importances_along(const Ray& ray, float t_max) const {
    FewImportances w;
    for (int i = 0; i < few_count; ++i) w.sum += w.of[i] = few[i].importance_along(ray, t_max);
    return w;
  }

  /// The shares of the cell around a point; null before learn(), and in media.
  const float* shares_at(const Vec3f& p, const Vec3f& n) const {
    const bool has_normal = n.x != 0.0f || n.y != 0.0f || n.z != 0.0f;
    return has_normal && !visibility.empty() ? visibility.at(p) : nullptr;
  }
  /// Slots begin with those of the groups, that of the bounded lights last.
  size_t group_slots() const {
    return group_count > 1 && group_count <= kMaxLearnedGroups ? group_count : 0;
  }
  const float* shares_of_bounded(const float* shares) const {
    return shares ? shares + group_slots() : nullptr;
  }
  /// Replaces what was learned of groups by probabilities: in proportion to their brightness. The
  /// squares of light from an infinite light were averaged, as its samples differ from each other.
  void turn_into_probabilities(float* shares) const {
    const std::span<float> groups(shares, group_slots());
    const bool is_known = std::ranges::none_of(groups, [](float share) { return share < 0.0f; });
    for (size_t i = 0; is_known && i < infinite.size(); ++i) groups[i] = std::sqrt(groups[i]);
    double sum = 0.0;
    for (const float share : groups) sum += share;
    for (float& share : groups)
      share = static_cast<float>(is_known && sum > 0.0 ? share / sum
                                                       : 1.0 / static_cast<double>(group_count));
  }
  ChoiceProbability group_probability(size_t group, const float* shares) const {
    const double plain = 1.0 / static_cast<double>(group_count);
    return {plain, shares && group_slots() > 0 ? double{shares[group]} : plain};
  }
  struct GroupChoice {
    size_t group = 0;
    ChoiceProbability probability;
    double rest = 0;  ///< what is left of the random number, in [0,1)
  };
  /// Samples a group by `u` in [0,1).
  GroupChoice choose_group(double u, const LightTree::Learned& learned) const {
    GroupChoice choice;
    double of_chosen = 1.0 / static_cast<double>(group_count);
    if (learned.follows && group_slots() > 0) {
      for (;; ++choice.group) {
        of_chosen = learned.shares[choice.group];
        if (u < of_chosen || choice.group + 1 == group_count) break;
        u -= of_chosen;
      }
    } else {
      choice.group = std::min(static_cast<size_t>(u / of_chosen), group_count - 1);
      u -= static_cast<double>(choice.group) * of_chosen;
    }
    choice.probability = group_probability(choice.group, learned.shares);
    choice.rest = of_chosen > 0.0 ? std::clamp(u / of_chosen, 0.0, 1.0 - 0x1p-53) : 0.0;
    return choice;
  }
  bool has_bounded() const { return group_count > infinite.size(); }
  ChoiceProbability pmf(const Vec3f& p, const Vec3f& n, int light, const float* shares) const;

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
  double v = refine(u, p);
  LightTree::Learned learned{.shares = d.shares_at(p, n)};
  if (learned.shares) {
    learned.follows = v >= kUnlearned;
    v = learned.follows ? (v - kUnlearned) / (1.0 - kUnlearned) : v / kUnlearned;
    v = std::min(v, 1.0 - 0x1p-53);
  }
  const auto choice = [](int light, const ChoiceProbability& probability) {
    return LightChoice{light, static_cast<float>(probability.mixed())};
  };
  Impl::GroupChoice group = d.choose_group(v, learned);
  if (group.group < d.infinite.size()) return choice(d.infinite[group.group], group.probability);
  learned.shares = d.shares_of_bounded(learned.shares);
  if (d.tree) {
    const auto chosen = d.tree->sample(p, n, group.rest, learned);
    if (!chosen) return std::nullopt;
    return choice(chosen->light, group.probability *= chosen->probability);
  }
  const Impl::FewImportances plain = d.few_importances(p, n);
  if (!(plain.sum > 0.0)) return std::nullopt;
  const Impl::FewImportances known = d.learned_importances(plain, learned.shares);
  const Impl::FewImportances& w = learned.follows ? known : plain;
  const int i = w.choose(group.rest * w.sum, d.few_count);
  return choice(d.few_lights[i],
                group.probability *= {plain.of[i] / plain.sum, known.of[i] / known.sum});
}

ChoiceProbability LightSampler::Impl::pmf(const Vec3f& p, const Vec3f& n, int light,
                                          const float* shares) const {
  constexpr ChoiceProbability kNever{0.0, 0.0};
  if (light < 0 || light >= static_cast<int>(group_of.size())) return kNever;
  if (group_of[light] != kBounded) return group_probability(group_of[light], shares);
  if (!has_bounded()) return kNever;
  ChoiceProbability probability = group_probability(infinite.size(), shares);
  shares = shares_of_bounded(shares);
  if (tree) return probability *= tree->pmf(p, n, light, shares);
  const FewImportances plain = few_importances(p, n);
  if (!(plain.sum > 0.0)) return kNever;
  const FewImportances known = learned_importances(plain, shares);
  for (int i = 0; i < few_count; ++i)
    if (few_lights[i] == light)
      return probability *= {plain.of[i] / plain.sum, known.of[i] / known.sum};
  return kNever;
}

float LightSampler::pmf(const Vec3f& p, const Vec3f& n, int light) const {
  return static_cast<float>(impl_->pmf(p, n, light, impl_->shares_at(p, n)).mixed());
}
float LightSampler::plain_pmf(const Vec3f& p, const Vec3f& n, int light) const {
  return static_cast<float>(impl_->pmf(p, n, light, nullptr).plain);
}

size_t LightSampler::slot_count() const {
  const Impl& d = *impl_;
  const size_t bounded = d.tree ? d.tree->slot_count() : d.few_count;
  return d.group_slots() > 0 || bounded > 1 ? d.group_slots() + bounded : 0;
}

void LightSampler::survey(const Vec3f& p, const Vec3f& n, float u,
                          const std::function<float(int)>& arrives,
                          std::vector<SlotSample>& samples) const {
  const Impl& d = *impl_;
  const auto slots_of_groups = static_cast<uint32_t>(d.group_slots());
  Impl::GroupChoice group{.group = d.infinite.size(), .probability = {}, .rest = refine(u, p)};
  if (slots_of_groups > 0) group = d.choose_group(group.rest, {});
  if (group.group < d.infinite.size()) {
    const double light = arrives(d.infinite[group.group]);
    samples.push_back({static_cast<uint32_t>(group.group), sqr(light)});
    return;
  }
  double found = 0.0;
  if (d.tree) {
    std::vector<LightTree::Turn> turns;
    const auto choice = d.tree->survey(p, n, group.rest, turns);
    if (choice) found = arrives(choice->light) / choice->probability;
    for (const LightTree::Turn& turn : turns)
      samples.push_back({slots_of_groups + turn.slot,
                         std::min(found * turn.probability / turn.importance, kMostOfSample)});
  } else {
    const Impl::FewImportances w = d.few_importances(p, n);
    const auto lights = static_cast<double>(d.few_count);
    const int i = std::min(static_cast<int>(group.rest * lights), d.few_count - 1);
    if (w.of[i] > 0.0) {
      const double light = arrives(d.few_lights[i]);
      samples.push_back({slots_of_groups + i, light / w.of[i]});
      found = light * lights;
    }
  }
  if (slots_of_groups > 0) samples.push_back({slots_of_groups - 1, found});
}

void LightSampler::learn(LightVisibility visibility) {
  if (impl_->group_slots() > 0)
    visibility.for_each_cell([this](float* shares) { impl_->turn_into_probabilities(shares); });
  impl_->visibility = std::move(visibility);
}

std::optional<LightAlong> LightSampler::sample_along(const Ray& ray, float t_max, float u) const {
  const Impl& d = *impl_;
  const double v = refine(u, ray.o);
  if (d.tree) {
    if (!d.tree->shines_along(ray, t_max)) return std::nullopt;
    const auto choice = d.tree->sample_along(ray, t_max, v);
    if (!choice) return LightAlong();
    return LightAlong{choice->light, static_cast<float>(choice->probability.plain),
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
