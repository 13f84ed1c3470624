// Deals the dimensions of the Sobol' sequence to the decisions of a camera path: prints the order
// that src/transport/eye_point.cpp has. See docs/estimators.md, section 25, for what is measured
// ([N1]) and what is weighed against what. Run it by tools/choose_dimensions.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "core/sampler.h"

using namespace nephroid;

namespace {

/// Those of camera paths; light paths that are connected with them have what follows.
constexpr int kDimensions = 96;
/// Runs of 2^4 to 2^12 points count alike.
constexpr int kFirstLog2 = 4, kLastLog2 = 12;
/// Chosen in pairs with all that matters to them; later vertices have what is left, in order.
constexpr int kVertices = 5;
/// One poor run must not hide what the others are like.
constexpr double kMostRatio = 20;

using Decision = std::vector<int>;  ///< its dimensions

/// 1 + (1 - rho) g(z) of [N1], for each point and dimension.
struct Run {
  size_t points;
  std::vector<double> factors;  ///< [point][dimension]

  explicit Run(int log2) : points(size_t{1} << log2) {
    constexpr double kRho = 0.5;
    for (size_t i = 0; i < points; ++i) {
      const SobolPoint point(static_cast<uint32_t>(i), kDimensions);
      for (int d = 0; d < kDimensions; ++d) {
        const double rest = std::pow(kRho, std::countr_zero(point.reversed(d)));
        factors.push_back(1 + (1 - rest) - (1 - kRho) * rest);
      }
    }
  }
  const double* of_point(size_t i) const { return &factors[i * kDimensions]; }
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

using Table = std::array<std::array<double, kDimensions>, kDimensions>;

/// How uneven each pair of dimensions is together with others, over what is good; mean over runs.
const Table& pairs(Decision with) {
  static std::map<Decision, Table> known;
  std::sort(with.begin(), with.end());
  const auto found = known.find(with);
  if (found != known.end()) return found->second;
  Table& sum = known[with];
  sum = {};
  for (const Run& run : runs()) {
    Table t{};
    for (size_t i = 0; i < run.points; ++i) {
      const double w = run.product(i, with) / static_cast<double>(run.points);
      const double* f = run.of_point(i);
      for (int a = 0; a < kDimensions; ++a)
        for (int b = a + 1; b < kDimensions; ++b) t[a][b] += w * f[a] * f[b];
    }
    std::vector<double> all;
    for (int a = 0; a < kDimensions; ++a)
      for (int b = a + 1; b < kDimensions; ++b)
        all.push_back(t[a][b] = std::max(t[a][b] - 1, 1e-9));
    const double good = with.empty() ? t[0][1] : nth(all, 0.005);
    for (int a = 0; a < kDimensions; ++a)
      for (int b = a + 1; b < kDimensions; ++b)
        sum[a][b] += std::min(t[a][b] / good, kMostRatio) / static_cast<double>(runs().size());
  }
  return sum;
}

/// The same of single dimensions.
std::array<double, kDimensions> singles(const Decision& with) {
  std::array<double, kDimensions> sum{};
  for (const Run& run : runs()) {
    std::vector<double> t(kDimensions, 0.0);
    for (size_t i = 0; i < run.points; ++i)
      for (int d = 0; d < kDimensions; ++d)
        t[static_cast<size_t>(d)] +=
            run.product(i, with) * run.of_point(i)[d] / static_cast<double>(run.points);
    for (double& v : t) v = std::max(v - 1, 1e-9);
    const double good = nth(t, 0.03);
    for (int d = 0; d < kDimensions; ++d)
      sum[d] += std::min(t[static_cast<size_t>(d)] / good, kMostRatio) /
                static_cast<double>(runs().size());
  }
  return sum;
}

Decision operator+(Decision a, const Decision& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Term {
  Decision with;
  double weight = 1;
};

class Dealer {
 public:
  Decision number(const std::vector<Term>& terms) {
    std::array<double, kDimensions> sum{};
    for (const Term& t : terms) {
      const auto s = singles(t.with);
      for (int d = 0; d < kDimensions; ++d) sum[d] += t.weight * s[d];
    }
    int best = -1;
    for (int d = 0; d < kDimensions; ++d)
      if (!taken_[d] && (best < 0 || sum[d] < sum[best])) best = d;
    return take({best});
  }
  Decision pair(const std::vector<Term>& terms) {
    Decision best;
    double least = 0;
    for (int a = 0; a < kDimensions; ++a)
      for (int b = a + 1; b < kDimensions; ++b) {
        if (taken_[a] || taken_[b]) continue;
        double sum = 0;
        for (const Term& t : terms) sum += t.weight * pairs(t.with)[a][b];
        if (best.empty() || sum < least) {
          least = sum;
          best = {a, b};
        }
      }
    return take(best);
  }
  Decision take(const Decision& d) {
    for (const int i : d) taken_[i] = true;
    return d;
  }
  Decision rest() const {
    Decision r;
    for (int d = 0; d < kDimensions; ++d)
      if (!taken_[d]) r.push_back(d);
    return r;
  }

 private:
  std::array<bool, kDimensions> taken_{};
};

struct Vertex {
  Decision light_number, light, lobe, direction;
};

}  // namespace

int main() {
  Dealer dealer;
  const Decision film = dealer.take({0, 1});
  std::vector<Vertex> path;
  for (int i = 0; i < kVertices; ++i) {
    Vertex v;
    // Before a number or a pair come the film, or the vertex before and the one before that: behind
    // glass its lobe alone.
    const bool first = i == 0;
    const Vertex before = first ? Vertex{} : path.back();
    const Decision near = first ? film : before.direction;
    const Decision far = i < 2 ? film : path[static_cast<size_t>(i) - 2].direction;
    const auto number_terms = [&]() -> std::vector<Term> {
      if (first) return {{film}};
      return {{near}, {far + before.lobe}, {before.lobe}};
    };
    const auto pair_terms = [&](const Decision& number) -> std::vector<Term> {
      if (first) return {{{}}, {number, 0.5}, {film}, {film + number}};
      return {{{}}, {number, 0.5}, {near}, {far, 0.5}, {far + before.lobe, 0.5}, {near + number}};
    };
    v.light_number = dealer.number(number_terms());
    v.light = dealer.pair(pair_terms(v.light_number));
    v.lobe = dealer.number(number_terms());
    v.direction = dealer.pair(pair_terms(v.lobe));
    path.push_back(v);
  }
  const Decision wavelength = dealer.number({{film}});
  const Decision lens = dealer.pair({{{}}, {film}, {path[0].light}});
  const Decision time = dealer.number({{film}});
  Decision order = film + wavelength;
  for (int i = 0; i < kVertices; ++i) {
    const Vertex& v = path[static_cast<size_t>(i)];
    const Decision roulette = dealer.number({{v.direction}});
    const Decision flight =
        dealer.number({{i == 0 ? film : path[static_cast<size_t>(i) - 1].direction}});
    order = order + v.light_number + v.light + v.lobe + v.direction + roulette + flight;
    if (i == 0) order = order + lens + time;
    const auto unevenness = [](const Decision& d) { return pairs({})[d[0]][d[1]]; };
    std::fprintf(stderr, "vertex %d: unevenness %.2f of the light's point, %.2f of the direction\n",
                 i + 1, unevenness(v.light), unevenness(v.direction));
  }
  order = order + dealer.rest();
  for (size_t i = 0; i < order.size(); ++i)
    std::printf("%d,%s", order[i], (i + 1) % 16 == 0 ? "\n" : " ");
}
