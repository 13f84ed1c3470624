// The newest frame of a live render: keeps the layers that somebody has asked for lately. It must
// not know how they are rendered.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "view/frame.h"

namespace nephroid {

class FrameStore {
 public:
  /// Makes the wanted layers of a film anew. `info` has the generation; version and film's
  /// properties are set here. Returns the version.
  uint64_t update(const Film& film, FrameInfo info, double now);
  /// Makes those of `layers` that are not there, as far as the film has them. Nothing is made
  /// without a film, or for another generation than that of the last update(); then want() does not
  /// ask for them again before the next one.
  void add(const Film* film, uint64_t generation, const std::vector<std::string>& layers);

  /// Notes that these layers are wanted. True if the newest frame has all of them that it can have.
  bool want(const std::vector<std::string>& layers, double now);
  /// The bytes of a frame (encode_frame); empty if nothing is newer than version `since` of
  /// `generation`. Layers that the film does not have are left out.
  std::optional<std::string> frame(const std::vector<std::string>& layers, uint64_t generation,
                                   uint64_t since) const;
  uint64_t version() const;
  /// The newest picture, if there is one.
  std::optional<PictureFrame> picture() const;

 private:
  std::vector<std::string> wanted(double now);
  /// The lock is held.
  void forget_old_wishes(double now);

  mutable std::mutex mutex_;
  FrameInfo info_;
  std::map<std::string, FrameLayerPtr> layers_;  ///< by name
  std::map<std::string, double> wanted_;         ///< layer: time of the last request
  std::set<std::string> absent_;                 ///< layers that the newest frame cannot have
};

}  // namespace nephroid
