// The interface of every algorithm that renders a pass onto the film. An estimator has no loop over
// passes, opens no file and reads no clock: session/ owns those.
#pragma once

#include <cstdint>
#include <memory>

#include "core/pass_control.h"
#include "core/sampler.h"
#include "film/film.h"
#include "integrator/estimator/estimator_descriptor.h"
#include "integrator/estimator/estimator_statistics.h"
#include "integrator/estimator/learned.h"

namespace nephroid {

class PathTally;
struct PixelPass;

class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual const EstimatorDescriptor& descriptor() const = 0;
  /// True if its passes record the film's features (albedo, normal, depth) at the first vertex.
  virtual bool records_features() const { return false; }

  /// Learns from the scene what passes need: a function of the scene, the film's format, the
  /// estimator's options and the seed. Null if they need nothing.
  virtual std::shared_ptr<const Learned> learn(const Scene&, const FilmFormat&, uint64_t /*seed*/,
                                               PassControl&) const {
    return nullptr;
  }
  /// Reads a value of learn() that Learned::write wrote. Throws IoError if it is damaged.
  virtual std::shared_ptr<const Learned> read_learned(ByteReader&, const FilmFormat&) const {
    return nullptr;
  }

  /// Adds pass `key.pass` to the film, estimate counts included. It depends only on its arguments
  /// and the state of add_state(). `learned` may have been learned with another seed.
  /// `control` may end the pass (PassStopped). The film then holds the finished slices of the pass
  /// (Film::finish_slice), or nothing of it. Slices that the film already has are skipped.
  virtual void render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                           Film& film, PassControl& control) = 0;
  /// Counts of the passes rendered here, without those of learning.
  virtual EstimatorStatistics statistics() const = 0;
  /// True if record_pixel() works.
  virtual bool records_pixels() const { return false; }
  /// Traces paths of one pixel with the walks, weights and learned values of render_pass() and adds
  /// them to the tally, as an estimate of the pixel. May be called from several threads.
  virtual void record_pixel(const PixelPass&, const Learned*, PathTally&) const {}

  /// Adds the state kept from pass to pass beside the film, so that a render can be resumed.
  /// Nothing if passes are independent.
  virtual void add_state(const Scene&, const Film&, RenderState&) {}
};

}  // namespace nephroid
