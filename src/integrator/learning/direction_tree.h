// A density of directions: a quadtree over the square that the equal-area map makes of the sphere,
// learned from single directions and what was found there ([Q2] and [Q3] in docs/estimators.md). It
// must not know places. Paper: Mueller, Gross & Novak 2017.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace nephroid {

/// A view of a quadtree, and how much of the directions should follow it.
class DirectionTree {
 public:
  struct Node {
    float mass[4] = {};      ///< of the quarters; bit 0 is the half along x, bit 1 along y
    uint32_t child[4] = {};  ///< counted from the root; 0: none
    static void members(auto& self, auto& archive) { archive(self.mass, self.child); }
    /// Has something to choose among.
    bool is_sound() const;
  };

  /// Has no directions.
  DirectionTree() = default;
  /// The nodes must stay where they are.
  DirectionTree(const Node* root, float share) : root_(root), share_(share) {}

  bool empty() const { return root_ == nullptr; }
  /// Of the directions that should follow it, below 1.
  float share() const { return share_; }
  /// A unit direction, world, from numbers in [0,1); leaves `uc` as it is.
  Vec3f sample(float& uc, const Vec2f& u) const;
  /// Per steradian.
  float pdf_w(const Vec3f& w) const;
  /// The same for a point of the square.
  float pdf_w(const Vec2f& square) const;

 private:
  const Node* root_ = nullptr;
  float share_ = 0;
};

/// A direction as a point of the square, and its part of an integral over directions, [Q2].
struct DirectionMoment {
  Vec2f square;
  double moment = 0;
};

/// [Q3] The tree of least variance, appended to `nodes`, its root first; nothing if nothing was
/// found.
void append_direction_tree(std::vector<DirectionMoment> found,
                           std::vector<DirectionTree::Node>& nodes);

/// True if walks down a tree of these nodes, the root first, stay among them and come to an end.
bool is_sound_tree(std::span<const DirectionTree::Node> nodes);

}  // namespace nephroid
