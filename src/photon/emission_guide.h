// Where light paths are worth starting: spheres in the scene at which they are aimed, and how often
// from which lights, found by looking at which earlier paths were of use. A share of all paths
// starts as the lights themselves would have it, so that nothing is ever missed
// (docs/estimators.md, section 20). Immutable once made. It must not know routes, cameras or films.
// Papers: Grittmann et al. 2018, Vorba et al. 2014 for the idea of guided emission.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "photon/sound_places.h"
#include "photon/start_tree.h"
#include "scene/scene.h"

namespace nephroid {

class EmissionGuide {
 public:
  /// Share of the paths that start as the lights would have it.
  static constexpr double kDefensive = 0.125;
  static constexpr int kMaxPlaces = 32, kMaxTargets = 2 * kMaxPlaces, kMaxClusters = 256;

  /// Guides nothing: all paths start as the lights would have it.
  EmissionGuide() = default;
  /// Aims as much at each place among these points as the lights shine there; guides nothing if
  /// there are none.
  EmissionGuide(const Scene& scene, std::span<const Vec3f> casters);
  /// Learns from useful starts of `paths` paths; guides nothing if there are none.
  EmissionGuide(const Scene& scene, std::span<const UsefulStart> useful, double paths);

  bool empty() const { return targets_.empty(); }

  static void members(auto& self, auto& archive) {
    archive(self.targets_, self.lanes_, self.places_, self.share_unaimed_, self.clusters_,
            self.cluster_size_, self.entries_);
  }
  bool is_sound() const;
  /// Has a place for each light of a scene that has so many.
  bool fits(size_t lights) const;

  struct Target {
    Vec3f center{0, 0, 0};
    float radius = 0;
    static void members(auto& self, auto& archive) { archive(self.center, self.radius); }
    bool is_sound() const { return is_sound_ball(center, radius); }
  };
  std::span<const Target> targets() const { return targets_; }
  /// How many places it aims at. Their targets come first, then those around several or all.
  size_t places() const { return places_; }
  /// The part of all paths that would have been of use had they started as the lights have it, as
  /// far as those that were traced can tell.
  double share_unaimed() const { return share_unaimed_; }

  struct Choice {
    int light = 0;
    int target = -1;  ///< -1: as the light would have it
  };
  /// A light and what to aim at, from a number in [0,1). Empty if all lights are black.
  std::optional<Choice> choose(const Scene& scene, float u) const;

  /// The unit direction from `p` into a target's cone; empty if `p` is inside the target.
  std::optional<Vec3f> direction_to(int target, const Vec3f& p, const Vec2f& u) const;
  /// A point of the disk across unit `w` that hides the target.
  Vec3f point_across(int target, const Vec3f& w, const Vec2f& u) const;

  /// What takes the place of a light's own density of direction `w` at `p` (per steradian) or, for
  /// a light whose paths start on the scene's disk, of the ray through `p` along `w` (per area):
  /// times pmf_by_power() and the density of what is not guided it is the density of a start. What
  /// was aimed at target `aimed_at` counts as inside of it, on whichever side of a small one's edge
  /// rounding has put it: a path that nothing but chance seems to have sent there would weigh
  /// millions of times too much.
  double density(const Scene& scene, int light, const Vec3f& p, const Vec3f& w, double own,
                 int aimed_at = -1) const;
  /// Probability of a light over pmf_by_power().
  double gain(int light) const;

 private:
  struct Cluster {
    double pmf = 0;  ///< of its lights, by power
    /// Probability of each target with the cluster over that of the cluster; as long as `lanes_`.
    std::vector<double> shares;
    std::vector<double> cumulative;  ///< of its lights, by power
    static void members(auto& self, auto& archive) {
      archive(self.pmf, self.shares, self.cumulative);
    }
    bool is_sound() const;
  };
  size_t cluster_of(int light) const { return light / cluster_size_; }
  void gather_lights(const Scene& scene);
  /// A ball around those first hits, which lie within `extent` of `center`, of starts of `paths`
  /// paths.
  Target target_around(const Scene& scene, const Vec3f& center, float extent,
                       std::span<const UsefulStart> useful, std::span<const uint32_t> which,
                       double paths) const;
  /// How often to aim from each cluster at each of the targets, up to a factor, as [cluster *
  /// targets + target].
  std::vector<double> aims_at(const Scene& scene, std::span<const UsefulStart> useful,
                              std::span<const int> target_of, double paths) const;
  /// The part of what all lights emit that goes from a cluster through a target, roughly.
  double part_of_all(const Scene& scene, size_t cluster, const Target& target) const;
  void share_out(std::span<const double> aims);
  bool has_sound_entries() const;

  /// The targets once more, as density() reads them: several at a time, the last ones empty.
  struct Lanes {
    std::vector<float> x, y, z, radius2;
    static void members(auto& self, auto& archive) {
      archive(self.x, self.y, self.z, self.radius2);
    }
    bool operator==(const Lanes&) const = default;
  };

  static Lanes lanes_of(std::span<const Target> targets);

  std::vector<Target> targets_;
  Lanes lanes_;
  size_t places_ = 0;
  double share_unaimed_ = 0;
  std::vector<Cluster> clusters_;
  size_t cluster_size_ = 1;
  struct Entry {
    uint32_t cluster = 0;
    int target = 0;
    double cumulative = 0;
    static void members(auto& self, auto& archive) {
      archive(self.cluster, self.target, self.cumulative);
    }
  };
  std::vector<Entry> entries_;
};

/// Guides nothing.
inline const EmissionGuide kUnguided;

}  // namespace nephroid
