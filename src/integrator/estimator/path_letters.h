// The words of single paths with all labels of a scene, whether routes mention them or not. It must
// not know routes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "photon/path_recorder.h"

namespace nephroid {

/// A letter of a word with its label: 8 * number of the name + EventKind or LightKind.
using Letter = uint32_t;

class PathLetters {
 public:
  explicit PathLetters(const Scene& scene);

  Letter of(const WalkEvent& event) const;
  Letter of(const PathEnd& end) const;
  /// A word as routes.md writes it; its last letter is a light.
  std::string text(std::span<const Letter> word) const;
  /// The label of a light's letter.
  const std::string& label(Letter light) const { return names_[light >> 3]; }

 private:
  std::vector<std::string> names_;
  std::vector<uint32_t> materials_, media_, lights_;  ///< [index]: number of the label
  std::vector<LightKind> kinds_;                      ///< [light]
};

}  // namespace nephroid
