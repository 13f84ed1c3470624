#include "scene/embree_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "core/errors.h"
#include "scene/shape/curve.h"

namespace nephroid {

/// No cache of 128 MiB for subdivision surfaces, which become meshes before Embree sees them.
#ifdef NEPHROID_STD_THREADS
/// Embree's own threads would confuse ThreadSanitizer, which does not see their locks.
constexpr const char* kEmbreeConfig = "tessellation_cache_size=0,threads=1";
#else
constexpr const char* kEmbreeConfig = "tessellation_cache_size=0";
#endif

class EmbreeDevice {
 public:
  EmbreeDevice() : device(rtcNewDevice(kEmbreeConfig)) {
    if (!device) throw Error(ExitStatus::kRender, "Embree could not be started");
  }
  ~EmbreeDevice() { rtcReleaseDevice(device); }
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  /// Throws if the last calls left an error behind.
  void check(const char* what) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    const char* reason = error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "internal error";
    throw Error(ExitStatus::kRender, std::string("Embree: ") + reason + " while " + what);
  }

  RTCDevice device;
};

std::shared_ptr<EmbreeDevice> EmbreeScene::make_device() {
  return std::make_shared<EmbreeDevice>();
}

namespace {

constexpr float kEmbreeReach = 1e18f;

/// False for coordinates beyond `reach` and for NaNs, for which Embree would abort the program.
bool can_trace(const Ray& ray, float reach) {
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(ray.o[i]) <= reach && std::abs(ray.d[i]) <= reach)) return false;
  return ray.t_max >= 0.0f;
}

/// User data of a moving instance's callbacks. Embree's own instances move linearly between their
/// time steps; pbrt's do not.
struct MovingInstance {
  RTCScene child;
  float child_reach;
  Bounds3f child_bounds;
  MotionTransform motion;
  int segments;
};

/// Passed along with every query. Embree's hits hold a single instance. If a moving instance lies
/// within another, the hit holds the inner one, marked with kInner, and this the outer one.
struct TraceContext {
  RTCIntersectContext embree;  ///< first member, so that callbacks can cast to TraceContext
  uint32_t outer;

  TraceContext() : outer(EmbreeHit::kNoInstance) { rtcInitIntersectContext(&embree); }
};
constexpr uint32_t kInner = 0x80000000u;

}  // namespace

struct EmbreeScene::Impl {
  std::shared_ptr<EmbreeDevice> device;
  RTCScene scene = nullptr;
  std::vector<ShapePtr> shapes;
  std::deque<MovingInstance> moving;  ///< Embree keeps pointers to them
  /// Largest coordinate that a ray can have here, also after transforms to the space of still
  /// instances. Moving instances check their own.
  float reach = kEmbreeReach;
};

EmbreeScene::EmbreeScene(std::shared_ptr<EmbreeDevice> device) : impl_(std::make_unique<Impl>()) {
  impl_->device = std::move(device);
  impl_->scene = rtcNewScene(impl_->device->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(impl_->scene);
}

namespace {

void write_bounds(const Bounds3f& b, RTCBounds* out) {
  out->lower_x = b.min.x;
  out->lower_y = b.min.y;
  out->lower_z = b.min.z;
  out->upper_x = b.max.x;
  out->upper_y = b.max.y;
  out->upper_z = b.max.z;
}

void shape_bounds(const RTCBoundsFunctionArguments* args) {
  const auto* shape = static_cast<const Shape*>(args->geometryUserPtr);
  write_bounds(shape->bounds(args->primID), args->bounds_o);
}

void moving_bounds(const RTCBoundsFunctionArguments* args) {
  const auto* moving = static_cast<const MovingInstance*>(args->geometryUserPtr);
  write_bounds(moving->motion.step_bounds(moving->child_bounds, args->timeStep, moving->segments),
               args->bounds_o);
}

Ray ray_of(const RTCRay& r) {
  Ray ray;
  ray.o = {r.org_x, r.org_y, r.org_z};
  ray.d = {r.dir_x, r.dir_y, r.dir_z};
  ray.t_max = r.tfar;
  ray.time = r.time;
  return ray;
}

void shape_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto* shape = static_cast<const Shape*>(args->geometryUserPtr);
  auto* rayhit = reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto hit = shape->intersect(args->primID, ray_of(rayhit->ray), rayhit->ray.tnear);
  if (!hit) return;
  rayhit->ray.tfar = hit->t;
  rayhit->hit.u = hit->uv.x;
  rayhit->hit.v = hit->uv.y;
  rayhit->hit.primID = args->primID;
  rayhit->hit.geomID = args->geomID;
  rayhit->hit.instID[0] = args->context->instID[0];
}

void shape_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto* shape = static_cast<const Shape*>(args->geometryUserPtr);
  auto* ray = reinterpret_cast<RTCRay*>(args->ray);
  if (shape->intersect(args->primID, ray_of(*ray), ray->tnear)) ray->tfar = -kInfinity;
}

