#include "integrator/estimator/reach.h"

namespace nephroid {
namespace {

bool can_connect(const PathSummary& path) {
  return (path.camera_connects && !path.events.first_specular) || path.events.rough_pair;
}

const char* why_no_connection(const PathSummary& path) {
  return path.camera_connects
             ? "no path meets a light at a point or in one direction, and wherever it is cut in "
               "two, there is an S"
             : "no path meets a light at a point or in one direction, light paths are not "
               "connected "
               "to this camera, and wherever else it is cut in two, there is an S";
}

}  // namespace

const char* out_of_reach_of_eye_walks(const PathSummary& path) {
  return path.ends_out_of_reach()
             ? "no path meets a light at a point or in one direction, and only "
               "a rough S can be connected to it"
             : nullptr;
}

const char* out_of_reach_of_connections(const PathSummary& path) {
  return path.ends_out_of_reach() && !can_connect(path) ? why_no_connection(path) : nullptr;
}

const char* out_of_reach_of_merging(const PathSummary& path) {
  // With an S at the light's end, every merged photon came by way of an S.
  return path.ends_out_of_reach() && !path.events.any_surface
             ? "no path meets a light at a point or in one direction, none is connected to it "
               "behind an S, and photons are merged at D and G only"
             : nullptr;
}

const char* out_of_reach_of_merging_in_media(const PathSummary& path) {
  return path.ends_out_of_reach() && !path.events.any_surface && !path.events.volume_before_rough
             ? "no path meets a light at a point or in one direction, none is connected to it "
               "behind an S, and photons are merged at D and G, and at a V with only S before it"
             : nullptr;
}

const char* out_of_reach_of_both(const PathSummary& path) {
  return path.events.any_surface ? nullptr : out_of_reach_of_connections(path);
}

}  // namespace nephroid
