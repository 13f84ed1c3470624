// `mlt`, multiplexed Metropolis light transport: Markov chains over bidirectional paths, one
// technique per path, so that chains favour good techniques ([Z7] in docs/estimators.md). Passes
// are independent and unbiased. It must not know how path pairs are connected or chains are run.
// Paper: Hachisuka, Kaplanyan & Dachsbacher 2014.
#pragma once

#include "integrator/estimator/estimator.h"
#include "integrator/metropolis/metropolis_pass.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// Probabilities of path kinds. A kind is a length, in scattering events, and a technique.
class KindChoice {
 public:
  struct Chosen {
    int length;
    int s;              ///< light vertices
    size_t kind;        ///< index over lengths and techniques
    float probability;  ///< probability of this kind
  };
  /// P_0 of [Z8], a guess.
  explicit KindChoice(int max_length);
  /// P of [Z8], from the mean squared target of each kind where `guess` chose. The guess keeps a
  /// share, so that no kind is left out.
  KindChoice(const KindChoice& guess, std::span<const double> mean_squares);
  Chosen choose(const Vec2f& u) const;
  size_t lengths() const { return techniques_.size(); }
  size_t kinds() const { return first_kind_.back(); }

 private:
  /// A discrete distribution in proportion to weights.
  struct Table {
    std::vector<double> probability, cdf;
    explicit Table(std::vector<double> weights);
    size_t choose(float u) const;
  };
  KindChoice() : length_({1.0}) {}

  Table length_;
  std::vector<Table> techniques_;   ///< [length]
  std::vector<size_t> first_kind_;  ///< [length] index of its first kind; last: number of kinds
};

class Multiplexed : public Estimator {
 public:
  Multiplexed(OwnedRoutes owned, const IntegratorOptions& options);

  static const EstimatorDescriptor kDescriptor;
  const EstimatorDescriptor& descriptor() const override { return kDescriptor; }
  std::shared_ptr<const Learned> learn(const Scene& scene, const FilmFormat& film, uint64_t seed,
                                       PassControl& control) const override;
  std::shared_ptr<const Learned> read_learned(ByteReader& from, const FilmFormat&) const override;
  void render_pass(const PassKey& key, const Learned* learned, const Scene& scene, Film& film,
                   PassControl& control) override;
  EstimatorStatistics statistics() const override { return passes_.statistics(); }

 private:
  OwnedRoutes owned_;
  IntegratorOptions options_;
  MetropolisPasses passes_;
};

}  // namespace nephroid
