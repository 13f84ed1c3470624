// `mlt`: Markov chains that choose one technique of bidirectional path tracing for each path, so
// that they stay with the techniques that are good where they are (Hachisuka, Kaplanyan &
// Dachsbacher 2014). A pass is a function of the scene, the options and the pass key, and unbiased
// by itself (docs/estimators.md, [Z7]). It must not know how pairs of paths
// are connected or chains are run.
#pragma once

#include "integrator/estimator/estimator.h"
#include "integrator/metropolis/metropolis_pass.h"
#include "route/scene_symbols.h"

namespace nephroid {

/// How often paths of each kind are tried: of each length, in scattering events, by each technique.
class KindChoice {
 public:
  struct Chosen {
    int length;
    int s;              ///< vertices of the light side
    size_t kind;        ///< counted over lengths and techniques
    float probability;  ///< of this kind
  };
  /// By a guess.
  explicit KindChoice(int max_length);
  /// [Z8]: by the mean of the squared target of each kind where `guess` chose;
  /// the guess keeps a share, so that no kind is left out.
  KindChoice(const KindChoice& guess, std::span<const double> mean_squares);
  Chosen choose(const Vec2f& u) const;
  size_t lengths() const { return techniques_.size(); }
  size_t kinds() const { return first_kind_.back(); }

 private:
  /// One of a few, with probabilities in proportion to weights.
  struct Table {
    std::vector<double> probability, cdf;
    explicit Table(std::vector<double> weights);
    size_t choose(float u) const;
  };
  KindChoice() : length_({1.0}) {}

  Table length_;
  std::vector<Table> techniques_;   ///< of each length
  std::vector<size_t> first_kind_;  ///< of each length, and one behind the last
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
