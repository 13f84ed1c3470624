// What an estimator finds out about a scene before its passes: a value that does not change once it
// is made. A pass is a function of the pass key, the scene and this.
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

}  // namespace nephroid
