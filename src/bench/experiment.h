// Experiments that need no scene: curves of an error over passes, with the slopes that theory
// predicts. Who calls it: suite.cpp asks for names, bench.cpp runs them, the report draws them. It
// must not know suites.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/fit.h"

namespace nephroid {

struct ExperimentCurve {
  std::string name;
  std::vector<CurvePoint> points;  ///< error over passes
  double slope = 0;                ///< fitted in logarithms
  double predicted = 0;
};

/// Curves that belong into one plot.
struct ExperimentPart {
  std::string title, text;
  std::vector<ExperimentCurve> curves;
};

struct BenchExperiment {
  std::string name, title, text;
  std::vector<ExperimentPart> parts;
};

/// How much an experiment does: repetitions with other seeds, photons of a pass, passes.
struct ExperimentEffort {
  int seeds = 24;
  int photons = 10000;
  uint32_t passes = 512;
};

/// The names that run_experiment knows.
const std::vector<std::string>& experiment_names();

/// Runs an experiment by name, a function of its arguments alone. Throws UsageError for an unknown
/// name.
BenchExperiment run_experiment(const std::string& name, const ExperimentEffort& effort = {});

}  // namespace nephroid
