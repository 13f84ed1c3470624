// Random light path expressions and route sets, the same for the same seed on every machine.
#pragma once

#include <cstdint>
#include <random>

#include "routes/oracle_routes.h"

namespace nephroid::oracle {

class RandomRoutes {
 public:
  /// `labels`: names of materials and lights that expressions may use.
  RandomRoutes(uint32_t seed, std::vector<std::string> labels);

  /// Two to five routes, usually followed by `rest=.*:path`, and up to two AOVs. Each expression
  /// matches some path. Some sets have holes, overlaps, or routes without a merge vertex.
  OracleRoutes set();
  /// A whole expression. If `marked`, it has marks, in most readings at most one.
  Tree expression(bool marked);
  /// A number in [0, n).
  int below(int n) { return static_cast<int>(random_() % static_cast<uint32_t>(n)); }

 private:
  bool chance(int percent) { return below(100) < percent; }
  Atom event();
  Atom light();
  Atom rough();
  /// The part of an expression that matches events.
  Tree events(int depth);
  Tree repeated(Tree tree);

  std::mt19937 random_;
  std::vector<std::string> labels_;
};

}  // namespace nephroid::oracle
