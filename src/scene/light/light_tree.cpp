#include "scene/light/light_tree.h"

#include <array>

namespace nephroid {

namespace {

// Deeper than this the tree splits by number instead of by cost, so that a trail fits in 64 bits.
constexpr int kBalancedDepth = 32;

struct Cone {
  Vec3f axis;
  float cos_half;
};

float angle_of(float cosine) { return std::acos(std::clamp(cosine, -1.0f, 1.0f)); }

Cone unite_cones(const Vec3f& axis_a, float cos_a, const Vec3f& axis_b, float cos_b) {
  const float half_a = angle_of(cos_a), half_b = angle_of(cos_b);
  const float between = angle_of(dot(axis_a, axis_b));
  if (std::min(between + half_b, kPi) <= half_a) return {axis_a, cos_a};
  if (std::min(between + half_a, kPi) <= half_b) return {axis_b, cos_b};
  const float half = (half_a + between + half_b) / 2;
  const Vec3f normal = cross(axis_a, axis_b);
  if (half >= kPi || !(length_squared(normal) > 0)) return {axis_a, -1.0f};
  // The axis of a turned towards b's.
  const float turn = half - half_a;
  const Vec3f side = normalize(cross(normalize(normal), axis_a));
  return {normalize(axis_a * std::cos(turn) + side * std::sin(turn)), std::cos(half)};
}

// cos and sin of max(0, a - b).
float cos_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

// Cost of a node after Conty Estevez & Kulla: power times solid angle of emission times area.
float cost_of(const LightBounds& b, const Bounds3f& all, int axis) {
  const float theta_o = angle_of(b.cos_theta_o), theta_e = angle_of(b.cos_theta_e);
  const float theta_w = std::min(theta_o + theta_e, kPi);
  const float sin_o = safe_sqrt(1 - sqr(b.cos_theta_o));
  const float omega = 2 * kPi * (1 - b.cos_theta_o) +
                      kPi / 2 * (2 * theta_w * sin_o - std::cos(theta_o - 2 * theta_w) -
                                 2 * theta_o * sin_o + b.cos_theta_o);
  const Vec3f size = all.max - all.min, d = b.bounds.max - b.bounds.min;
  const float regularity = size[axis] > 0 ? max_component(size) / size[axis] : 1.0f;
  return b.power * omega * regularity * (d.x * d.y + d.y * d.z + d.z * d.x + 1e-6f * dot(size, size));
}

}  // namespace

LightBounds unite(const LightBounds& a, const LightBounds& b) {
  if (!(a.power > 0)) return b;
  if (!(b.power > 0)) return a;
  LightBounds r;
  r.bounds = a.bounds;
  r.bounds.extendBy(b.bounds);
  const Cone cone = unite_cones(a.axis, a.cos_theta_o, b.axis, b.cos_theta_o);
  r.axis = cone.axis;
  r.cos_theta_o = cone.cos_half;
  r.cos_theta_e = std::min(a.cos_theta_e, b.cos_theta_e);
  r.power = a.power + b.power;
  r.two_sided = a.two_sided || b.two_sided;
  return r;
}

LightTree::Node LightTree::make_node(const LightBounds& b) {
  Node node;
  node.min = b.bounds.min;
  node.max = b.bounds.max;
  node.center = (b.bounds.min + b.bounds.max) * 0.5f;
  node.radius2 = length_squared(b.bounds.max - node.center);
  node.axis = b.axis;
  node.power = b.power;
  node.cos_o = b.cos_theta_o;
  node.sin_o = safe_sqrt(1 - sqr(b.cos_theta_o));
  node.cos_e = b.cos_theta_e;
  node.two_sided = b.two_sided;
  return node;
}

// Bound of what the lights of a node may send to p: power over squared distance, times the best cosines
// that the box, as seen from p, leaves possible at both ends.
float LightTree::importance(const Node& node, const Vec3f& p, const Vec3f& n) {
  const Vec3f to = p - node.center;
  const float d2 = length_squared(to);
  const bool inside = d2 <= node.radius2;
  const Vec3f w = d2 > 0 ? to * (1.0f / std::sqrt(d2)) : Vec3f(0, 0, 1);
  float sin2_b = inside ? 1.0f : node.radius2 / d2;
  const float cos_b = inside ? -1.0f : safe_sqrt(1 - sin2_b);
  const float sin_b = inside ? 0.0f : std::sqrt(sin2_b);

  float cos_w = dot(node.axis, w);
  if (node.two_sided) cos_w = std::abs(cos_w);
  const float sin_w = safe_sqrt(1 - sqr(cos_w));
  const float cos_x = cos_difference(sin_w, cos_w, node.sin_o, node.cos_o);
  const float sin_x = sin_difference(sin_w, cos_w, node.sin_o, node.cos_o);
  const float cos_emission = cos_difference(sin_x, cos_x, sin_b, cos_b);
  if (cos_emission <= node.cos_e) return 0.0f;
  float value = node.power * cos_emission / std::max(d2, node.radius2);
  if (length_squared(n) > 0) {
    const float cos_i = abs_dot(w, n);
    value *= cos_difference(safe_sqrt(1 - sqr(cos_i)), cos_i, sin_b, cos_b);
  }
  // A light at exactly this point, of no extent: anything finite will do.
  if (!std::isfinite(value)) return std::numeric_limits<float>::max() * 1e-10f;
  return std::max(value, 0.0f);
}

LightTree::LightTree(const std::vector<std::pair<int, LightBounds>>& lights, int light_count)
    : trails_(static_cast<size_t>(light_count), 0), depths_(static_cast<size_t>(light_count), -1) {
  std::vector<Item> items;
  for (const auto& [light, bounds] : lights)
    if (bounds.power > 0) items.push_back({light, bounds});
  if (items.empty()) return;
  nodes_.reserve(2 * items.size());
  build(items, 0, items.size(), 0, 0);
}

int LightTree::build(std::vector<Item>& items, size_t begin, size_t end, uint64_t trail,
                     int depth) {
  LightBounds all;
  Bounds3f centers;
  for (size_t i = begin; i < end; ++i) {
    all = unite(all, items[i].bounds);
    centers.extendBy((items[i].bounds.bounds.min + items[i].bounds.bounds.max) * 0.5f);
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back(make_node(all));
  if (end - begin == 1) {
    const int light = items[begin].light;
    nodes_.back().leaf = true;
    nodes_.back().child = light;
    trails_[static_cast<size_t>(light)] = trail;
    depths_[static_cast<size_t>(light)] = static_cast<int8_t>(depth);
    return index;
  }

  // The cheapest of the splits at eleven planes along each axis; by number where no plane separates.
  constexpr int kBuckets = 12;
  const auto bucket_of = [&](const Item& item, int axis) {
    const float c = (item.bounds.bounds.min[axis] + item.bounds.bounds.max[axis]) * 0.5f;
    const float t = (c - centers.min[axis]) / (centers.max[axis] - centers.min[axis]);
    return std::clamp(static_cast<int>(t * kBuckets), 0, kBuckets - 1);
  };
  float best = kInfinity;
  int best_axis = -1, best_split = 0;
  for (int axis = 0; axis < 3 && depth < kBalancedDepth; ++axis) {
    if (!(centers.max[axis] > centers.min[axis])) continue;
    std::array<LightBounds, kBuckets> buckets;
    for (size_t i = begin; i < end; ++i) {
      LightBounds& bucket = buckets[static_cast<size_t>(bucket_of(items[i], axis))];
      bucket = unite(bucket, items[i].bounds);
    }
    for (int split = 1; split < kBuckets; ++split) {
      LightBounds low, high;
      for (int b = 0; b < split; ++b) low = unite(low, buckets[static_cast<size_t>(b)]);
      for (int b = split; b < kBuckets; ++b) high = unite(high, buckets[static_cast<size_t>(b)]);
      if (!(low.power > 0) || !(high.power > 0)) continue;
      const float cost = cost_of(low, all.bounds, axis) + cost_of(high, all.bounds, axis);
      if (cost < best) {
        best = cost;
        best_axis = axis;
        best_split = split;
      }
    }
  }
  size_t middle = (begin + end) / 2;
  if (best_axis >= 0) {
    const auto it = std::stable_partition(
        items.begin() + static_cast<std::ptrdiff_t>(begin),
        items.begin() + static_cast<std::ptrdiff_t>(end),
        [&](const Item& item) { return bucket_of(item, best_axis) < best_split; });
    middle = static_cast<size_t>(it - items.begin());
  }
  build(items, begin, middle, trail, depth + 1);
  const int second = build(items, middle, end, trail | (uint64_t{1} << depth), depth + 1);
  nodes_[static_cast<size_t>(index)].child = second;
  return index;
}

std::optional<LightChoice> LightTree::sample(const Vec3f& p, const Vec3f& n, float u) const {
  if (nodes_.empty()) return std::nullopt;
  size_t i = 0;
  float probability = 1;
  if (nodes_[0].leaf && !(importance(nodes_[0], p, n) > 0)) return std::nullopt;
  while (!nodes_[i].leaf) {
    const size_t first = i + 1, second = static_cast<size_t>(nodes_[i].child);
    const float a = importance(nodes_[first], p, n), b = importance(nodes_[second], p, n);
    if (!(a + b > 0)) return std::nullopt;
    const float share = a / (a + b);
    if (u < share) {
      u = std::min(u / share, kOneMinusEpsilon);
      probability *= share;
      i = first;
    } else {
      u = std::clamp((u - share) / (1 - share), 0.0f, kOneMinusEpsilon);
      probability *= 1 - share;
      i = second;
    }
  }
  return LightChoice{nodes_[i].child, probability};
}

float LightTree::pmf(const Vec3f& p, const Vec3f& n, int light) const {
  const int depth = depths_[static_cast<size_t>(light)];
  if (depth < 0) return 0;
  if (depth == 0) return importance(nodes_[0], p, n) > 0 ? 1.0f : 0.0f;
  uint64_t trail = trails_[static_cast<size_t>(light)];
  size_t i = 0;
  float probability = 1;
  for (int level = 0; level < depth; ++level, trail >>= 1) {
    const size_t first = i + 1, second = static_cast<size_t>(nodes_[i].child);
    const float a = importance(nodes_[first], p, n), b = importance(nodes_[second], p, n);
    if (!(a + b > 0)) return 0;
    const float share = a / (a + b);
    probability *= (trail & 1) ? 1 - share : share;
    i = (trail & 1) ? second : first;
  }
  return probability;
}

}  // namespace nephroid
