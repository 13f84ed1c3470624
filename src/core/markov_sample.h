// The random numbers of a path as the state of a Markov chain: each proposal moves all of them, a
// little or anywhere, and is then accepted or rejected. Numbers are moved when they are asked for.
// Who calls it: integrators of Metropolis light transport. It must not know what the numbers are
// for. Paper: Kelemen, Szirmay-Kalos, Antal & Csonka 2002; equations [Z1] and [Z3] of
// docs/estimators.md.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/sampler.h"

namespace nephroid {

/// How far a small step goes: evenly distributed on a logarithmic scale between the two, in either
/// direction. Numbers lie on a ring of length 1.
struct SmallStep {
  float shortest = 1.0f / 1024;
  float longest = 1.0f / 16;
};

/// A number in [0,1) after a small step; `bits` choose length and direction, evenly.
float after_small_step(float number, const SmallStep& step, uint32_t bits);

class MarkovSample {
 public:
  /// Sequences of numbers that do not disturb each other, each with dimensions from 0.
  static constexpr int kStreams = 3;
  /// The numbers of the first state.
  using Origin = std::function<float(int stream, int dimension)>;

  explicit MarkovSample(const SmallStep& step);
  MarkovSample(const MarkovSample&) = delete;
  MarkovSample& operator=(const MarkovSample&) = delete;

  /// Begins a chain in the state `origin`. All later numbers are a function of the seed.
  void start(Origin origin, uint64_t seed);

  /// The numbers of the proposal, or, if there is none, of the current state.
  PrimarySample& stream(int index) { return streams_[index]; }

  /// Proposes a new state: with probability `large_step` all numbers anew, else all by small steps.
  /// Returns true for a large step. The last proposal has been accepted or rejected.
  bool propose(float large_step);
  /// The proposal becomes the current state.
  void accept();
  /// The current state is what it was before the proposal, bit by bit.
  void reject();

  /// A number in [0,1) that belongs to the proposal and to no dimension, to decide on it by.
  float decision() const { return decision(kDecide); }

 private:
  struct Coordinate {
    float value = 0;
    uint32_t start = kNever;  ///< large step that its value began with; 0 is the origin
    uint32_t moves = 0;       ///< accepted small steps since then that it has made
    uint32_t asked = kNever;  ///< proposal in which it was last asked for
  };
  struct Backup {
    int stream, dimension;
    Coordinate coordinate;
  };
  class Stream : public PrimarySample {
   public:
    float number(int dimension) override { return owner->number(index, dimension); }
    MarkovSample* owner = nullptr;
    int index = 0;
  };
  static constexpr uint32_t kNever = 0xffffffffu;

  static constexpr uint32_t kChoose = 0, kDecide = 1;  ///< what a proposal's own numbers are for

  float number(int stream, int dimension);
  float decision(uint32_t use) const;
  uint32_t bits(uint32_t proposal, int stream, int dimension) const;
  /// The number right after the large step `proposal`.
  float drawn(uint32_t proposal, int stream, int dimension) const;
  void bring_up_to_date(Coordinate& c, int stream, int dimension) const;

  Origin origin_;
  uint64_t seed_ = 0;
  SmallStep step_;
  std::array<Stream, kStreams> streams_;
  std::array<std::vector<Coordinate>, kStreams> coordinates_;
  std::vector<Backup> backups_;  ///< of what the open proposal has moved
  uint32_t number_of_proposal_ = 0;
  bool open_ = false, large_ = false;
  uint32_t start_ = 0;           ///< last large step that was accepted; 0: none
  std::vector<uint32_t> moves_;  ///< small steps accepted since then
};

}  // namespace nephroid
