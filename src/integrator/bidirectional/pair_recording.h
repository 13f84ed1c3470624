// Records the paths of one pixel in a small pass of path pairs. It must not know films or what the
// paths are summed to.
#pragma once

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/estimator/path_tally.h"
#include "integrator/estimator/pixel_pass.h"

namespace nephroid {

/// Traces paths of the pixel with the techniques, weights and guides of `pass`, a pass of the film
/// that does not connect. It has fewer light paths than the film's, each of which stands for
/// several in the weights. `separates_chains`: walks of their own look for the pixel's specular
/// chains.
void record_pixel(PairPass pass, const PixelPass& pixel, const RadianceGuide& directions,
                  bool separates_chains, PathTally& tally);

}  // namespace nephroid
