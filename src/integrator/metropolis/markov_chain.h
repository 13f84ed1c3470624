// Metropolis light transport over any function from random numbers to light on the film: a pass
// draws paths independently, starts chains at some of them, and adds up what both find. Each pass
// is unbiased by itself. It must not know scenes, routes or how paths are made. Papers: Veach &
// Guibas 1997; Kelemen et al. 2002; equations [Z2] to [Z5] of docs/estimators.md.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/markov_sample.h"
#include "core/pass_control.h"
#include "film/splats.h"
#include "integrator/metropolis/film_importance.h"

namespace nephroid {

/// The light that one set of random numbers brings to the film.
struct FoundLight {
  std::vector<Splat> splats;
  size_t kind = 0;         ///< which of a function's kinds of paths it is, for the pilot
  uint64_t rays = 0;       ///< counted over all calls
  std::vector<Splat> bad;  ///< values that were not finite, over all calls

  /// Adds what a part of the film receives, per number in the unit cube; black adds nothing.
  void add(const Vec2f& film, size_t part, const Rgb& value);
  /// [Z2]: what chains are in proportion to: how bright all of it is, times how important the film
  /// is there. Positive unless all is black.
  double target(const FilmImportance& importance) const;
};
/// The mean of the magnitudes of a colour's components.
double brightness_of(const Rgb& color);

/// What chains explore. Equal numbers give equal light.
class PathFunction {
 public:
  virtual ~PathFunction() = default;
  /// Adds to `found`, whose splats are empty.
  virtual void evaluate(MarkovSample& numbers, FoundLight& found) = 0;
};
/// Makes one for each task, so that it may keep memory of its own.
using PathFunctionMaker = std::function<std::unique_ptr<PathFunction>()>;

struct ChainSettings {
  int64_t bootstrap = 0;  ///< paths drawn independently, from some of which chains start
  int64_t chains = 0;
  int64_t mutations = 0;    ///< of each chain
  float large_step = 0.3f;  ///< probability of a mutation to propose numbers that are all new
  SmallStep small_step;
};

/// What a few paths that no pass draws tell about all of them.
struct ChainPilot {
  FilmImportance importance;
  std::vector<double> kinds;  ///< what paths of each kind add to the mean squared target
  /// [Z5]: the target at which chains are as good as independent paths, its mean. The picture is
  /// right for any positive one that does not depend on the pass.
  double balance = 1;

  static void members(auto& self, auto& archive) {
    archive(self.importance, self.kinds, self.balance);
  }
  bool is_sound() const;
};

/// One chain, step by step.
class MarkovChain {
 public:
  /// `origin` are the numbers of the first state; all later ones are a function of `seed`.
  MarkovChain(MarkovSample::Origin origin, uint64_t seed, const ChainSettings& settings,
              const FilmImportance& importance, PathFunction& function);

  /// Draws the next proposal and evaluates it.
  void propose();
  bool is_large() const { return large_; }
  /// [Z3]: the probability with which decide() accepts the proposal.
  double acceptance() const;
  /// True if the proposal is now the current state.
  bool decide();
  const FoundLight& current() const { return states_[now_]; }
  const FoundLight& proposed() const { return states_[1 - now_]; }
  double target() const { return targets_[now_]; }
  double proposed_target() const { return targets_[1 - now_]; }

 private:
  void evaluate(size_t state);

  MarkovSample numbers_;
  PathFunction& function_;
  const FilmImportance& importance_;
  float large_step_;
  FoundLight states_[2];
  double targets_[2] = {0, 0};
  size_t now_ = 0;
  bool large_ = false;
};

/// Counts of one or more passes.
struct ChainStatistics {
  uint64_t rays = 0, paths = 0;  ///< paths: bootstrap and mutations
  uint64_t bootstrap = 0, bootstrap_lit = 0;
  uint64_t large = 0, large_accepted = 0, small = 0, small_accepted = 0;
  uint64_t splats = 0;
  void add(const ChainStatistics& o);
};

/// Learns from `count` paths: a function of the seed.
ChainPilot look_around(uint64_t seed, int64_t count, const FilmArea& area, size_t kinds,
                       const PathFunctionMaker& make, PassControl& control = unwatched);

/// Adds all that the paths of a pass find to `buffer`, to be finished with the scale 1.
void render_chains(const PassKey& key, const ChainSettings& settings, const ChainPilot& pilot,
                   const PathFunctionMaker& make, SplatBuffer& buffer, ChainStatistics& statistics,
                   PassControl& control = unwatched);

}  // namespace nephroid
