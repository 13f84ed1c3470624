// Pictures to compare with: earlier states of the view, uploads, files of the command line. Thread
// safe. It must not know the server.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "film/image_io.h"
#include "view/state_json.h"

namespace nephroid {

/// R, G and B of a film, in its colour space.
Picture color_picture(const Film& film);
/// R, G and B of a picture, without its other channels. Throws UsageError if one is missing.
Picture color_picture(const Picture& picture);

/// How far a picture is from another one.
struct Distance {
  double relmse = 0, relmse_trim = 0, flip = 0;
};

class Comparisons {
 public:
  /// Keeps an earlier state, as "A", "B", ...; the oldest of more than kMaxSnapshots goes. Returns
  /// its id.
  std::string add_snapshot(Picture picture, const std::string& description);
  /// Keeps a file, as "file1", ... Throws UsageError if there are too many.
  std::string add_file(Picture picture, const std::string& name);
  bool remove(const std::string& id);

  std::vector<ListedComparison> list() const;
  /// Null if there is none.
  std::shared_ptr<const Picture> find(const std::string& id) const;

  static constexpr size_t kMaxSnapshots = 4, kMaxFiles = 8;

 private:
  struct Entry {
    std::string id, name;
    bool is_snapshot = false;
    std::shared_ptr<const Picture> picture;
  };
  mutable std::mutex mutex_;
  std::vector<Entry> entries_;
  unsigned snapshots_ = 0, files_ = 0;  ///< numbers given so far
};

/// Throws UsageError if the sizes differ.
Distance distance(const Picture& reference, const Picture& test);
/// The squared relative error of each pixel ("relmse") or FLIP ("flip") in false colours, as a PNG
/// file. Throws UsageError for another kind.
std::vector<uint8_t> heat_png(const Picture& reference, const Picture& test,
                              const std::string& kind);

}  // namespace nephroid
