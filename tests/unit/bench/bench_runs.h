// Suites with pictures of a few pixels, each run in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/kept.h"
#include "source_directory.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {

inline const std::string kRoom =
    testing_support::source_directory() + "/scenes/caustic-room/scene.pbrt";

/// A suite of 8 x 8 pixels. `more` adds scenes, with a leading comma.
inline std::string small_suite(const std::string& more = "") {
  return R"({"name": "tiny", "title": "Tiny <suite>", "description": "One.\n\nTwo & three.",
    "passes": 4,
    "integrators": [{"name": "path", "integrator": "path"},
                    {"name": "mixed", "integrator": "mixed", "options": {"photons": 1024}}],
    "scenes": [{"name": "room", "file": ")" +
         kRoom + R"(", "resolution": [8, 8], "reference": {"integrator": "path", "passes": 6},
                "energy": {"direct": "C[DG]?L"}, "layer": {"lit": "C[DG]L"},
                "region": {"left": [0, 0.5, 0, 1]}})" +
         more + R"(],
    "claims": [{"text": "mixed stores photons", "metric": "photons", "of": "mixed",
                "between": [1, 1e9]}]})";
}

class BenchRuns : public ::testing::Test {
 protected:
  BenchResults run(const std::string& suite, const std::vector<std::string>& only = {}) {
    BenchOptions options = options_;
    options.directory = scratch_.file("out");
    options.only = only;
    options.command = "nephroid bench tiny.json";
    said_.clear();
    options.say = [this](const std::string& line) { said_ += line + "\n"; };
    return run_bench(parse_suite(suite, "tiny.json"), options, signals_);
  }
  std::string file(const std::string& name) const {
    return text_of_file(scratch_.file("out/" + name)).value_or("");
  }

  ScratchDirectory scratch_;
  BenchOptions options_;  ///< options other than those that run() sets
  SignalFlags signals_;
  std::string said_;
};

}  // namespace nephroid
