// An LD_PRELOAD library between renderer and Embree. Forwards and counts every query, keeps some,
// and replays these in a bare loop before the first scene is released. Prints "floor: N queries"
// and "floor: K kept in S s" to stderr. tools/measure_floor runs it; one thread only.
// NEPHROID_FLOOR_EVERY=N keeps one run of queries in N, none if unset.
#include <dlfcn.h>
#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

/// Length of a run of kept queries: neighbours share the caches.
constexpr size_t kRun = 4096;

struct Query {
  RTCScene scene;
  RTCRay ray;
  bool occlusion;
};

std::vector<Query>& kept() {
  static std::vector<Query> all;
  return all;
}
size_t queries = 0;
bool is_over = false;
/// Callbacks of instances query from within a query.
int depth = 0;

size_t every() {
  static const char* const text = std::getenv("NEPHROID_FLOOR_EVERY");
  static const size_t value = text ? std::strtoul(text, nullptr, 10) : 0;
  return value;
}

template <class F>
F next(const char* name, F) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

void record(RTCScene scene, const RTCRay& ray, bool occlusion) {
  if (depth > 1) return;
  const size_t run = queries++ / kRun;
  if (every() > 0 && run % every() == 0) kept().push_back({scene, ray, occlusion});
}

/// Callbacks may expect more data behind Embree's part of the context.
struct Context {
  RTCIntersectContext embree;
  unsigned char more[64] = {};
};

void replay() {
  const auto intersect = next("rtcIntersect1", &rtcIntersect1);
  const auto occluded = next("rtcOccluded1", &rtcOccluded1);
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  const auto begin = std::chrono::steady_clock::now();
  for (const Query& q : kept()) {
    Context context;
    rtcInitIntersectContext(&context.embree);
    if (q.occlusion) {
      RTCRay ray = q.ray;
      occluded(q.scene, &context.embree, &ray);
    } else {
      RTCRayHit hit;
      hit.ray = q.ray;
      hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      intersect(q.scene, &context.embree, &hit);
    }
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  std::fprintf(stderr, "floor: %zu queries\nfloor: %zu kept in %.6f s\n", queries, kept().size(),
               seconds.count());
}

}  // namespace

extern "C" {

void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* rayhit) {
  static const auto real = next("rtcIntersect1", &rtcIntersect1);
  ++depth;
  record(scene, rayhit->ray, false);
  real(scene, context, rayhit);
  --depth;
}

void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  static const auto real = next("rtcOccluded1", &rtcOccluded1);
  ++depth;
  record(scene, *ray, true);
  real(scene, context, ray);
  --depth;
}

void rtcReleaseScene(RTCScene scene) {
  static const auto real = next("rtcReleaseScene", &rtcReleaseScene);
  if (!is_over && queries > 0) {
    is_over = true;
    replay();
  }
  real(scene);
}
}
