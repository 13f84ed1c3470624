// Guided emission: targets (spheres) learned from useful light paths, and how often each light aims
// at each. A fixed share of the paths is not guided, so that nothing is missed (docs/estimators.md,
// section 20). Immutable once made. It must not know routes, cameras or films.
// Papers: Vorba et al. 2014, Grittmann et al. 2018.
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
  /// Share of the paths that are not guided.
  static constexpr double kDefensive = 0.125;
  static constexpr int kMaxPlaces = 32, kMaxTargets = 2 * kMaxPlaces, kMaxClusters = 256;

  /// Guides nothing.
  EmissionGuide() = default;
  /// Targets around these points, [G6]. Guides nothing if there are none.
  EmissionGuide(const Scene& scene, std::span<const Vec3f> casters);
  /// Learns from the useful starts of `paths` paths. Guides nothing if there are none.
  EmissionGuide(const Scene& scene, std::span<const UsefulStart> useful, double paths);

  bool empty() const { return targets_.empty(); }

  static void members(auto& self, auto& archive) {
    archive(self.targets_, self.lanes_, self.places_, self.share_unaimed_, self.clusters_,
            self.cluster_size_, self.entries_);
  }
  bool is_sound() const;
  /// True if the guide was made for a scene with this many lights.
  bool fits(size_t lights) const;

  struct Target {
    Vec3f center{0, 0, 0};
    float radius = 0;
    static void members(auto& self, auto& archive) { archive(self.center, self.radius); }
    bool is_sound() const { return is_sound_ball(center, radius); }
  };
  std::span<const Target> targets() const { return targets_; }
  /// Number of places. Their targets come first, then those that enclose several places.
  size_t places() const { return places_; }
  /// Estimated share of useful paths without guiding.
  double share_unaimed() const { return share_unaimed_; }

  struct Choice {
    int light = 0;
    int target = -1;  ///< -1: not guided
  };
  /// Chooses a light and a target by a number in [0,1). Empty if all lights are black.
  std::optional<Choice> choose(const Scene& scene, float u) const;

  /// The unit direction from `p` into a target's cone; empty if `p` is inside the target.
  std::optional<Vec3f> direction_to(int target, const Vec3f& p, const Vec2f& u) const;
  /// A point on the disk around the target, perpendicular to the unit vector `w`.
  Vec3f point_across(int target, const Vec3f& w, const Vec2f& u) const;

  /// The bracket of [G1]. It replaces `own`, the light's own density: of direction `w` at `p`, per
  /// steradian, or of the ray through `p` along `w`, per area, if paths start on the scene's disk.
  /// Times pmf_by_power() and the density of the unguided coordinate it is the density of a start.
  /// A start guided to target `aimed_at` counts as inside of it, even if rounding puts it outside.
  /// Otherwise its path would weigh millions of times too much.
  double density(const Scene& scene, int light, const Vec3f& p, const Vec3f& w, double own,
                 int aimed_at = -1) const;
  /// Probability of a light with the guide, over pmf_by_power().
  double gain(int light) const;

 private:
  struct Cluster {
    double pmf = 0;  ///< probability of its lights, by power
    /// Probability of each target together with the cluster, over `pmf`; as long as `lanes_`.
    std::vector<double> shares;
    std::vector<double> cumulative;  ///< running sums of the lights' probabilities, by power
    static void members(auto& self, auto& archive) {
      archive(self.pmf, self.shares, self.cumulative);
    }
    bool is_sound() const;
  };
  size_t cluster_of(int light) const { return light / cluster_size_; }
  void gather_lights(const Scene& scene);
  /// [G5] A ball around the first hits of the starts `which`, found with `paths` paths. All of them
  /// lie within `extent` of `center`.
  Target target_around(const Scene& scene, const Vec3f& center, float extent,
                       std::span<const UsefulStart> useful, std::span<const uint32_t> which,
                       double paths) const;
  /// [G3] Unnormalized shares of the pairs of cluster and target, as [cluster * targets + target].
  std::vector<double> aims_at(const Scene& scene, std::span<const UsefulStart> useful,
                              std::span<const int> target_of, double paths) const;
  /// Approximate part of all emitted light that goes from a cluster through a target, A_lk.
  double part_of_all(const Scene& scene, size_t cluster, const Target& target) const;
  void share_out(std::span<const double> aims);
  bool has_sound_entries() const;

  /// The targets in the layout of density(), padded with empty ones to whole lanes.
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
