// Random light path expressions and sets of routes, the same for the same seed on every machine.
// Who calls it: tests of routes.
#pragma once

#include <cstdint>
#include <random>

#include "routes/oracle_routes.h"

namespace nephroid::oracle {

class RandomRoutes {
 public:
  /// `labels`: names of materials and lights that expressions may mention.
  RandomRoutes(uint32_t seed, std::vector<std::string> labels);

  /// Two to five routes, most often followed by `rest=.*:path`, and up to two AOVs. Each expression
  /// matches some path. Some sets have holes, overlaps, or routes without a merge vertex.
  OracleRoutes set();
  /// A whole expression, with marks (at most one at a time in most readings) if `marked`.
  Tree expression(bool marked);
  /// A number in [0, n).
  int below(int n) { return static_cast<int>(random_() % static_cast<uint32_t>(n)); }

 private:
  bool chance(int percent) { return below(100) < percent; }
  Atom event();
  Atom light();
  Atom rough();
  /// A part of an expression for events.
  Tree events(int depth);
  Tree repeated(Tree tree);

  std::mt19937 random_;
  std::vector<std::string> labels_;
};

}  // namespace nephroid::oracle
