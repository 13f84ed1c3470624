// Metropolis light transport over any function from random numbers to light on the film ([Z2] to
// [Z5] in docs/estimators.md). A pass draws independent paths, starts chains at some of them and
// adds up the light of both, without bias. It must not know scenes, routes or how paths are made.
// Papers: Veach & Guibas 1997; Kelemen et al. 2002.
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
  size_t kind = 0;         ///< kind of the path, for the pilot
  uint64_t rays = 0;       ///< rays of all calls
  std::vector<Splat> bad;  ///< non-finite values of all calls

  /// Adds a splat to a part: its share of f(u), per volume of the unit cube. Black adds nothing.
  void add(const Vec2f& film, size_t part, const Rgb& value);
  /// g of [Z2], the target of chains: brightness of all splats times importance of their places.
  /// Positive unless all are black.
  double target(const FilmImportance& importance) const;
};
/// The mean of the magnitudes of a colour's components.
double brightness_of(const Rgb& color);

/// The function f(u) that chains explore. Equal numbers give equal light.
class PathFunction {
 public:
  virtual ~PathFunction() = default;
  /// Adds the light to `found`, which has no splats yet.
  virtual void evaluate(MarkovSample& numbers, FoundLight& found) = 0;
};
/// Makes a function for each task, so that it may have memory of its own.
using PathFunctionMaker = std::function<std::unique_ptr<PathFunction>()>;

struct ChainSettings {
  int64_t bootstrap = 0;  ///< independent paths, at some of which chains start
  int64_t chains = 0;
  int64_t mutations = 0;    ///< mutations per chain
  float large_step = 0.3f;  ///< p_L, probability that a mutation proposes all numbers anew
  SmallStep small_step;
};

/// Findings of a few pilot paths that no pass draws.
struct ChainPilot {
  FilmImportance importance;
  std::vector<double> kinds;  ///< [kind] contribution to the mean squared target
  /// b of [Z5], the mean target. The picture is unbiased for any positive value that does not
  /// depend on the pass.
  double balance = 1;

  static void members(auto& self, auto& archive) {
    archive(self.importance, self.kinds, self.balance);
  }
  bool is_sound() const;
};

/// One chain, step by step.
class MarkovChain {
 public:
  /// `origin` gives the numbers of the first state; later ones are a function of `seed`.
  MarkovChain(MarkovSample::Origin origin, uint64_t seed, const ChainSettings& settings,
              const FilmImportance& importance, PathFunction& function);

  /// Draws the next proposal and evaluates it.
  void propose();
  bool is_large() const { return large_; }
  /// a of [Z3], the probability that decide() accepts the proposal.
  double acceptance() const;
  /// Accepts or rejects the proposal; true if it is now the current state.
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

/// Runs a pilot of `count` paths; the result is a function of the seed.
ChainPilot look_around(uint64_t seed, int64_t count, const FilmArea& area, size_t kinds,
                       const PathFunctionMaker& make, PassControl& control = unwatched);

/// Adds the light of all paths of a pass to `buffer`, which must be finished with scale 1.
void render_chains(const PassKey& key, const ChainSettings& settings, const ChainPilot& pilot,
                   const PathFunctionMaker& make, SplatBuffer& buffer, ChainStatistics& statistics,
                   PassControl& control = unwatched);

}  // namespace nephroid
