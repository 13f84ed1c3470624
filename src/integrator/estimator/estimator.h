// The interface of every algorithm that turns a pass key into light on the film.
// An estimator has no loop over passes, opens no file and looks at no clock: session/ owns those.
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

class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual const EstimatorDescriptor& descriptor() const = 0;
  /// True if its passes add what the camera sees first to the film's features.
  virtual bool records_features() const { return false; }

  /// What passes need to know of the scene: a function of the scene, the film's format,
  /// the estimator's options and the seed. Null if that is nothing.
  virtual std::shared_ptr<const Learned> learn(const Scene&, const FilmFormat&, uint64_t /*seed*/,
                                               PassControl&) const {
    return nullptr;
  }
  /// The value that `write` wrote of one that learn() returned. Throws IoError if it is damaged.
  virtual std::shared_ptr<const Learned> read_learned(ByteReader&, const FilmFormat&) const {
    return nullptr;
  }

  /// Adds pass `key.pass` to the film, estimate counts included. It depends on nothing but the
  /// arguments and what add_state() adds; `learned` is the value for this pass and may have been
  /// learned with another seed.
  /// `control` may end the pass (PassStopped): the film then has the pixels of those slices that
  /// are done (Film::finish_slice), or nothing of the pass. Slices that the film has already, of a
  /// pass that was ended, are not rendered again.
  virtual void render_pass(const PassKey& key, const Learned* learned, const Scene& scene,
                           Film& film, PassControl& control) = 0;
  /// Counts of the passes that were rendered here; what learning took is not in them.
  virtual EstimatorStatistics statistics() const = 0;
  /// Adds what it keeps from pass to pass beside the film, so that it can go on from there; nothing
  /// where passes are independent.
  virtual void add_state(const Scene&, const Film&, RenderState&) {}
};

}  // namespace nephroid
