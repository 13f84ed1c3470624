#include "photon/emission_guide.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/warps.h"
#include "photon/start_tree.h"

namespace nephroid {

namespace {

/// [G5] Starts that suffice to tell the extent of a place.
constexpr float kMinStartsOfExtent = 8;
/// Radius of a target over the extent of its starts.
constexpr float kTargetSlack = 1.05f;
/// [G7] Share of a ball's paths that goes to the balls around it instead.
constexpr double kShareAround = 0.125;
/// A single ball gets a second one around it if that is wider by this factor.
constexpr float kWider = 1.05f;
/// Targets that density() evaluates together.
constexpr size_t kLanes = 8;
using FloatLanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using IntLanes = int32_t __attribute__((vector_size(kLanes * sizeof(int32_t))));
using DoubleLanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using LongLanes = int64_t __attribute__((vector_size(kLanes * sizeof(int64_t))));
/// Smallest radius of a target, over the scene's radius.
constexpr float kSmallest = 1e-4f;

/// The share of a light's emission that passes through a target is about the square of the target's
/// radius over this length. Empty for a light without a place.
std::optional<double> radius_of_all(const Scene& scene, const Light& light, const Vec3f& center) {
  if (light.is_infinite()) return double{scene.sphere.radius};
  const auto bounds = light.bounds();
  if (!bounds) return std::nullopt;
  const Vec3f middle = (bounds->bounds.min + bounds->bounds.max) * 0.5f;
  return 2 * std::max(double{length(center - middle)}, 1e-15);
}

template <typename Lanes>
Lanes lanes_at(const auto& values, size_t first) {
  Lanes lanes;
  std::memcpy(&lanes, &values[first], sizeof lanes);
  return lanes;
}

double part_through(const Scene& scene, const Light& light, const EmissionGuide::Target& target) {
  const auto all = radius_of_all(scene, light, target.center);
  return all ? std::min(1.0, sqr(double{target.radius} / *all)) : 1;
}

}  // namespace

EmissionGuide::EmissionGuide(const Scene& scene, std::span<const UsefulStart> useful,
                             double paths) {
  if (useful.empty()) return;
  for (const UsefulStart& start : useful) share_unaimed_ += double{start.weight} / paths;
  gather_lights(scene);
  const StartTree tree(useful, kMaxPlaces);
  std::vector<int> target_of(useful.size());
  for (const StartTree::Crowd& leaf : tree.leaves()) {
    float farthest = 0;
    for (const uint32_t i : tree.starts_of(leaf)) {
      target_of[i] = static_cast<int>(targets_.size());
      farthest = std::max(farthest, length(useful[i].first_hit - leaf.center()));
    }
    targets_.push_back(
        target_around(scene, leaf.center(), farthest, useful, tree.starts_of(leaf), paths));
  }
  places_ = targets_.size();
  const std::vector<double> aims = aims_at(scene, useful, target_of, paths);
  const auto target_of_box = [&](const StartTree::Crowd& crowd) {
    return target_around(scene, crowd.center(), crowd.half_diagonal(), useful,
                         tree.starts_of(crowd), paths);
  };
  std::vector<StartTree::Crowd> wider = tree.inner();
  // Near-identical balls are not kept: rounding would decide which of them a path hits.
  if (wider.empty() && target_of_box(tree.leaves()[0]).radius > kWider * targets_[0].radius)
    wider = tree.leaves();
  for (const StartTree::Crowd& crowd : wider) targets_.push_back(target_of_box(crowd));
  // [G7]
  std::vector<double> all(clusters_.size() * targets_.size(), 0);
  for (size_t k = 0; k < places_; ++k) {
    std::vector<size_t> around;
    for (size_t i = 0; i < wider.size(); ++i)
      if (wider[i].contains(tree.leaves()[k])) around.push_back(places_ + i);
    for (size_t c = 0; c < clusters_.size(); ++c) {
      const double aim = aims[c * places_ + k];
      double* const of_cluster = &all[c * targets_.size()];
      of_cluster[k] += around.empty() ? aim : (1 - kShareAround) * aim;
      for (const size_t i : around)
        of_cluster[i] += kShareAround * aim / static_cast<double>(around.size());
    }
  }
  share_out(all);
}

EmissionGuide::EmissionGuide(const Scene& scene, std::span<const Vec3f> casters) {
  if (casters.empty() || scene.lights.empty()) return;
  gather_lights(scene);
  // All lights are black.
  if (std::none_of(clusters_.begin(), clusters_.end(), [](const Cluster& c) { return c.pmf > 0; }))
    return;
  std::vector<UsefulStart> starts(casters.size());
  for (size_t i = 0; i < casters.size(); ++i) starts[i].first_hit = casters[i];
  const StartTree tree(starts, kMaxPlaces);
  std::vector<double> seen;  // number of casters, by target
  for (const StartTree::Crowd& leaf : tree.leaves()) {
    seen.push_back(leaf.weight);
    targets_.push_back({leaf.center(), std::max(kTargetSlack * leaf.half_diagonal(),
                                                kSmallest * scene.sphere.radius)});
  }
  places_ = targets_.size();
  // [G6] Targets count by the casters seen there, lights by how much reaches them.
  std::vector<double> aims(clusters_.size() * targets_.size());
  for (size_t k = 0; k < targets_.size(); ++k) {
    double all = 0;
    for (size_t c = 0; c < clusters_.size(); ++c) all += part_of_all(scene, c, targets_[k]);
    for (size_t c = 0; c < clusters_.size(); ++c)
      aims[c * targets_.size() + k] = seen[k] * part_of_all(scene, c, targets_[k]) / all;
  }
  share_out(aims);
}

EmissionGuide::Target EmissionGuide::target_around(const Scene& scene, const Vec3f& center,
                                                   float extent,
                                                   std::span<const UsefulStart> useful,
                                                   std::span<const uint32_t> which,
                                                   double paths) const {
  const float count = static_cast<float>(which.size());
  // [G5] Room for points not found yet, most where starts are few: the ball then lets as much light
  // through as the starts stand for.
  std::vector<double> found(clusters_.size(), 0);
  for (const uint32_t i : which) found[cluster_of(useful[i].light)] += double{useful[i].weight};
  double needed = 0;
  for (size_t c = 0; c < clusters_.size(); ++c) {
    if (!(found[c] > 0)) continue;
    const auto all = radius_of_all(scene, *scene.lights[c * cluster_size_], center);
    const double part = std::min(1.0, found[c] / (paths * clusters_[c].pmf));
    if (all) needed = std::max(needed, *all * std::sqrt(part));
  }
  const float slack = kTargetSlack + 0.5f / std::sqrt(count);
  return {center, std::max({extent * slack,
                            static_cast<float>(needed) * std::min(1.0f, kMinStartsOfExtent / count),
                            kSmallest * scene.sphere.radius})};
}

void EmissionGuide::gather_lights(const Scene& scene) {
  const size_t lights = scene.lights.size();
  cluster_size_ = (lights + kMaxClusters - 1) / kMaxClusters;
  clusters_.resize((lights + cluster_size_ - 1) / cluster_size_);
  for (size_t i = 0; i < lights; ++i) {
    Cluster& c = clusters_[i / cluster_size_];
    c.pmf += scene.light_sampler->pmf_by_power(static_cast<int>(i));
    c.cumulative.push_back(c.pmf);
  }
}

std::vector<double> EmissionGuide::aims_at(const Scene& scene, std::span<const UsefulStart> useful,
                                           std::span<const int> target_of, double paths) const {
  const size_t targets = targets_.size();
  std::vector<double> aims(clusters_.size() * targets, 0);
  for (size_t i = 0; i < useful.size(); ++i)
    aims[cluster_of(useful[i].light) * targets + target_of[i]] += double{useful[i].weight} / paths;
  // [G3] The variance is least if the density in a region is proportional to the square root of the
  // region's useful part.
  for (size_t c = 0; c < clusters_.size(); ++c)
    for (size_t k = 0; k < targets; ++k) {
      double& aim = aims[c * targets + k];
      aim = std::sqrt(aim * std::max(aim, part_of_all(scene, c, targets_[k])));
    }
  return aims;
}

double EmissionGuide::part_of_all(const Scene& scene, size_t cluster, const Target& target) const {
  return clusters_[cluster].pmf *
         part_through(scene, *scene.lights[cluster * cluster_size_], target);
}

EmissionGuide::Lanes EmissionGuide::lanes_of(std::span<const Target> targets) {
  Lanes lanes;
  const size_t padded = (targets.size() + kLanes - 1) / kLanes * kLanes;
  for (size_t k = 0; k < padded; ++k) {
    const Target t = k < targets.size() ? targets[k] : Target();
    lanes.x.push_back(t.center.x);
    lanes.y.push_back(t.center.y);
    lanes.z.push_back(t.center.z);
    lanes.radius2.push_back(k < targets.size() ? sqr(t.radius) : -1.0f);
  }
  return lanes;
}

void EmissionGuide::share_out(std::span<const double> aims) {
  const size_t targets = targets_.size();
  lanes_ = lanes_of(targets_);
  for (Cluster& cluster : clusters_) cluster.shares.assign(lanes_.x.size(), 0);
  double total = 0, sum = 0;
  for (const double aim : aims) total += aim;
  for (size_t c = 0; c < clusters_.size(); ++c)
    for (size_t k = 0; k < targets; ++k) {
      const double p = aims[c * targets + k] / total;
      if (!(p > 0)) continue;
      sum += p;
      entries_.push_back({static_cast<uint32_t>(c), static_cast<int>(k), sum});
      clusters_[c].shares[k] = p / clusters_[c].pmf;
    }
}

bool EmissionGuide::Cluster::is_sound() const {
  const auto is_amount = [](double x) { return x >= 0 && std::isfinite(x); };
  // choose() searches the sums for `pmf`.
  return std::ranges::all_of(shares, is_amount) && std::ranges::all_of(cumulative, is_amount) &&
         std::ranges::is_sorted(cumulative) && !cumulative.empty() && cumulative.back() == pmf;
}

bool EmissionGuide::has_sound_entries() const {
  double sum = 0;
  for (const Entry& e : entries_) {
    if (e.cluster >= clusters_.size() || !(clusters_[e.cluster].pmf > 0) || e.target < 0 ||
        static_cast<size_t>(e.target) >= targets_.size() || !(e.cumulative >= sum))
      return false;
    sum = e.cumulative;
  }
  return sum > 0 && std::isfinite(sum);
}

bool EmissionGuide::is_sound() const {
  if (!std::isfinite(share_unaimed_) || places_ > targets_.size()) return false;
  // The other members are not read then.
  if (empty()) return true;
  return targets_.size() <= kMaxTargets && lanes_ == lanes_of(targets_) &&
         std::ranges::all_of(
             clusters_, [&](const Cluster& c) { return c.shares.size() == lanes_.x.size(); }) &&
         has_sound_entries();
}

bool EmissionGuide::fits(size_t lights) const {
  if (empty()) return true;
  if (cluster_size_ == 0) return false;
  for (const Cluster& cluster : clusters_) {
    const size_t held = std::min(lights, cluster_size_);
    if (cluster.cumulative.size() != held) return false;
    lights -= held;
  }
  return lights == 0;
}

std::optional<EmissionGuide::Choice> EmissionGuide::choose(const Scene& scene, float u) const {
  if (empty() || u < static_cast<float>(kDefensive)) {
    float own = empty() ? u : std::min(u / static_cast<float>(kDefensive), kOneMinusEpsilon);
    const auto choice = scene.light_sampler->sample_by_power(own);
    if (!choice) return std::nullopt;
    return Choice{choice->light, -1};
  }
  const double v = (double{u} - kDefensive) / (1 - kDefensive) * entries_.back().cumulative;
  auto entry = std::upper_bound(entries_.begin(), entries_.end(), v,
                                [](double x, const Entry& e) { return x < e.cumulative; });
  if (entry == entries_.end()) --entry;
  const double below = entry == entries_.begin() ? 0 : std::prev(entry)->cumulative;
  const Cluster& cluster = clusters_[entry->cluster];
  const double x = (v - below) / (entry->cumulative - below) * cluster.pmf;
  // If rounding goes past the last light that is not black, that light is chosen.
  const auto light =
      std::min(std::upper_bound(cluster.cumulative.begin(), cluster.cumulative.end(), x),
               std::lower_bound(cluster.cumulative.begin(), cluster.cumulative.end(), cluster.pmf));
  const auto within = light - cluster.cumulative.begin();
  return Choice{static_cast<int>(entry->cluster * cluster_size_ + within), entry->target};
}

std::optional<Vec3f> EmissionGuide::direction_to(int target, const Vec3f& p, const Vec2f& u) const {
  const Target& t = targets_[target];
  const Vec3f way = t.center - p;
  const double d2 = length_squared(way), sine2 = double{sqr(t.radius)} / d2;
  if (!(sine2 < 1)) return std::nullopt;
  // One minus the cosine: the cosine itself would round to 1 for targets far away.
  const double most = sine2 / (1 + std::sqrt(1 - sine2));
  const double below = most * u.x;
  const double sine = std::sqrt(below * (2 - below));
  const double phi = 2 * double{kPi} * u.y;
  const Frame frame = Frame::from_z(normalize(way));
  return normalize(frame.to_world(Vec3f(static_cast<float>(sine * std::cos(phi)),
                                        static_cast<float>(sine * std::sin(phi)),
                                        static_cast<float>(1 - below))));
}

Vec3f EmissionGuide::point_across(int target, const Vec3f& w, const Vec2f& u) const {
  const Target& t = targets_[target];
  const Frame frame = Frame::from_z(w);
  const Vec2f disk = square_to_disk(u);
  return t.center + (frame.x * disk.x + frame.y * disk.y) * t.radius;
}

double EmissionGuide::gain(int light) const {
  if (empty()) return 1;
  double sum = kDefensive;
  for (const double share : clusters_[cluster_of(light)].shares) sum += (1 - kDefensive) * share;
  return sum;
}

double EmissionGuide::density(const Scene& scene, int light, const Vec3f& p, const Vec3f& w,
                              double own, int aimed_at) const {
  if (empty()) return own;
  const Light& l = *scene.lights[light];
  const bool across = l.is_infinite(), owns_all = across && !l.emits_through_disk();
  const std::vector<double>& shares = clusters_[cluster_of(light)].shares;
  const DoubleLanes all_own = own - DoubleLanes{};
  DoubleLanes sums{};
  for (size_t first = 0; first < shares.size(); first += kLanes) {
    const FloatLanes x = lanes_at<FloatLanes>(lanes_.x, first) - p.x;
    const FloatLanes y = lanes_at<FloatLanes>(lanes_.y, first) - p.y;
    const FloatLanes z = lanes_at<FloatLanes>(lanes_.z, first) - p.z;
    const FloatLanes r2 = lanes_at<FloatLanes>(lanes_.radius2, first);
    const FloatLanes along = x * w.x + y * w.y + z * w.z;
    const FloatLanes aside_x = x - w.x * along, aside_y = y - w.y * along,
                     aside_z = z - w.z * along;
    const FloatLanes aside2 = aside_x * aside_x + aside_y * aside_y + aside_z * aside_z;
    const DoubleLanes radius2 = __builtin_convertvector(r2, DoubleLanes);
    const DoubleLanes d2 = __builtin_convertvector(x * x + y * y + z * z, DoubleLanes);
    IntLanes hits = aside2 <= r2;
    if (!across) hits &= along >= 0;
    if (aimed_at >= 0 && static_cast<size_t>(aimed_at) / kLanes == first / kLanes)
      hits[aimed_at % kLanes] = -1;
    const DoubleLanes sine2 = radius2 / d2;
    DoubleLanes cosine = 1 - sine2;
    cosine = cosine > 0 ? cosine : DoubleLanes{};
    for (size_t lane = 0; lane < kLanes; ++lane) cosine[lane] = std::sqrt(cosine[lane]);
    const DoubleLanes cone = (1 + cosine) / (2 * double{kPi} * sine2);
    const DoubleLanes aimed = across ? 1 / (double{kPi} * radius2) : cone;
    DoubleLanes densities = __builtin_convertvector(hits, LongLanes) ? aimed : DoubleLanes{};
    if (owns_all)
      densities = all_own;
    else if (!across)  // from inside of a target
      densities = d2 <= radius2 ? all_own : densities;
    sums += lanes_at<DoubleLanes>(shares, first) * densities;
  }
  double sum = 0;
  for (size_t lane = 0; lane < kLanes; ++lane) sum += sums[lane];
  return kDefensive * own + (1 - kDefensive) * sum;
}

}  // namespace nephroid
