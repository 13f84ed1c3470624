#include "photon/emission_guide.h"

#include <algorithm>
#include <cmath>

#include "core/warps.h"

namespace nephroid {

namespace {

/// So many starts say how wide the place is in which they lie.
constexpr float kTelling = 8;
/// Targets are so much wider than the starts in them.
constexpr float kRoom = 1.05f;
/// Over the scene's radius.
constexpr float kSmallest = 1e-4f;

/// Some of the starts, [begin, end) of an order of them, and the ball around them.
struct Ball {
  size_t begin = 0, end = 0;
  Bounds3f bounds;
  double weight = 0;

  /// [G4] The square of the sum over all balls is the variance, up to a factor, if paths are aimed
  /// at each as [G3] has it.
  double cost() const { return std::sqrt(weight * length_squared(bounds.max - bounds.min)); }
};

/// Splits starts into balls: a tree of cuts, of which those are kept that lower the cost.
class Splitter {
 public:
  explicit Splitter(std::span<const UsefulStart> starts) : starts_(starts), order_(starts.size()) {
    for (size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<uint32_t>(i);
  }

  std::vector<Ball> balls() {
    const Ball all = ball_around(0, order_.size());
    // A ball more costs a little, so that there are few; dearer until there are few enough.
    for (double share = 0.01;; share *= 2) {
      Split split = best_split(all, share * all.cost(), 0);
      if (split.balls.size() <= EmissionGuide::kMaxTargets) return std::move(split.balls);
    }
  }
  const std::vector<uint32_t>& order() const { return order_; }

 private:
  struct Split {
    std::vector<Ball> balls;
    double cost = 0;
  };
  static constexpr int kMaxDepth = 10;
  static constexpr size_t kFewStarts = 8;

  const Vec3f& at(size_t i) const { return starts_[order_[i]].first_hit; }

  Ball ball_around(size_t begin, size_t end) const {
    Ball ball{begin, end, {}, 0};
    for (size_t i = begin; i < end; ++i) {
      ball.bounds.extendBy(at(i));
      ball.weight += double{starts_[order_[i]].weight};
    }
    return ball;
  }

  void sort(const Ball& ball, int axis) {
    std::sort(order_.begin() + static_cast<std::ptrdiff_t>(ball.begin),
              order_.begin() + static_cast<std::ptrdiff_t>(ball.end), [&](uint32_t a, uint32_t b) {
                const float x = starts_[a].first_hit[axis], y = starts_[b].first_hit[axis];
                return x != y ? x < y : a < b;
              });
  }

  /// The cut in two that costs least; leaves the starts in its order.
  size_t cut(const Ball& ball) {
    struct {
      int axis = -1;
      size_t middle = 0;
      double cost = 0;
    } best;
    std::vector<double> below(ball.end - ball.begin);
    for (int axis = 0; axis < 3; ++axis) {
      sort(ball, axis);
      Ball side{0, 0, {}, 0};
      for (size_t i = 0; i < below.size(); ++i) below[i] = grown(side, ball.begin + i);
      side = {0, 0, {}, 0};
      for (size_t i = below.size() - 1; i > 0; --i) {
        const double cost = below[i - 1] + grown(side, ball.begin + i);
        if (best.axis < 0 || cost < best.cost) best = {axis, ball.begin + i, cost};
      }
    }
    sort(ball, best.axis);
    return best.middle;
  }
  double grown(Ball& ball, size_t i) const {
    ball.bounds.extendBy(at(i));
    ball.weight += double{starts_[order_[i]].weight};
    return ball.cost();
  }

  Split best_split(const Ball& ball, double price, int depth) {
    Split whole{{ball}, ball.cost() + price};
    if (depth == kMaxDepth || ball.end - ball.begin < 2 * kFewStarts) return whole;
    const size_t middle = cut(ball);
    Split parts = best_split(ball_around(ball.begin, middle), price, depth + 1);
    Split others = best_split(ball_around(middle, ball.end), price, depth + 1);
    parts.cost += others.cost;
    if (parts.cost >= whole.cost) return whole;
    parts.balls.insert(parts.balls.end(), others.balls.begin(), others.balls.end());
    return parts;
  }

  std::span<const UsefulStart> starts_;
  std::vector<uint32_t> order_;
};

/// The part of what a light emits that goes through a target is about the square of its radius over
/// this length. Empty where a light has no place.
std::optional<double> radius_of_all(const Scene& scene, const Light& light, const Vec3f& center) {
  if (light.is_infinite()) return double{scene.sphere.radius};
  const auto bounds = light.bounds();
  if (!bounds) return std::nullopt;
  const Vec3f middle = (bounds->bounds.min + bounds->bounds.max) * 0.5f;
  return 2 * std::max(double{length(center - middle)}, 1e-15);
}

double part_through(const Scene& scene, const Light& light, const EmissionGuide::Target& target) {
  const auto all = radius_of_all(scene, light, target.center);
  return all ? std::min(1.0, sqr(double{target.radius} / *all)) : 1;
}

}  // namespace

EmissionGuide::EmissionGuide(const Scene& scene, std::span<const UsefulStart> useful,
                             double paths) {
  if (useful.empty()) return;
  gather_lights(scene);
  Splitter splitter(useful);
  const std::vector<Ball> balls = splitter.balls();
  std::vector<int> target_of(useful.size());
  for (const Ball& ball : balls) {
    const std::span<const uint32_t> order =
        std::span(splitter.order()).subspan(ball.begin, ball.end - ball.begin);
    targets_.push_back(target_around(scene, ball.bounds, useful, order, paths));
    for (const uint32_t i : order) target_of[i] = static_cast<int>(targets_.size()) - 1;
  }
  share_out(aims_at(scene, useful, target_of, paths));
}

EmissionGuide::EmissionGuide(const Scene& scene, std::span<const Vec3f> casters) {
  gather_lights(scene);
  // Black lights shine nowhere.
  if (casters.empty() ||
      std::none_of(clusters_.begin(), clusters_.end(), [](const Cluster& c) { return c.pmf > 0; }))
    return;
  std::vector<UsefulStart> starts(casters.size());
  for (size_t i = 0; i < casters.size(); ++i) starts[i].first_hit = casters[i];
  Splitter splitter(starts);
  std::vector<double> seen;  // of each target, how many
  for (const Ball& ball : splitter.balls()) {
    seen.push_back(ball.weight);
    targets_.push_back({(ball.bounds.min + ball.bounds.max) * 0.5f,
                        std::max(0.5f * kRoom * length(ball.bounds.max - ball.bounds.min),
                                 kSmallest * scene.sphere.radius)});
  }
  // [G6] Targets as they are seen, lights as they shine there.
  std::vector<double> aims(clusters_.size() * targets_.size());
  for (size_t k = 0; k < targets_.size(); ++k) {
    double all = 0;
    for (size_t c = 0; c < clusters_.size(); ++c) all += part_of_all(scene, c, targets_[k]);
    for (size_t c = 0; c < clusters_.size(); ++c)
      aims[c * targets_.size() + k] = seen[k] * part_of_all(scene, c, targets_[k]) / all;
  }
  share_out(aims);
}

EmissionGuide::Target EmissionGuide::target_around(const Scene& scene, const Bounds3f& bounds,
                                                   std::span<const UsefulStart> useful,
                                                   std::span<const uint32_t> which,
                                                   double paths) const {
  const Vec3f center = (bounds.min + bounds.max) * 0.5f;
  const float count = static_cast<float>(which.size());
  // [G5] Room for what the starts have not found, most where they are few: as much as the part of
  // the light needs that they stand for.
  std::vector<double> found(clusters_.size(), 0);
  for (const uint32_t i : which) found[cluster_of(useful[i].light)] += double{useful[i].weight};
  double needed = 0;
  for (size_t c = 0; c < clusters_.size(); ++c) {
    if (!(found[c] > 0)) continue;
    const auto all = radius_of_all(scene, *scene.lights[c * cluster_size_], center);
    const double part = std::min(1.0, found[c] / (paths * clusters_[c].pmf));
    if (all) needed = std::max(needed, *all * std::sqrt(part));
  }
  const float slack = kRoom + 0.5f / std::sqrt(count);
  return {center, std::max({0.5f * length(bounds.max - bounds.min) * slack,
                            static_cast<float>(needed) * std::min(1.0f, kTelling / count),
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
    aims[cluster_of(useful[i].light) * targets + static_cast<size_t>(target_of[i])] +=
        double{useful[i].weight} / paths;
  // [G3] The least variance has the density of a region in proportion to the root of the part of
  // it that is of use.
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

void EmissionGuide::share_out(std::span<const double> aims) {
  const size_t targets = targets_.size();
  double total = 0, sum = 0;
  for (const double aim : aims) total += aim;
  for (size_t c = 0; c < clusters_.size(); ++c)
    for (size_t k = 0; k < targets; ++k) {
      const double p = aims[c * targets + k] / total;
      if (!(p > 0)) continue;
      sum += p;
      entries_.push_back({static_cast<uint32_t>(c), static_cast<int>(k), sum});
      clusters_[c].shares.push_back({static_cast<int>(k), p / clusters_[c].pmf});
    }
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
  // Where rounding goes past the last one that shines, it is meant all the same.
  const auto light =
      std::min(std::upper_bound(cluster.cumulative.begin(), cluster.cumulative.end(), x),
               std::lower_bound(cluster.cumulative.begin(), cluster.cumulative.end(), cluster.pmf));
  const auto within = light - cluster.cumulative.begin();
  return Choice{static_cast<int>(entry->cluster * cluster_size_ + static_cast<size_t>(within)),
                entry->target};
}

std::optional<Vec3f> EmissionGuide::direction_to(int target, const Vec3f& p, const Vec2f& u) const {
  const Target& t = targets_[static_cast<size_t>(target)];
  const Vec3f way = t.center - p;
  const double d2 = length_squared(way), sine2 = sqr(double{t.radius}) / d2;
  if (!(sine2 < 1)) return std::nullopt;
  // One minus the cosine, which is small for targets far away.
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
  const Target& t = targets_[static_cast<size_t>(target)];
  const Frame frame = Frame::from_z(w);
  const Vec2f disk = square_to_disk(u);
  return t.center + (frame.x * disk.x + frame.y * disk.y) * t.radius;
}

double EmissionGuide::gain(int light) const {
  if (empty()) return 1;
  double sum = kDefensive;
  for (const Share& s : clusters_[cluster_of(light)].shares) sum += (1 - kDefensive) * s.share;
  return sum;
}

double EmissionGuide::density(const Scene& scene, int light, const Vec3f& p, const Vec3f& w,
                              double own, int aimed_at) const {
  if (empty()) return own;
  const Light& l = *scene.lights[static_cast<size_t>(light)];
  const bool across = l.is_infinite();
  double sum = kDefensive * own;
  for (const Share& s : clusters_[cluster_of(light)].shares) {
    const Target& t = targets_[static_cast<size_t>(s.target)];
    const Vec3f way = t.center - p;
    const double d2 = length_squared(way), r2 = sqr(double{t.radius});
    double aimed = own;  // from inside of a target
    if (across ? l.emits_through_disk() : d2 > r2) {
      const float along = dot(way, w);
      const double aside2 = length_squared(way - w * along);
      const bool inside = aside2 <= r2 && (across || along >= 0);
      if (!inside && s.target != aimed_at) continue;
      const double sine2 = r2 / d2;
      aimed = across ? 1 / (kPi * r2) : (1 + std::sqrt(1 - sine2)) / (2 * double{kPi} * sine2);
    }
    sum += (1 - kDefensive) * s.share * aimed;
  }
  return sum;
}

}  // namespace nephroid
