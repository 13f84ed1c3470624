// The vertices and events of a single walk, kept so that its path can be shown, and a visitor that
// records them beside another one. Ordinary walks have no record. It must not know routes.
#pragma once

#include <utility>
#include <vector>

#include "transport/flight_light.h"

namespace nephroid {

struct WalkRecord {
  struct Vertex {
    Vec3f p{0, 0, 0};
    int events = 0;  ///< events before it; the exit of subsurface light has those of its entry
  };
  Vec3f start{0, 0, 0};  ///< point on the lens or the light
  std::vector<Vertex> vertices;
  std::vector<WalkEvent> events;

  void begin(const Vec3f& p) {
    start = p;
    vertices.clear();
    events.clear();
  }
  /// A vertex takes the place of the one before if the walk went straight through there.
  void arrive(const Vec3f& p, bool subsurface_exit = false) {
    const int before = static_cast<int>(events.size());
    if (!subsurface_exit && !vertices.empty() && vertices.back().events == before)
      vertices.pop_back();
    vertices.push_back({p, before});
  }
  void scatter(const WalkEvent& event) { events.push_back(event); }
};

/// A branch of a walk: its first event and what is recorded after it are forgotten at the end. A
/// null record stays null.
class RecordedBranch {
 public:
  RecordedBranch(WalkRecord* record, const WalkEvent& event) : record_(record) {
    if (record_ == nullptr) return;
    vertices_ = record_->vertices.size();
    events_ = record_->events.size();
    record_->scatter(event);
  }
  ~RecordedBranch() {
    if (record_ == nullptr) return;
    record_->vertices.resize(vertices_);
    record_->events.resize(events_);
  }
  RecordedBranch(const RecordedBranch&) = delete;
  RecordedBranch& operator=(const RecordedBranch&) = delete;

 private:
  WalkRecord* const record_;
  size_t vertices_ = 0, events_ = 0;
};

/// A vertex beside the walk, forgotten at the end.
class RecordedDetour {
 public:
  RecordedDetour(WalkRecord& record, const Vec3f& p) : record_(record), vertices_(record.vertices) {
    record_.arrive(p);
  }
  ~RecordedDetour() { record_.vertices = std::move(vertices_); }
  RecordedDetour(const RecordedDetour&) = delete;
  RecordedDetour& operator=(const RecordedDetour&) = delete;

 private:
  WalkRecord& record_;
  std::vector<WalkRecord::Vertex> vertices_;
};

/// A visitor whose walk is recorded.
template <class Visitor>
class RecordingVisitor : public Visitor {
 public:
  RecordingVisitor(Visitor visitor, WalkRecord& record)
      : Visitor(std::move(visitor)), record_(record) {}

  void vertex(const Walk& walk, const WalkVertex& v, PathSampler& sampler) {
    record_.arrive(v.surface.p, v.subsurface_exit);
    Visitor::vertex(walk, v, sampler);
  }
  void medium_vertex(const Walk& walk, const MediumVertex& v, PathSampler& sampler) {
    record_.arrive(v.p);
    Visitor::medium_vertex(walk, v, sampler);
  }
  void light_along(const Walk& walk, const FlightLight& found, PathSampler& sampler) requires
      requires(Visitor& v) {
    v.light_along(walk, found, sampler);
  }
  {
    const RecordedDetour recorded(record_, found.vertex.p);
    Visitor::light_along(walk, found, sampler);
  }
  bool scatter(const Walk& walk, const WalkEvent& event) {
    record_.scatter(event);
    return Visitor::scatter(walk, event);
  }

 private:
  WalkRecord& record_;
};

/// The event of class `c` at a surface vertex towards the local direction `wi`.
inline WalkEvent event_at(const WalkVertex& v, EventClass c, const Vec3f& wi) {
  return {v.letter(c), v.transmits(wi), v.material.index(), -1};
}
inline WalkEvent event_in(const Medium& medium) {
  return {EventClass::kVolume, false, -1, medium.index()};
}

/// A light path from its start to its end.
struct LightPathRecord {
  int light = -1;  ///< index of the light, -1 if nothing was emitted
  WalkRecord walk;
};

}  // namespace nephroid
