// The immutable value that an estimator learns from a scene before its passes. A pass is a function
// of the pass key, the scene and this value.
#pragma once

#include <memory>

#include "core/byte_archive.h"
#include "integrator/estimator/estimator_statistics.h"

namespace nephroid {

class Learned {
 public:
  virtual ~Learned() = default;
  /// Writes all that passes depend on. Estimator::read_learned makes an equal value from it.
  virtual void write(ByteWriter& to) const = 0;
  /// Adds the cost of learning, the memory of the value, and the findings as sentences.
  virtual void add_to(EstimatorStatistics& statistics) const = 0;
};

}  // namespace nephroid
