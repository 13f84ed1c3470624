// Building the light tree and walking down it, see light_tree.h.
#include "scene/light/light_tree.h"

#include <algorithm>
#include <array>
#include <queue>

namespace nephroid {

namespace {

constexpr int kBuckets = 12;
/// Below this depth halves have equal numbers of lights, so that no path is longer than 64.
constexpr int kUnbalancedDepth = 40;
/// Nodes with learned visibility: a cell has a number for each.
constexpr uint32_t kMaxSlots = 128;

/// A point is behind the plane of flat lights if it is lower than this share of the distance: far
/// more than rounding and the differences of normals (LightBounds::is_flat).
constexpr float kTiltOfFlatLights = 0.01f;

/// cos(max(0, a - b)) and sin(max(0, a - b)) of angles in [0, pi].
float cos_sub_clamped(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_sub_clamped(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

double safe_acos(double c) {
  return std::acos(std::clamp(c, -1.0, 1.0));
}

/// The measure of directions into which a cone of normals emits, cosine-weighted outside of the
/// cone (Conty Estevez & Kulla 2018, equation 1).
double orientation_measure(double cos_o, double cos_e) {
  const double o = safe_acos(cos_o), w = std::min(o + safe_acos(cos_e), kPiDouble);
  const double sin_o = std::sin(o);
  return 2.0 * kPiDouble * (1.0 - cos_o) +
         kPiDouble / 2.0 * (2.0 * w * sin_o - std::cos(o - 2.0 * w) - 2.0 * o * sin_o + cos_o);
}

/// Cost of a group of lights that becomes a child (equation 2); `stretch` penalises thin boxes.
double group_cost(const LightBounds& b, double stretch) {
  if (!(b.power > 0.0f)) return 0.0;
  const Vec3f d = b.bounds.max - b.bounds.min;
  // The area of the box, plus a part of its squared diagonal to distinguish lights in a row.
  const double area = 2.0 * (static_cast<double>(d.x) * d.y + static_cast<double>(d.y) * d.z +
                             static_cast<double>(d.z) * d.x) +
                      0.1 * (static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y +
                             static_cast<double>(d.z) * d.z);
  return b.power * orientation_measure(b.cos_theta_o, b.cos_theta_e) * stretch * area;
}

Vec3f centroid(const LightTree::Item& item) {
  return (item.bounds.bounds.min + item.bounds.bounds.max) * 0.5f;
}

int bucket_of(float position, float low, float high) {
  const int b = static_cast<int>(static_cast<float>(kBuckets) * ((position - low) / (high - low)));
  return std::clamp(b, 0, kBuckets - 1);
}

struct Split {
  int axis = -1;  ///< -1: no split is possible
  int bucket = 0;
  float low = 0, high = 0;
};

/// The best of the planes between buckets, over all three axes.
Split best_split(const std::vector<LightTree::Item>& items, size_t begin, size_t end,
                 const Bounds3f& bounds, const Bounds3f& centers) {
  Split best;
  double best_cost = std::numeric_limits<double>::infinity();
  const Vec3f extent = bounds.max - bounds.min;
  const float longest = max_component(extent);
  for (int axis = 0; axis < 3; ++axis) {
    const float low = centers.min[axis], high = centers.max[axis];
    if (!(high > low)) continue;
    std::array<LightBounds, kBuckets> buckets;
    for (size_t i = begin; i < end; ++i) {
      LightBounds& b = buckets[bucket_of(centroid(items[i])[axis], low, high)];
      b = union_of(b, items[i].bounds);
    }
    const double stretch = longest / extent[axis];
    std::array<double, kBuckets> above{};
    LightBounds group;
    for (int i = kBuckets - 1; i > 0; --i) {
      group = union_of(buckets[i], group);
      above[i] = group_cost(group, stretch);
    }
    group = LightBounds();
    for (int i = 0; i + 1 < kBuckets; ++i) {
      group = union_of(group, buckets[i]);
      const double cost = group_cost(group, stretch) + above[i + 1];
      if (cost < best_cost) {
        best_cost = cost;
        best = {axis, i, low, high};
      }
    }
  }
  return best;
}

struct Cone {
  Vec3d axis;
  double cos_half = -1;
};

/// The smallest cone around two cones, or all directions.
Cone union_of_cones(const Vec3f& axis_a, float cos_a, const Vec3f& axis_b, float cos_b) {
  const Vec3d a(axis_a.x, axis_a.y, axis_a.z), b(axis_b.x, axis_b.y, axis_b.z);
  const double half_a = safe_acos(cos_a), half_b = safe_acos(cos_b);
  const Vec3d normal = a.cross(b);
  const double between = std::atan2(normal.length(), a.dot(b));
  if (std::min(between + half_b, kPiDouble) <= half_a) return {a, cos_a};
  if (std::min(between + half_a, kPiDouble) <= half_b) return {b, cos_b};
  const double half = 0.5 * (half_a + between + half_b);
  if (half >= kPiDouble || normal.length() < 1e-12) return {a, -1.0};
  // Axis a rotated towards b in their plane.
  const double turn = half - half_a;
  const Vec3d side = normal.normalized().cross(a);
  return {(a * std::cos(turn) + side * std::sin(turn)).normalized(), std::cos(half)};
}

}  // namespace

LightBounds union_of(const LightBounds& a, const LightBounds& b) {
  if (!(a.power > 0.0f)) return b;
  if (!(b.power > 0.0f)) return a;
  LightBounds u;
  u.bounds = a.bounds;
  u.bounds.extendBy(b.bounds);
  const Cone cone = union_of_cones(a.axis, a.cos_theta_o, b.axis, b.cos_theta_o);
  u.axis = Vec3f(static_cast<float>(cone.axis.x), static_cast<float>(cone.axis.y),
                 static_cast<float>(cone.axis.z));
  // Widened by the rounding of the axis to float.
  u.cos_theta_o = std::max(-1.0f, static_cast<float>(cone.cos_half) - 1e-6f);
  u.cos_theta_e = std::min(a.cos_theta_e, b.cos_theta_e);
  u.power = a.power + b.power;
  u.two_sided = a.two_sided || b.two_sided;
  if (u.is_flat())
    for (const LightBounds* part : {&a, &b}) {
      const float depth = part->depth + dot(u.axis, u.center() - part->center());
      u.depth = part == &a ? depth : std::max(u.depth, depth);
    }
  return u;
}

LightCluster::LightCluster(const LightBounds& b)
    : center(b.center()),
      radius2(0.25f * length_squared(b.bounds.max - b.bounds.min)),
      axis(b.axis),
      power(b.power),
      cos_o(b.cos_theta_o),
      sin_o(safe_sqrt(1.0f - b.cos_theta_o * b.cos_theta_o)),
      cos_e(b.cos_theta_e),
      two_sided(b.two_sided ? 1 : 0),
      depth(b.depth) {}

float LightCluster::importance(const Vec3f& p, const Vec3f& n) const {
  const Vec3f d = p - center;
  const float d2 = length_squared(d);
  // Height of p above the plane of flat lights, which neither box nor sphere represent.
  const float height = dot(axis, d) + depth;
  if (height < -kTiltOfFlatLights * std::sqrt(d2 + radius2)) return 0.0f;
  if (d2 <= radius2) return radius2 > 0.0f ? power / radius2 : 0.0f;
  const Vec3f w = d * (1.0f / std::sqrt(d2));
  float cos_w = dot(axis, w);
  if (two_sided) cos_w = std::abs(cos_w);
  const float sin_w = safe_sqrt(1.0f - cos_w * cos_w);
  // Half angle of the sphere seen from p.
  const float sin2_b = radius2 / d2;
  const float sin_b = std::sqrt(sin2_b), cos_b = safe_sqrt(1.0f - sin2_b);
  // Smallest angle between a normal of the cluster and a direction from it to p.
  const float cos_x = cos_sub_clamped(sin_w, cos_w, sin_o, cos_o);
  const float sin_x = sin_sub_clamped(sin_w, cos_w, sin_o, cos_o);
  float cos_p = cos_sub_clamped(sin_x, cos_x, sin_b, cos_b);
  if (cos_p <= cos_e) return 0.0f;
  cos_p = std::min(cos_p, height / std::sqrt(d2));
  // Lights that also emit backwards have a negative cosine here but still contribute.
  float value = power * std::max(cos_p, 0.01f) / d2;
  if (n.x != 0.0f || n.y != 0.0f || n.z != 0.0f) {
    const float cos_i = abs_dot(w, n), sin_i = safe_sqrt(1.0f - cos_i * cos_i);
    value *= std::max(cos_sub_clamped(sin_i, cos_i, sin_b, cos_b), 1e-4f);
  }
  return value;
}

Equiangular LightCluster::along(const Ray& ray, float t_max) const {
  LightPlace place;
  place.center = center;
  place.radius2 = radius2;
  place.axis = axis;
  // The cone of normals and the angles around each of them.
  const float cos_cone = cos_o * cos_e - sin_o * safe_sqrt(1.0f - cos_e * cos_e);
  if (!two_sided && cos_o > 0.0f) place.cos_cone = cos_cone;
  return {ray, t_max, place};
}

LightTree::LightTree(std::vector<Item> items, int light_count) : trails_(light_count) {
  if (items.empty()) return;
  nodes_.reserve(2 * items.size());
  nodes_.emplace_back();
  build(0, items, 0, items.size(), 0, 0);
  give_slots();
}

void LightTree::give_slots() {
  const auto power = [this](uint32_t node) { return nodes_[node].cluster.power; };
  const auto weaker = [&](uint32_t a, uint32_t b) {
    return power(a) != power(b) ? power(a) < power(b) : a > b;
  };
  std::priority_queue<uint32_t, std::vector<uint32_t>, decltype(weaker)> inner(weaker);
  const auto add = [&](uint32_t node) {
    if (!(nodes_[node].child & kLeaf)) inner.push(node);
  };
  add(0);
  while (!inner.empty() && slot_count_ < kMaxSlots) {
    Node& node = nodes_[inner.top()];
    inner.pop();
    node.slot = slot_count_;
    slot_count_ += 2;
    add(node.child);
    add(node.child + 1);
  }
}

LightBounds LightTree::build(uint32_t node, std::vector<Item>& items, size_t begin, size_t end,
                             uint64_t trail, int depth) {
  depth_ = std::max(depth_, depth);
  if (end - begin == 1) {
    const Item& item = items[begin];
    nodes_[node].cluster = LightCluster(item.bounds);
    nodes_[node].child = kLeaf | item.light;
    trails_[item.light] = {trail, true};
    return item.bounds;
  }
  Bounds3f bounds, centers;
  for (size_t i = begin; i < end; ++i) {
    bounds.extendBy(items[i].bounds.bounds);
    centers.extendBy(centroid(items[i]));
  }
  size_t middle = begin;
  if (depth < kUnbalancedDepth) {
    const Split split = best_split(items, begin, end, bounds, centers);
    if (split.axis >= 0) {
      const auto it =
          std::stable_partition(items.begin() + begin, items.begin() + end, [&](const Item& item) {
            return bucket_of(centroid(item)[split.axis], split.low, split.high) <= split.bucket;
          });
      middle = it - items.begin();
    }
  }
  if (middle == begin || middle == end) middle = begin + (end - begin) / 2;

  const auto child = static_cast<uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  const LightBounds first = build(child, items, begin, middle, trail, depth + 1);
  const LightBounds second =
      build(child + 1, items, middle, end, trail | (uint64_t{1} << depth), depth + 1);
  const LightBounds both = union_of(first, second);
  nodes_[node].cluster = LightCluster(both);
  nodes_[node].child = child;
  return both;
}

namespace {

/// The other one of two alternatives.
ChoiceProbability second_of(const ChoiceProbability& first) {
  return {1.0 - first.plain, 1.0 - first.learned};
}

}  // namespace

template <class Importance>
ChoiceProbability LightTree::first_probability(const Node& node, const Importance& importance,
                                               const float* shares) const {
  const double first = importance(nodes_[node.child].cluster);
  const double second = importance(nodes_[node.child + 1].cluster);
  const double sum = first + second;
  if (!(sum > 0.0)) return {-1.0, -1.0};
  const double plain = first / sum;
  if (!shares || node.slot == kNoSlot) return {plain, plain};
  const float* of = shares + node.slot;
  const double first_arrives = first * of[0], arrives = first_arrives + second * of[1];
  const bool knows = of[0] >= 0.0f && of[1] >= 0.0f && arrives > 0.0;
  return {plain, knows ? first_arrives / arrives : plain};
}

template <class Importance>
std::optional<LightTree::Choice> LightTree::sample(const Importance& importance, double u,
                                                   const Learned& learned) const {
  if (nodes_.empty()) return std::nullopt;
  const Node* node = &nodes_[0];
  if (!(importance(node->cluster) > 0.0f)) return std::nullopt;
  ChoiceProbability probability;
  while (!(node->child & kLeaf)) {
    const ChoiceProbability both = first_probability(*node, importance, learned.shares);
    const double first = learned.follows ? both.learned : both.plain;
    if (first < 0.0) return std::nullopt;
    if (u < first) {
      u /= first;
      probability *= both;
      node = &nodes_[node->child];
    } else {
      u = (u - first) / (1.0 - first);
      probability *= second_of(both);
      node = &nodes_[node->child + 1];
    }
    // Rounding must not lead to a child of probability 0 further down.
    u = std::min(u, 1.0 - 0x1p-53);
  }
  return Choice{static_cast<int>(node->child & ~kLeaf), probability};
}

template <class Importance>
ChoiceProbability LightTree::pmf(const Importance& importance, int light,
                                 const float* shares) const {
  if (!contains(light)) return {0.0, 0.0};
  const Node* node = &nodes_[0];
  if (!(importance(node->cluster) > 0.0f)) return {0.0, 0.0};
  ChoiceProbability probability;
  uint64_t trail = trails_[light].bits;
  while (!(node->child & kLeaf)) {
    const ChoiceProbability first = first_probability(*node, importance, shares);
    if (first.plain < 0.0) return {0.0, 0.0};
    probability *= trail & 1 ? second_of(first) : first;
    node = &nodes_[node->child + (trail & 1)];
    trail >>= 1;
  }
  return probability;
}

namespace {

auto importance_at(const Vec3f& p, const Vec3f& n) {
  return [&p, &n](const LightCluster& c) { return c.importance(p, n); };
}
auto importance_along(const Ray& ray, float t_max) {
  return [&ray, t_max](const LightCluster& c) { return c.importance_along(ray, t_max); };
}

}  // namespace

std::optional<LightTree::Choice> LightTree::sample(const Vec3f& p, const Vec3f& n, double u,
                                                   const Learned& learned) const {
  return sample(importance_at(p, n), u, learned);
}
ChoiceProbability LightTree::pmf(const Vec3f& p, const Vec3f& n, int light,
                                 const float* shares) const {
  return pmf(importance_at(p, n), light, shares);
}

std::optional<LightTree::Surveyed> LightTree::survey(const Vec3f& p, const Vec3f& n, double u,
                                                     std::vector<Turn>& turns) const {
  const auto importance = importance_at(p, n);
  if (nodes_.empty() || !(importance(nodes_[0].cluster) > 0.0f)) return std::nullopt;
  uint32_t index = 0;
  double probability = 1.0;
  while (!(nodes_[index].child & kLeaf)) {
    const Node& node = nodes_[index];
    const float first = importance(nodes_[node.child].cluster);
    const float second = importance(nodes_[node.child + 1].cluster);
    const double sum = double{first} + second;
    if (!(sum > 0.0)) return std::nullopt;
    const bool has_slots = node.slot != kNoSlot;
    double chosen = first / sum;
    if (has_slots && first > 0.0f && second > 0.0f) chosen = 0.25 + 0.5 * chosen;
    const uint32_t turn = u < chosen ? 0 : 1;
    u = std::min(turn == 0 ? u / chosen : (u - chosen) / (1.0 - chosen), 1.0 - 0x1p-53);
    probability *= turn == 0 ? chosen : 1.0 - chosen;
    if (has_slots) turns.push_back({node.slot + turn, turn == 0 ? first : second, probability});
    index = node.child + turn;
  }
  return Surveyed{static_cast<int>(nodes_[index].child & ~kLeaf), probability};
}

std::optional<LightTree::Choice> LightTree::sample_along(const Ray& ray, float t_max,
                                                         double u) const {
  return sample(importance_along(ray, t_max), u, {});
}
double LightTree::pmf_along(const Ray& ray, float t_max, int light) const {
  return pmf(importance_along(ray, t_max), light, nullptr).plain;
}

const LightCluster* LightTree::leaf(int light) const {
  if (!contains(light)) return nullptr;
  const Node* node = &nodes_[0];
  for (uint64_t trail = trails_[light].bits; !(node->child & kLeaf); trail >>= 1)
    node = &nodes_[node->child + (trail & 1)];
  return &node->cluster;
}

}  // namespace nephroid
