// The random numbers of a path as the state of a Markov chain, for Metropolis light transport. Each
// proposal moves all of them by small steps or a large one; they are moved lazily. Equations [Z1]
// and [Z3] of docs/estimators.md. It must not know what the numbers are for.
// Paper: Kelemen, Szirmay-Kalos, Antal & Csonka 2002.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/sampler.h"

namespace nephroid {

/// Bounds of a small step's length, s_1 and s_2 of [Z1]. It is uniform on a logarithmic scale, in
/// either direction; numbers wrap around at 1.
struct SmallStep {
  float shortest = 1.0f / 1024;
  float longest = 1.0f / 16;
};

/// A number in [0,1) after a small step; random `bits` choose its length and direction.
float after_small_step(float number, const SmallStep& step, uint32_t bits);

class MarkovSample {
 public:
  /// Number of independent sequences, each with dimensions from 0.
  static constexpr int kStreams = 3;
  /// The numbers of the first state.
  using Origin = std::function<float(int stream, int dimension)>;

  explicit MarkovSample(const SmallStep& step);
  MarkovSample(const MarkovSample&) = delete;
  MarkovSample& operator=(const MarkovSample&) = delete;

  /// Starts a chain in the state `origin`. All later numbers are a function of the seed.
  void start(Origin origin, uint64_t seed);

  /// The numbers of the proposal or, if there is none, of the current state.
  PrimarySample& stream(int index) { return streams_[index]; }

  /// Proposes a new state: with probability `large_step` by a large step (all numbers anew), else
  /// by small steps. Returns true for a large step. The last proposal must have been decided.
  bool propose(float large_step);
  /// Makes the proposal the current state.
  void accept();
  /// Restores the state before the proposal, bit by bit.
  void reject();

  /// A number in [0,1) of the proposal, outside of all dimensions, for its acceptance test.
  float decision() const { return decision(kDecide); }

 private:
  struct Coordinate {
    float value = 0;
    uint32_t start = kNever;  ///< large step that drew its value; 0: the origin
    uint32_t moves = 0;       ///< accepted small steps since then that were applied to it
    uint32_t asked = kNever;  ///< proposal in which it was last read
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

  static constexpr uint32_t kChoose = 0, kDecide = 1;  ///< uses of a proposal's own numbers

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
  std::vector<Backup> backups_;  ///< coordinates before the open proposal moved them
  uint32_t number_of_proposal_ = 0;
  bool open_ = false, large_ = false;
  uint32_t start_ = 0;           ///< last accepted large step; 0: none
  std::vector<uint32_t> moves_;  ///< small steps accepted since then
};

}  // namespace nephroid
