// Sums the light of recorded paths by word and route, and keeps the vertices of the brightest path
// of each. It must not know estimators or films.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "integrator/estimator/path_letters.h"
#include "photon/photon_histories.h"
#include "route/routes.h"

namespace nephroid {

/// A sum of colours.
struct ColorSum {
  double r = 0, g = 0, b = 0;
  ColorSum& operator+=(const ColorSum& o) {
    r += o.r;
    g += o.g;
    b += o.b;
    return *this;
  }
  ColorSum operator*(double c) const { return {r * c, g * c, b * c}; }
  Rgb rounded() const {
    return {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)};
  }
};

/// All paths of one word and one route.
struct WordTally {
  std::vector<Letter> word;  ///< eye first, the light last
  int route = 0;
  std::array<ColorSum, kTechniqueCount> light;  ///< by technique
  // The brightest path.
  float brightest = -1;
  std::vector<Vec3f> points;  ///< from the lens to the light

  ColorSum total() const;
  void add(const WordTally& other);
};

class PathTally final : public PathRecorder {
 public:
  PathTally(const Routes& routes, const PathLetters& letters)
      : routes_(routes), letters_(letters) {}

  /// The photons that `merge` gets from now on. They must outlive those calls.
  void use(PhotonHistories& photons) { photons_ = &photons; }

  void meet(const PathLight& found, const PathEnd& end) override;
  void join(const PathLight& found, const WalkEvent& last, const PathEnd& end) override;
  void merge(const PathLight& found, const WalkEvent& last, const Photon& photon) override;
  void end(const SensorWeights& weights, float factor, float max_component,
           float filter_weight) override;

  /// The words in the order in which they were found.
  const std::vector<WordTally>& words() const { return words_; }
  /// Null if there is none of the same word and route.
  const WordTally* find(const WordTally& other) const;
  void add(const PathTally& other);

 private:
  struct HashWord {
    size_t operator()(const std::vector<Letter>& key) const;
  };
  /// The light of a path that has not ended.
  struct Found {
    size_t word = 0;
    Technique technique = Technique::kMeetLight;
    SampledSpectrum value;
  };
  /// Starts the word and the points of a path with those of the walk.
  void start(bool with_last_vertex);
  /// Adds the path of word_ and points_.
  void take(const PathLight& found, const PathEnd& end);
  size_t number_of(int route);

  const Routes& routes_;
  const PathLetters& letters_;
  PhotonHistories* photons_ = nullptr;
  std::vector<Letter> word_;
  std::vector<Vec3f> points_;
  std::vector<Found> found_;
  std::vector<WordTally> words_;
  std::unordered_map<std::vector<Letter>, size_t, HashWord> numbers_;  ///< of word and route
};

}  // namespace nephroid
