#include "integrator/learning/direction_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/equal_area_map.h"

namespace nephroid {

namespace {

constexpr int kMaxCuts = 20;
/// A quarter is cut if it has at least this many directions and more than this share of the mass.
constexpr size_t kToCut = 32;
constexpr double kMassToCut = 0.02;

/// Quarter of the unit square that contains a point; maps the point to coordinates of the quarter.
size_t quarter_of(Vec2f& p) {
  p = p * 2.0f;
  const bool right = p.x >= 1.0f, upper = p.y >= 1.0f;
  if (right) p.x -= 1.0f;
  if (upper) p.y -= 1.0f;
  return (right ? 1 : 0) + (upper ? 2 : 0);
}

/// Chooses between two masses by `x` and rescales it for reuse. True for the second.
bool choose(float& x, float first, float second) {
  const float p = first / (first + second);
  const bool chosen = x >= p;
  x = std::min(chosen ? (x - p) / (1.0f - p) : x / p, kOneMinusEpsilon);
  return chosen;
}

double sum_of(std::span<const DirectionMoment> found) {
  double sum = 0;
  for (const DirectionMoment& f : found) sum += f.moment;
  return sum;
}

class TreeMaker {
 public:
  TreeMaker(std::vector<DirectionTree::Node>& nodes, double sum)
      : nodes_(nodes), root_(nodes.size()), least_(kMassToCut * std::sqrt(sum)) {}

  /// Appends a node with its children and returns its mass.
  double add(std::span<const DirectionMoment> found, double area, int cuts) {
    const size_t index = nodes_.size();
    nodes_.emplace_back();
    std::array<std::vector<DirectionMoment>, 4> quarters;
    for (DirectionMoment f : found) {
      const size_t quarter = quarter_of(f.square);
      quarters[quarter].push_back(f);
    }
    double total = 0;
    for (size_t i = 0; i < quarters.size(); ++i) {
      double mass = std::sqrt(sum_of(quarters[i]) * area / 4);
      if (mass > least_ && quarters[i].size() >= kToCut && cuts < kMaxCuts) {
        nodes_[index].child[i] = static_cast<uint32_t>(nodes_.size() - root_);
        mass = add(quarters[i], area / 4, cuts + 1);
      }
      nodes_[index].mass[i] = static_cast<float>(mass);
      total += mass;
    }
    return total;
  }

 private:
  std::vector<DirectionTree::Node>& nodes_;
  const size_t root_;
  const double least_;
};

}  // namespace

void append_direction_tree(std::vector<DirectionMoment> found,
                           std::vector<DirectionTree::Node>& nodes) {
  const double sum = sum_of(found);
  if (sum > 0) TreeMaker(nodes, sum).add(found, 1, 0);
}

bool DirectionTree::Node::is_sound() const {
  const float sum = mass[0] + mass[1] + mass[2] + mass[3];
  return std::ranges::all_of(mass, [](float m) { return m >= 0; }) && sum > 0 && std::isfinite(sum);
}

bool is_sound_tree(std::span<const DirectionTree::Node> nodes) {
  for (size_t i = 0; i < nodes.size(); ++i)
    for (const uint32_t child : nodes[i].child)
      if (child != 0 && (child <= i || child >= nodes.size())) return false;
  return !nodes.empty();
}

Vec3f DirectionTree::sample(float&, const Vec2f& u) const {
  Vec2f v = u, corner(0, 0);
  float size = 1;
  for (const Node* node = root_;;) {
    const float* m = node->mass;
    size *= 0.5f;
    const bool right = choose(v.x, m[0] + m[2], m[1] + m[3]);
    const bool upper = choose(v.y, m[right ? 1 : 0], m[right ? 3 : 2]);
    corner = corner + Vec2f(right ? size : 0.0f, upper ? size : 0.0f);
    const uint32_t child = node->child[(right ? 1 : 0) + (upper ? 2 : 0)];
    if (child == 0) return equal_area_square_to_sphere(corner + v * size);
    node = root_ + child;
  }
}

float DirectionTree::pdf_w(const Vec3f& w) const {
  return pdf_w(equal_area_sphere_to_square(w));
}

float DirectionTree::pdf_w(const Vec2f& square) const {
  Vec2f p(std::min(square.x, kOneMinusEpsilon), std::min(square.y, kOneMinusEpsilon));
  float density = kInv4Pi;
  for (const Node* node = root_;;) {
    const float* m = node->mass;
    const size_t quarter = quarter_of(p);
    if (!(m[quarter] > 0)) return 0;
    density *= 4 * m[quarter] / (m[0] + m[1] + m[2] + m[3]);
    const uint32_t child = node->child[quarter];
    if (child == 0) return density;
    node = root_ + child;
  }
}

}  // namespace nephroid
