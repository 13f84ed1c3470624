// Ear clipping. A corner found to be no ear is not tested again until a neighbour is cut off. So
// about 3 n corners are tested, each against the reflex corners only.
#include "input/polygon_triangles.h"

#include <algorithm>

namespace nephroid {
namespace {

using Vec2d = Imath::V2d;

/// Twice the area vector of the polygon (Newell's normal), seen from its first corner.
Vec3d newell_normal(std::span<const Vec3f> corners) {
  const Vec3d origin = to_double(corners[0]);
  Vec3d sum(0, 0, 0);
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (to_double(corners[i]) - origin).cross(to_double(corners[i + 1]) - origin);
  return sum;
}

/// Twice the signed area of a triangle, positive if it winds counter-clockwise.
double area2(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

class EarClipper {
 public:
  /// `normal` is not zero.
  EarClipper(std::span<const Vec3f> corners, const Vec3d& normal) : nodes_(corners.size()) {
    const Vec3d z = normal / normal.length();
    const Vec3d away = std::abs(z.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d x = z.cross(away).normalized(), y = z.cross(x);
    const Vec3d origin = to_double(corners[0]);
    const size_t n = corners.size();
    for (size_t i = 0; i < n; ++i) {
      const Vec3d p = to_double(corners[i]) - origin;
      nodes_[i].p = Vec2d(p.dot(x), p.dot(y));
      nodes_[i].previous = (i + n - 1) % n;
      nodes_[i].next = (i + 1) % n;
    }
    for (size_t i = 0; i < n; ++i) {
      nodes_[i].is_reflex = !is_convex(i);
      if (nodes_[i].is_reflex) reflex_.push_back(i);
    }
  }

  std::vector<uint32_t> run() {
    std::vector<uint32_t> triangles;
    triangles.reserve(3 * (nodes_.size() - 2));
    size_t left = nodes_.size(), at = 0, missed = 0;
    int rounds = 0;
    while (left > 3) {
      if (may_clip(at, rounds)) {
        clip(at, triangles);
        at = nodes_[at].next;
        --left;
        missed = 0;
        continue;
      }
      at = nodes_[at].next;
      if (++missed < left) continue;
      // No ear was found: test all again, with weaker conditions after some rounds.
      ++rounds;
      missed = 0;
      for (size_t k = 0; k < left; ++k, at = nodes_[at].next) nodes_[at].may_be_ear = true;
    }
    append(at, triangles);
    return triangles;
  }

 private:
  struct Node {
    Vec2d p;
    size_t previous = 0, next = 0;
    bool may_be_ear = true;
    bool is_reflex = false;  ///< not convex, and not cut off yet
  };
  /// Full rounds without an ear before the conditions are weakened. Except for rounding, polygons
  /// that do not cross themselves need at most one.
  static constexpr int kExactRounds = 4, kConvexRounds = 6;

  bool is_convex(size_t i) const {
    const Node& node = nodes_[i];
    return area2(nodes_[node.previous].p, node.p, nodes_[node.next].p) > 0.0;
  }

  bool may_clip(size_t i, int rounds) {
    if (rounds > kConvexRounds) return true;
    if (!nodes_[i].may_be_ear) return false;
    const bool ear = is_convex(i) && (rounds > kExactRounds || is_empty(i));
    nodes_[i].may_be_ear = ear;
    return ear;
  }

  /// True if no reflex corner lies in or on the triangle of a convex corner. Corners that coincide
  /// with the triangle's do not count: holes are connected by double edges.
  bool is_empty(size_t i) const {
    const Vec2d a = nodes_[nodes_[i].previous].p, b = nodes_[i].p, c = nodes_[nodes_[i].next].p;
    const double low_x = std::min({a.x, b.x, c.x}), high_x = std::max({a.x, b.x, c.x});
    const double low_y = std::min({a.y, b.y, c.y}), high_y = std::max({a.y, b.y, c.y});
    for (const size_t k : reflex_) {
      const Vec2d& p = nodes_[k].p;
      if (!nodes_[k].is_reflex) continue;
      if (p.x < low_x || p.x > high_x || p.y < low_y || p.y > high_y) continue;
      if (p == a || p == b || p == c) continue;
      if (area2(a, b, p) >= 0.0 && area2(b, c, p) >= 0.0 && area2(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  void append(size_t i, std::vector<uint32_t>& triangles) const {
    for (const size_t corner : {i, nodes_[i].next, nodes_[i].previous})
      triangles.push_back(static_cast<uint32_t>(corner));
  }

  void clip(size_t i, std::vector<uint32_t>& triangles) {
    append(i, triangles);
    const size_t before = nodes_[i].previous, after = nodes_[i].next;
    nodes_[before].next = after;
    nodes_[after].previous = before;
    nodes_[before].may_be_ear = nodes_[after].may_be_ear = true;
    // The removed corner, and neighbours that have become convex, no longer block ears.
    settle(i, false);
    settle(before, !is_convex(before));
    settle(after, !is_convex(after));
    if (2 * settled_ < reflex_.size()) return;
    std::erase_if(reflex_, [this](size_t k) { return !nodes_[k].is_reflex; });
    settled_ = 0;
  }

  /// Updates whether a corner is reflex; a corner that is not never becomes so again.
  void settle(size_t i, bool is_reflex) {
    if (!nodes_[i].is_reflex || is_reflex) return;
    nodes_[i].is_reflex = false;
    ++settled_;
  }

  std::vector<Node> nodes_;
  std::vector<size_t> reflex_;  ///< corners that were reflex at the last cleanup
  size_t settled_ = 0;          ///< number of them that are no longer reflex
};

}  // namespace

std::vector<uint32_t> triangulate_polygon(std::span<const Vec3f> corners) {
  if (corners.size() < 3) return {};
  const Vec3d normal = newell_normal(corners);
  if (normal.length() > 0.0) return EarClipper(corners, normal).run();
  std::vector<uint32_t> fan;
  for (uint32_t i = 1; i + 1 < corners.size(); ++i)
    for (const uint32_t corner : {0u, i, i + 1}) fan.push_back(corner);
  return fan;
}

}  // namespace nephroid
