#include "core/markov_sample.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace nephroid {

float after_small_step(float number, const SmallStep& step, uint32_t bits) {
  // [Z1]: the sign is the lowest bit, the length comes from the others.
  const float u = bits_to_unit_float(bits);
  const float length = step.longest * std::exp(-std::log(step.longest / step.shortest) * u);
  float moved = (bits & 1u) != 0 ? number + length : number - length;
  if (moved >= 1.0f) moved -= 1.0f;
  if (moved < 0.0f) moved += 1.0f;
  // A sum just below zero rounds to one.
  return moved < 1.0f ? moved : 0.0f;
}

MarkovSample::MarkovSample(const SmallStep& step) : step_(step) {
  for (size_t s = 0; s < kStreams; ++s) {
    streams_[s].owner = this;
    streams_[s].index = static_cast<int>(s);
  }
}

void MarkovSample::start(Origin origin, uint64_t seed) {
  origin_ = std::move(origin);
  seed_ = mix_bits(seed);
  for (std::vector<Coordinate>& all : coordinates_) std::fill(all.begin(), all.end(), Coordinate{});
  backups_.clear();
  number_of_proposal_ = 0;
  open_ = false;
  start_ = 0;
  moves_.clear();
}

bool MarkovSample::propose(float large_step) {
  assert(!open_);
  ++number_of_proposal_;
  open_ = true;
  large_ = decision(kChoose) < large_step;
  return large_;
}

void MarkovSample::accept() {
  assert(open_);
  open_ = false;
  if (large_) {
    start_ = number_of_proposal_;
    moves_.clear();
  } else {
    moves_.push_back(number_of_proposal_);
  }
  for (const Backup& b : backups_) {
    Coordinate& c = coordinates_[b.stream][b.dimension];
    c.start = start_;
    c.moves = static_cast<uint32_t>(moves_.size());
  }
  backups_.clear();
}

void MarkovSample::reject() {
  assert(open_);
  open_ = false;
  for (const Backup& b : backups_) coordinates_[b.stream][b.dimension] = b.coordinate;
  backups_.clear();
}

float MarkovSample::decision(uint32_t use) const {
  return bits_to_unit_float(
      static_cast<uint32_t>(hash_combine(seed_, number_of_proposal_, kStreams, use) >> 32));
}

uint32_t MarkovSample::bits(uint32_t proposal, int stream, int dimension) const {
  const uint64_t place = static_cast<uint64_t>(stream) << 32 | static_cast<uint32_t>(dimension);
  return static_cast<uint32_t>(mix_bits(hash_combine(seed_, proposal) + mix_bits(place)) >> 32);
}

float MarkovSample::drawn(uint32_t proposal, int stream, int dimension) const {
  return proposal == 0 ? origin_(stream, dimension)
                       : bits_to_unit_float(bits(proposal, stream, dimension));
}

void MarkovSample::bring_up_to_date(Coordinate& c, int stream, int dimension) const {
  if (c.start != start_) {
    c.value = drawn(start_, stream, dimension);
    c.start = start_;
    c.moves = 0;
  }
  // Each step is made at most once, so this never costs more than moving every number at every
  // proposal.
  for (; c.moves < moves_.size(); ++c.moves)
    c.value = after_small_step(c.value, step_, bits(moves_[c.moves], stream, dimension));
}

float MarkovSample::number(int stream, int dimension) {
  std::vector<Coordinate>& all = coordinates_[stream];
  const size_t d = dimension;
  if (all.size() <= d) all.resize(d + d / 2 + 8);
  Coordinate& c = all[d];
  if (!open_) {
    bring_up_to_date(c, stream, dimension);
    return c.value;
  }
  if (c.asked == number_of_proposal_) return c.value;
  if (!large_) bring_up_to_date(c, stream, dimension);
  backups_.push_back({stream, dimension, c});
  const uint32_t random = bits(number_of_proposal_, stream, dimension);
  c.value = large_ ? bits_to_unit_float(random) : after_small_step(c.value, step_, random);
  c.asked = number_of_proposal_;
  return c.value;
}

}  // namespace nephroid
