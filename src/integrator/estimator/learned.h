// What an estimator finds out about a scene before its passes, or from the first of them: a value
// that does not change once it is made. A pass is a function of the pass key, the scene and this.
#pragma once

#include <memory>

#include "core/byte_archive.h"
#include "integrator/estimator/estimator_statistics.h"

namespace nephroid {

class Learned {
 public:
  virtual ~Learned() = default;
  /// All that passes depend on; Estimator::read_learned makes an equal value of it.
  virtual void write(ByteWriter& to) const = 0;
  /// Adds what learning cost, the memory that the value takes, and what was found, in words.
  virtual void add_to(EstimatorStatistics& statistics) const = 0;
};

/// What the first pass leaves for the estimator to learn from, which is more than its light.
class PassFindings {
 public:
  virtual ~PassFindings() = default;
};

/// What an estimator has learned for one seed. The second value is for all passes after the first;
/// where nothing is learned from the first pass, it is the first value.
struct LearnedValues {
  std::shared_ptr<const Learned> before_passes, after_first_pass;
};

}  // namespace nephroid
