// A density of directions: a quadtree over the square of the equal-area map of the sphere, learned
// from single directions and the light found there ([Q2] and [Q3] in docs/estimators.md). It must
// not know places. Paper: Mueller, Gross & Novak 2017.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// A view of a quadtree, and the share of directions that should follow it.
class DirectionTree {
 public:
  struct Node {
    float mass[4] = {};      ///< [quarter] bit 0 is the half along x, bit 1 along y
    uint32_t child[4] = {};  ///< [quarter] index of the child from the root; 0: none
    static void members(auto& self, auto& archive) { archive(self.mass, self.child); }
    /// True if the masses are valid and not all zero.
    bool is_sound() const;
  };

  /// An empty tree.
  DirectionTree() = default;
  /// The nodes must outlive the view and must not move.
  DirectionTree(const Node* root, float share) : root_(root), share_(share) {}

  bool empty() const { return root_ == nullptr; }
  /// s of [Q4], the share of directions that should follow the tree; below 1.
  float share() const { return share_; }
  /// A unit world direction from numbers in [0,1); does not use `uc`.
  Vec3f sample(float& uc, const Vec2f& u) const;
  /// Density per steradian.
  float pdf_w(const Vec3f& w) const;
  /// The same for a direction given as a point of the square.
  float pdf_w(const Vec2f& square) const;

 private:
  const Node* root_ = nullptr;
  float share_ = 0;
};

/// A direction as a point of the square, and its m of [Q2].
struct DirectionMoment {
  Vec2f square;
  double moment = 0;
};

/// [Q3] Appends the tree of least variance to `nodes`, root first; nothing if no light was found.
void append_direction_tree(std::vector<DirectionMoment> found,
                           std::vector<DirectionTree::Node>& nodes);

/// True if every descent through these nodes, the root first, stays among them and ends.
bool is_sound_tree(std::span<const DirectionTree::Node> nodes);

}  // namespace nephroid