// Ribbons are traced at their full width; hits outside of the visible width are rejected here.
void ribbon_filter(const RTCFilterFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto* shape = static_cast<const CurveShape*>(args->geometryUserPtr);
  const Ray ray = ray_of(*reinterpret_cast<const RTCRay*>(args->ray));
  const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
  if (!shape->is_hit(hit->primID, hit->u, ray)) args->valid[0] = 0;
}

// Ribbons that face the ray; the buffers are shared with the shape. Embree skips curves closer to
// the ray's origin than their width, so that rays do not hit the curve they leave: they start about
// that far away.
RTCGeometry curve_geometry(RTCDevice device, const CurveShape& curves) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_FLAT_BEZIER_CURVE);
  const std::vector<CurveShape::Vertex>& vertices = curves.vertices();
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                             vertices.data(), 0, sizeof(CurveShape::Vertex), vertices.size());
  auto* first = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                               RTC_FORMAT_UINT, sizeof(uint32_t),
                                                               curves.primitive_count()));
  if (first)
    for (uint32_t i = 0; i < curves.primitive_count(); ++i) first[i] = 4 * i;
  rtcSetGeometryTessellationRate(geometry, CurveShape::kPartsPerPiece);
  if (curves.type() != CurveType::kRibbon) return geometry;
  rtcSetGeometryUserData(geometry, const_cast<CurveShape*>(&curves));
  rtcSetGeometryIntersectFilterFunction(geometry, ribbon_filter);
  rtcSetGeometryOccludedFilterFunction(geometry, ribbon_filter);
  return geometry;
}

RTCRay rtc_ray(const Ray& ray, unsigned mask) {
  RTCRay r;
  r.org_x = ray.o.x;
  r.org_y = ray.o.y;
  r.org_z = ray.o.z;
  r.tnear = 0.0f;
  r.dir_x = ray.d.x;
  r.dir_y = ray.d.y;
  r.dir_z = ray.d.z;
  r.time = ray.time > 0.0f ? std::min(ray.time, 1.0f) : 0.0f;
  r.tfar = ray.t_max;
  r.mask = mask;
  r.id = 0;
  r.flags = 0;
  return r;
}

/// Transforms a ray to the instance's space at the ray's time. False if it cannot be traced: the
/// instance is too small, too far away or flat at that time, and is not visible.
bool enter_space(const MovingInstance& moving, const RTCRay& r, RTCRay& inside) {
  const Ray local = object_space_ray(moving.motion.at(r.time), ray_of(r));
  inside = rtc_ray(local, r.mask);
  inside.tnear = r.tnear;
  return can_trace(local, moving.child_reach);
}

/// Marks hits of a child as hits of this geometry, within the current instance if there is one.
/// Returns that instance.
uint32_t enter_instance(TraceContext& context, uint32_t geometry) {
  const uint32_t outer = context.embree.instID[0];
  context.embree.instID[0] = outer == EmbreeHit::kNoInstance ? geometry : geometry | kInner;
  return outer;
}

void moving_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& moving = *static_cast<const MovingInstance*>(args->geometryUserPtr);
  auto* rayhit = reinterpret_cast<RTCRayHit*>(args->rayhit);
  RTCRayHit inside;
  if (!enter_space(moving, rayhit->ray, inside.ray)) return;
  inside.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  auto& context = *reinterpret_cast<TraceContext*>(args->context);
  const uint32_t outer = enter_instance(context, args->geomID);
  rtcIntersect1(moving.child, args->context, &inside);
  context.embree.instID[0] = outer;
  if (inside.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
  rayhit->ray.tfar = inside.ray.tfar;
  rayhit->hit = inside.hit;
  if (outer != EmbreeHit::kNoInstance) context.outer = outer;
}

void moving_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& moving = *static_cast<const MovingInstance*>(args->geometryUserPtr);
  auto* ray = reinterpret_cast<RTCRay*>(args->ray);
  RTCRay inside;
  if (!enter_space(moving, *ray, inside)) return;
  auto& context = *reinterpret_cast<TraceContext*>(args->context);
  const uint32_t outer = enter_instance(context, args->geomID);
  rtcOccluded1(moving.child, args->context, &inside);
  context.embree.instID[0] = outer;
  if (inside.tfar < 0.0f) ray->tfar = -kInfinity;
}

}  // namespace

