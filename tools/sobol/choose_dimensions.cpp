// Assigns dimensions of the Sobol' sequence to the decisions of a camera path, and others to those
// of connected light paths. Prints the orders in src/transport/path_points.cpp. The measure is
// [U1], see docs/estimators.md, section 25. tools/choose_dimensions runs it.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <vector>

#include "core/sampler.h"

using namespace nephroid;

namespace {

/// Camera paths have the first dimensions, light paths those that follow.
constexpr int kDimensions = kSobolDimensions, kOfEye = 96, kNumbersOfLight = 48;
/// All runs of 2^4 to 2^12 points have the same weight.
constexpr int kFirstLog2 = 4, kLastLog2 = 12;
/// The vertices that have numbers of their own.
constexpr int kVertices = 11, kVerticesOfLight = 5;
/// Vertices whose roulette has its dimension before later vertices.
constexpr int kVerticesOfRoulette = 3;
/// Limits the influence of a single poor run.
constexpr double kMaxRatio = 20;

using Decision = std::vector<int>;  ///< dimensions of a decision

/// 1 + (1 - rho) g(z) of [U1], for each point and dimension.
struct Run {
  size_t points;
  std::vector<double> factors;  ///< [point][dimension]

  explicit Run(int log2) : points(size_t{1} << log2) {
    constexpr double kRho = 0.5;
    for (size_t i = 0; i < points; ++i) {
      const SobolPoint point(static_cast<uint32_t>(i), kDimensions);
      for (int d = 0; d < kDimensions; ++d) {
        const double finest = std::pow(kRho, std::countr_zero(point.reversed(d)));
        factors.push_back(1 + (1 - finest) - (1 - kRho) * finest);
      }
    }
  }
  const double* of_point(size_t i) const { return &factors[i * kDimensions]; }
  /// Unevenness of the first pair of dimensions.
  double best_pair() const {
    double sum = 0;
    for (size_t i = 0; i < points; ++i) sum += product(i, {0, 1});
    return sum / static_cast<double>(points) - 1;
  }
  double product(size_t i, const Decision& with) const {
    double p = 1;
    for (const int d : with) p *= of_point(i)[d];
    return p;
  }
};

const std::vector<Run>& runs() {
  static const std::vector<Run> all = [] {
    std::vector<Run> r;
    for (int log2 = kFirstLog2; log2 <= kLastLog2; ++log2) r.emplace_back(log2);
    return r;
  }();
  return all;
}

double nth(std::vector<double> values, double part) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The dimensions to choose from.
struct Pool {
  int begin, end;
};

using Table = std::array<std::array<double, kDimensions>, kDimensions>;

/// Unevenness of each pair of dimensions combined with others, relative to a good pair. Mean over
/// runs.
Table pairs(const Decision& with, Pool pool) {
  Table sum{};
  for (const Run& run : runs()) {
    Table t{};
    for (size_t i = 0; i < run.points; ++i) {
      const double w = run.product(i, with) / static_cast<double>(run.points);
      const double* f = run.of_point(i);
      for (int a = pool.begin; a < pool.end; ++a)
        for (int b = a + 1; b < pool.end; ++b) t[a][b] += w * f[a] * f[b];
    }
    std::vector<double> all;
    for (int a = pool.begin; a < pool.end; ++a)
      for (int b = a + 1; b < pool.end; ++b) all.push_back(t[a][b] = std::max(t[a][b] - 1, 1e-9));
    const double good = with.empty() ? run.best_pair() : nth(all, 0.005);
    for (int a = pool.begin; a < pool.end; ++a)
      for (int b = a + 1; b < pool.end; ++b)
        sum[a][b] += std::min(t[a][b] / good, kMaxRatio) / static_cast<double>(runs().size());
  }
  return sum;
}

/// The same for single dimensions.
std::array<double, kDimensions> singles(const Decision& with, Pool pool) {
  std::array<double, kDimensions> sum{};
  for (const Run& run : runs()) {
    std::vector<double> t(static_cast<size_t>(pool.end - pool.begin), 0.0);
    for (size_t i = 0; i < run.points; ++i) {
      const double w = run.product(i, with) / static_cast<double>(run.points);
      for (size_t d = 0; d < t.size(); ++d)
        t[d] += w * run.of_point(i)[pool.begin + static_cast<int>(d)];
    }
    for (double& v : t) v = std::max(v - 1, 1e-9);
    const double good = nth(t, 0.03);
    for (size_t d = 0; d < t.size(); ++d)
      sum[static_cast<size_t>(pool.begin) + d] +=
          std::min(t[d] / good, kMaxRatio) / static_cast<double>(runs().size());
  }
  return sum;
}

Decision joined(std::initializer_list<Decision> parts) {
  Decision all;
  for (const Decision& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

struct Term {
  Decision with;
  double weight = 1;
};

class Dealer {
 public:
  explicit Dealer(Pool pool) : pool_(pool) {}

  Decision number(const std::vector<Term>& terms) {
    std::array<double, kDimensions> sum{};
    for (const Term& t : terms) {
      const auto s = singles(t.with, pool_);
      for (int d = pool_.begin; d < pool_.end; ++d) sum[d] += t.weight * s[d];
    }
    int best = -1;
    for (int d = pool_.begin; d < pool_.end; ++d)
      if (!taken_[d] && (best < 0 || sum[d] < sum[best])) best = d;
    return take({best});
  }
  Decision pair(const std::vector<Term>& terms) {
    Table sum{};
    for (const Term& t : terms) {
      const Table s = pairs(t.with, pool_);
      for (int a = pool_.begin; a < pool_.end; ++a)
        for (int b = a + 1; b < pool_.end; ++b) sum[a][b] += t.weight * s[a][b];
    }
    Decision best;
    for (int a = pool_.begin; a < pool_.end; ++a)
      for (int b = a + 1; b < pool_.end; ++b)
        if (!taken_[a] && !taken_[b] && (best.empty() || sum[a][b] < sum[best[0]][best[1]]))
          best = {a, b};
    return take(best);
  }
  Decision take(const Decision& d) {
    for (const int i : d) taken_[i] = true;
    return d;
  }
  Decision rest() const {
    Decision r;
    for (int d = pool_.begin; d < pool_.end; ++d)
      if (!taken_[d]) r.push_back(d);
    return r;
  }

 private:
  const Pool pool_;
  std::array<bool, kDimensions> taken_{};
};

struct Vertex {
  Decision light_number, light, lobe, direction, roulette;
};

double unevenness(const Decision& d) {
  return pairs({}, {d[0], d[1] + 1})[d[0]][d[1]];
}

void print(const char* what, const Decision& order) {
  std::printf("%s\n", what);
  for (size_t i = 0; i < order.size(); ++i)
    std::printf("%d,%s", order[i], (i + 1) % 16 == 0 ? "\n" : " ");
}

/// Film, wavelength, and so on in the order of src/transport/walk.h.
Decision deal_to_eye(std::vector<Vertex>& path) {
  Dealer dealer({0, kOfEye});
  const Decision film = dealer.take({0, 1});
  for (int i = 0; i < kVertices; ++i) {
    Vertex v;
    // Vertex i is integrated with the last two directions and the lobe between, which alone decides
    // at glass.
    const bool first = i == 0;
    const Vertex before = first ? Vertex{} : path.back();
    const Decision near = first ? film : before.direction;
    const Decision far = i < 2 ? film : path[static_cast<size_t>(i) - 2].direction;
    const auto number_terms = [&]() -> std::vector<Term> {
      if (first) return {{film}};
      return {{near}, {joined({far, before.lobe})}, {before.lobe}};
    };
    const auto pair_terms = [&](const Decision& number) -> std::vector<Term> {
      if (first) return {{{}}, {number, 0.5}, {film}, {joined({film, number})}};
      return {{{}},
              {number, 0.5},
              {near},
              {far, 0.5},
              {joined({far, before.lobe}), 0.5},
              {joined({near, number})}};
    };
    v.light_number = dealer.number(number_terms());
    v.light = dealer.pair(pair_terms(v.light_number));
    v.lobe = dealer.number(number_terms());
    v.direction = dealer.pair(pair_terms(v.lobe));
    if (i < kVerticesOfRoulette)
      v.roulette = dealer.number({{v.direction}, {film}, {joined({film, v.direction})}});
    path.push_back(v);
    std::fprintf(stderr,
                 "eye's vertex %d: unevenness %.2f of the light's point, %.2f of the direction\n",
                 i + 1, unevenness(v.light), unevenness(v.direction));
  }
  const Decision wavelength = dealer.number({{film}});
  const Decision lens = dealer.pair({{{}}, {film}, {path[0].light}});
  const Decision time = dealer.number({{film}});
  Decision order = joined({film, wavelength});
  for (int i = 0; i < kVertices; ++i) {
    const Vertex& v = path[static_cast<size_t>(i)];
    const Decision roulette = i < kVerticesOfRoulette ? v.roulette : dealer.number({{v.direction}});
    const Decision flight =
        dealer.number({{i == 0 ? film : path[static_cast<size_t>(i) - 1].direction}});
    order = joined({order, v.light_number, v.light, v.lobe, v.direction, roulette, flight});
    if (i == 0) order = joined({order, lens, time});
  }
  return joined({order, dealer.rest()});
}

/// Light, point and direction, then vertices; together with the first ones of the camera path.
Decision deal_to_light(const std::vector<Vertex>& eye) {
  Dealer dealer({kOfEye, kDimensions});
  const Decision film = {0, 1}, first = eye[0].direction;
  const Decision light = dealer.number({{film}, {first}});
  const Decision point = dealer.pair({{{}}, {light, 0.5}, {film}, {first, 0.5}});
  const Decision away = dealer.pair({{{}}, {point}, {film}, {light, 0.5}});
  std::vector<Vertex> path;
  for (int i = 0; i < kVerticesOfLight; ++i) {
    const Decision before = i == 0 ? away : path.back().direction;
    Vertex v;
    v.lobe = dealer.number({{before}});
    v.direction = dealer.pair({{{}}, {v.lobe, 0.5}, {before}, {film}, {joined({before, v.lobe})}});
    path.push_back(v);
    std::fprintf(stderr, "light's vertex %d: unevenness %.2f of the direction\n", i + 1,
                 unevenness(v.direction));
  }
  std::fprintf(stderr, "light: unevenness %.2f of the point, %.2f of the direction\n",
               unevenness(point), unevenness(away));
  std::vector<Decision> others;  // roulette and flight
  for (const Vertex& v : path)
    others.push_back(joined({dealer.number({{v.direction}}), dealer.number({{v.direction}})}));
  // These vertices sample no lights.
  const Decision rest = dealer.rest();
  auto next = rest.begin();
  Decision order = joined({light, point, away});
  for (size_t i = 0; i < path.size(); ++i) {
    order = joined({order, Decision(next, next + 3), path[i].lobe, path[i].direction, others[i]});
    next += 3;
  }
  order = joined({order, Decision(next, rest.end())});
  order.resize(kNumbersOfLight);
  return order;
}

}  // namespace

int main() {
  std::vector<Vertex> eye;
  print("camera paths:", deal_to_eye(eye));
  print("light paths beside them:", deal_to_light(eye));
}
