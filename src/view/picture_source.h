// A picture file as what the page shows: its layers, and nothing that renders.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "view/frame.h"
#include "view/view_source.h"

namespace nephroid {

class PictureSource final : public ViewSource {
 public:
  /// Throws IoError and UsageError.
  explicit PictureSource(const std::string& path);

  LiveState state() const override { return state_; }
  uint64_t wait_for_news(uint64_t seen, double seconds) const override;
  std::optional<std::string> frame(const std::vector<std::string>& layers, uint64_t generation,
                                   uint64_t since) override;
  std::optional<PictureFrame> picture() override;
  ProbedPixel probe(int x, int y) override;
  Picture colors(const LayerGains& gains) override;
  void write(const std::string& exr_path) override;

 private:
  /// The layer of this name, made when it is first wanted; null if there is none.
  FrameLayerPtr layer(const std::string& name);
  FrameInfo info() const;
  float value(size_t pixel, const std::string& channel) const;

  Picture picture_;
  LiveState state_;
  std::mutex mutex_;
  std::map<std::string, FrameLayerPtr> layers_;
};

}  // namespace nephroid