uint32_t EmbreeScene::add_shape(ShapePtr shape, unsigned mask) {
  const RTCDevice device = impl_->device->device;
  RTCGeometry geometry;
  if (const auto* mesh = dynamic_cast<const TriangleMesh*>(shape.get())) {
    // The buffers are shared; the mesh builder left room for Embree's 16-byte reads.
    const MeshData& data = mesh->data();
    geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               data.positions.data(), 0, sizeof(Vec3f), data.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               data.triangles.data(), 0, 3 * sizeof(uint32_t),
                               data.triangles.size() / 3);
  } else if (const auto* curves = dynamic_cast<const CurveShape*>(shape.get());
             curves && curves->is_traceable()) {
    geometry = curve_geometry(device, *curves);
  } else if (const MeshData* flat = shape->flat_quads()) {
    geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto* vertices = static_cast<Vec3f*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3f), flat->positions.size()));
    auto* corners = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                4 * sizeof(uint32_t), flat->quads.size() / 4));
    impl_->device->check("adding a shape");
    std::copy(flat->positions.begin(), flat->positions.end(), vertices);
    // From patch order to Embree's ring order.
    for (size_t i = 0; i < flat->quads.size(); i += 4) {
      const uint32_t ring[] = {flat->quads[i], flat->quads[i + 1], flat->quads[i + 3],
                               flat->quads[i + 2]};
      std::copy(ring, ring + 4, corners + i);
    }
  } else {
    geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, shape->primitive_count());
    rtcSetGeometryUserData(geometry, const_cast<Shape*>(shape.get()));
    rtcSetGeometryBoundsFunction(
        geometry, [](const RTCBoundsFunctionArguments* args) { shape_bounds(args); }, nullptr);
    rtcSetGeometryIntersectFunction(geometry, shape_intersect);
    rtcSetGeometryOccludedFunction(geometry, shape_occluded);
  }
  rtcSetGeometryMask(geometry, mask);
  rtcCommitGeometry(geometry);
  const uint32_t id = rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  impl_->shapes.push_back(std::move(shape));
  impl_->device->check("adding a shape");
  return id;
}

uint32_t EmbreeScene::add_instance(const EmbreeScene& child, const Transform& object_to_world,
                                   unsigned mask) {
  const RTCGeometry geometry = rtcNewGeometry(impl_->device->device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, child.impl_->scene);
  rtcSetGeometryTimeStepCount(geometry, 1);
  float columns[12];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) columns[3 * i + j] = static_cast<float>(object_to_world.m[i][j]);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcSetGeometryMask(geometry, mask);
  rtcCommitGeometry(geometry);
  const uint32_t id = rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  impl_->device->check("adding an instance");
  // o'| <= reach |M^-1| + |t|, per axis, must stay below the reach of the instance.
  const Mat44d& inverse = object_to_world.inverse;
  for (int j = 0; j < 3; ++j) {
    const double stretch =
        std::abs(inverse[0][j]) + std::abs(inverse[1][j]) + std::abs(inverse[2][j]);
    const double left = kEmbreeReach - std::abs(inverse[3][j]);
    impl_->reach = std::min(impl_->reach, static_cast<float>(0.5 * left / stretch));
  }
  return id;
}

uint32_t EmbreeScene::add_moving_instance(const EmbreeScene& child,
                                          const MotionTransform& object_to_world, unsigned mask) {
  const Bounds3f bounds = child.bounds();
  const int segments = object_to_world.segments();
  impl_->moving.push_back(
      {child.impl_->scene, child.impl_->reach, bounds, object_to_world, segments});
  const RTCGeometry geometry = rtcNewGeometry(impl_->device->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryTimeStepCount(geometry, segments + 1);
  rtcSetGeometryUserData(geometry, &impl_->moving.back());
  rtcSetGeometryBoundsFunction(
      geometry, [](const RTCBoundsFunctionArguments* args) { moving_bounds(args); }, nullptr);
  rtcSetGeometryIntersectFunction(geometry, moving_intersect);
  rtcSetGeometryOccludedFunction(geometry, moving_occluded);
  rtcSetGeometryMask(geometry, mask);
  rtcCommitGeometry(geometry);
  const uint32_t id = rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  impl_->device->check("adding a moving instance");
  return id;
}

void EmbreeScene::commit() {
  rtcCommitScene(impl_->scene);
  impl_->device->check("building the hierarchy");
}

std::optional<EmbreeHit> EmbreeScene::intersect(const Ray& ray, unsigned mask) const {
  if (!can_trace(ray, impl_->reach)) return std::nullopt;
  TraceContext context;
  RTCRayHit rayhit;
  rayhit.ray = rtc_ray(ray, mask);
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context.embree, &rayhit);
  if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  EmbreeHit hit;
  hit.t = rayhit.ray.tfar;
  hit.uv = {rayhit.hit.u, rayhit.hit.v};
  hit.geometry = rayhit.hit.geomID;
  hit.primitive = rayhit.hit.primID;
  hit.instance = rayhit.hit.instID[0];
  if (hit.instance != EmbreeHit::kNoInstance && (hit.instance & kInner)) {
    hit.inner = hit.instance & ~kInner;
    hit.instance = context.outer;
  }
  return hit;
}

bool EmbreeScene::occluded(const Ray& ray, unsigned mask) const {
  if (!can_trace(ray, impl_->reach)) return true;
  TraceContext context;
  RTCRay r = rtc_ray(ray, mask);
  rtcOccluded1(impl_->scene, &context.embree, &r);
  return r.tfar < 0.0f;
}

Bounds3f EmbreeScene::bounds() const {
  RTCBounds b;
  rtcGetSceneBounds(impl_->scene, &b);
  Bounds3f all;
  if (b.lower_x <= b.upper_x)
    all = Bounds3f({b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z});
  // Embree interpolates the boxes of moving geometry, so only both ends count.
  for (const MovingInstance& moving : impl_->moving)
    all.extendBy(moving.motion.bounds(moving.child_bounds, 0.0f, 1.0f));
  return all;
}

}  // namespace nephroid
