// MIS weights against brute force: for random paths, the densities of all techniques are computed
// one by one, without a recursion.
#include "transport/path_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace nephroid {
namespace {

// x_0 is on the lens, x_1 to x_k scatter, x_{k+1} is on the light.
struct RandomPath {
  int k = 1;
  std::vector<EventDensity> eye;   // [i]: forward is towards the light
  std::vector<LineFactors> lines;  // [i]: from x_i (a) to x_{i+1} (b)
  std::vector<double> merge;       // [i]: expected photons over area, 0 where none are merged
  double camera = 1, light_paths = 1;
  LightStart light;
};

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double number() { return std::ldexp(static_cast<double>(engine_()), -32); }
  double density() { return std::exp(8 * number() - 4); }
  bool chance(double p) { return number() < p; }

 private:
  std::mt19937 engine_;
};

RandomPath random_path(uint32_t seed) {
  Random random(seed);
  RandomPath path;
  path.k = 1 + static_cast<int>(6 * random.number());
  for (int i = 0; i <= path.k; ++i) {
    const bool finite = random.chance(0.75);
    path.eye.push_back(finite ? EventDensity{random.density(), random.density(), true}
                              : EventDensity{});
    path.lines.push_back({random.density(), random.density()});
    path.merge.push_back(finite && random.chance(0.7) ? random.density() : 0);
  }
  path.camera = random.density();
  path.light_paths = random.chance(0.8) ? random.density() : 0;
  path.light = {
      random.density(),
      random.density(),
      random.chance(0.9) ? random.density() : 0,
      random.chance(0.8),
      {path.lines[static_cast<size_t>(path.k)].at_b, path.lines[static_cast<size_t>(path.k)].at_a}};
  return path;
}

/// One technique, and its density up to a common factor.
struct Technique {
  enum Kind { kHit, kDirect, kConnect, kCamera, kMerge } kind = kHit;
  int at = 0;  // the last vertex of the eye side
  double density = 0;
};

std::vector<Technique> all_techniques(const RandomPath& p) {
  const auto at = [](const auto& v, int i) -> const auto& {
    return v[static_cast<size_t>(i)];
  };
  const int n = p.k + 1;
  const auto from_eye = [&](int i) {
    return i == 1 ? p.camera : at(p.eye, i - 1).forward * at(p.lines, i - 1).at_b;
  };
  const auto from_light = [&](int i) {
    if (i == n) return p.light.start;
    if (i == p.k) return p.light.onward * at(p.lines, i).at_a;
    return at(p.eye, i + 1).back * at(p.lines, i).at_a;
  };
  // Eye path: vertices 1 to `eye`. Light path: vertices `light` to n.
  const auto product = [&](int eye, int light) {
    double d = 1;
    for (int i = 1; i <= eye; ++i) d *= from_eye(i);
    for (int i = light; i <= n; ++i) d *= from_light(i);
    return d;
  };
  std::vector<Technique> all;
  if (p.light.hit) all.push_back({Technique::kHit, n, product(n, n + 1)});
  if (at(p.eye, p.k).finite && p.light.direct > 0)
    all.push_back({Technique::kDirect, p.k, product(p.k, n + 1) * p.light.direct});
  for (int i = 1; i < p.k; ++i)
    if (at(p.eye, i).finite && at(p.eye, i + 1).finite)
      all.push_back({Technique::kConnect, i, product(i, i + 1)});
  if (at(p.eye, 1).finite && p.light_paths > 0)
    all.push_back({Technique::kCamera, 0, product(0, 1) * p.light_paths});
  for (int i = 1; i <= p.k; ++i)
    if (at(p.merge, i) > 0) all.push_back({Technique::kMerge, i, product(i, i) * at(p.merge, i)});
  return all;
}

/// The weight from the partial sums that walks carry.
double recursive_weight(const RandomPath& p, const Technique& technique) {
  const auto event = [&](int i) { return p.eye[static_cast<size_t>(i)]; };
  const auto turned = [&](int i) {
    return EventDensity{event(i).back, event(i).forward, event(i).finite};
  };
  const auto line = [&](int i) { return p.lines[static_cast<size_t>(i)]; };
  const auto merge = [&](int i) { return heuristic(p.merge[static_cast<size_t>(i)]); };
  const int n = p.k + 1;
  std::vector<PartialMisWeights> eye(static_cast<size_t>(n) + 1), light(eye.size());
  eye[1].here = heuristic(p.light_paths / p.camera);
  for (int i = 1; i < n; ++i)
    eye[static_cast<size_t>(i) + 1] =
        SideEnd{eye[static_cast<size_t>(i)], event(i), merge(i)}.next(line(i));
  light[static_cast<size_t>(p.k)] = p.light.first();
  for (int i = p.k; i > 1; --i)
    light[static_cast<size_t>(i) - 1] =
        SideEnd{light[static_cast<size_t>(i)], turned(i), merge(i)}.next(
            {line(i - 1).at_b, line(i - 1).at_a});
  const int i = technique.at;
  const PartialMisWeights& z = eye[static_cast<size_t>(i)];
  switch (technique.kind) {
    case Technique::kHit:
      return weight_of_hit(p.light, z);
    case Technique::kDirect:
      return weight_of_direct(p.light, z, event(i).forward, event(i).back, merge(i));
    case Technique::kConnect: {
      const PartialMisWeights& y = light[static_cast<size_t>(i) + 1];
      return 1 /
             (1 +
              cuts_before(y, event(i).forward * line(i).at_b, event(i + 1).forward, merge(i + 1)) +
              cuts_before(z, event(i + 1).back * line(i).at_a, event(i).back, merge(i)));
    }
    case Technique::kCamera:
      return 1 / (1 + cuts_before(light[1], p.camera, event(1).forward, merge(1)) /
                          heuristic(p.light_paths));
    case Technique::kMerge: {
      const PartialMisWeights& y = light[static_cast<size_t>(i)];
      return weight_of_merge(z, event(i).back, y, event(i).forward, merge(i));
    }
  }
  return 0;
}

TEST(PathWeights, AreThoseOfBruteForceAndAddUpToOne) {
  int found[5] = {};
  for (uint32_t seed = 0; seed < 20000; ++seed) {
    const RandomPath path = random_path(seed);
    const std::vector<Technique> all = all_techniques(path);
    double sum = 0;
    for (const Technique& t : all) sum += heuristic(t.density);
    double total = 0;
    for (const Technique& t : all) {
      const double expected = heuristic(t.density) / sum;
      const double weight = recursive_weight(path, t);
      ASSERT_NEAR(weight, expected, 1e-9)
          << "seed " << seed << ", kind " << t.kind << " at " << t.at;
      total += weight;
      ++found[t.kind];
    }
    ASSERT_NEAR(total, all.empty() ? 0 : 1, 1e-9) << "seed " << seed;
  }
  for (const int n : found) EXPECT_GT(n, 5000);
}

TEST(PathWeights, ALightThatNextEventEstimationLeavesOutHasNoWeightThere) {
  LightStart light{1, 1, 0, true, {1, 1}};
  EXPECT_EQ(weight_of_direct(light, {}, 1, 1, 0), 0);
  EXPECT_EQ(light.first().here, 0);
}

}  // namespace
}  // namespace nephroid
