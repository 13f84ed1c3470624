#include "integrator/learning/radiance_guide.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/equal_area_map.h"
#include "core/parallel.h"

namespace nephroid {

namespace {

constexpr uint8_t kSides = 12;
/// Boxes with more records are cut without a judgement.
constexpr size_t kManyRecords = 1 << 16;
constexpr size_t kMinRecords = 1 << 8;
constexpr float kShares[] = {0.25f, 0.5f, 0.75f};
/// Required gain of a guide over the BSDF. Second moments do not see the even distribution of a
/// pixel's samples over the BSDF's directions, which guiding destroys.
constexpr double kWorthIt = 0.7;
/// Required gain of cutting a box: the best of several estimates tends to be a lucky one.
constexpr double kWorthCutting = 0.95;

uint8_t side_of(const Vec3f& n, bool glossy) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) > std::abs(n[axis])) axis = i;
  return static_cast<uint8_t>((glossy ? 6 : 0) + 2 * axis + (n[axis] < 0 ? 1 : 0));
}

/// m of [Q2] for every `step`th record.
std::vector<DirectionMoment> moments(std::span<const RadianceRecord> records, size_t first,
                                     size_t step) {
  std::vector<DirectionMoment> out;
  out.reserve(records.size() / step + 1);
  for (size_t i = first; i < records.size(); i += step) {
    const RadianceRecord& r = records[i];
    if (r.pdf_w > 0) out.push_back({r.square, sqr(double{r.found}) * double{r.pdf_w}});
  }
  return out;
}

/// The best guide of a box without cutting it.
struct Judgement {
  float share = 0;
  double moment = 0;  ///< M(share) of [Q4]
};

Judgement judge(std::span<const RadianceRecord> records) {
  // Each half judges the tree of the other half.
  Judgement best;
  std::array<double, std::size(kShares)> guided{};
  const bool few = records.size() < kMinRecords;
  for (size_t half = 0; half < 2; ++half) {
    std::vector<DirectionTree::Node> nodes;
    if (!few) append_direction_tree(moments(records, half, 2), nodes);
    const DirectionTree tree(nodes.data(), 0);
    for (size_t i = 1 - half; i < records.size(); i += 2) {
      const RadianceRecord& r = records[i];
      const double square = sqr(double{r.found});
      if (square == 0) continue;
      best.moment += square;
      // A ratio of 0: other lobes lose the samples that the guide takes.
      const double ratio =
          nodes.empty() || !(r.pdf_w > 0) ? 0.0 : double{tree.pdf_w(r.square)} / double{r.pdf_w};
      for (size_t s = 0; s < guided.size(); ++s)
        guided[s] += square / (double{kShares[s]} * ratio + 1 - double{kShares[s]});
    }
  }
  const double alone = best.moment;
  for (size_t s = 0; s < guided.size(); ++s)
    if (guided[s] < std::min(best.moment, kWorthIt * alone)) best = {kShares[s], guided[s]};
  return best;
}

struct Parts {
  int axis = 0;
  float cut = 0;
  std::span<RadianceRecord> lower, upper;
};

/// Halves of the records along the longest side of their bounding box. Both are empty if they
/// cannot be separated.
Parts halves(std::span<RadianceRecord> records) {
  Bounds3f bounds;
  for (const RadianceRecord& r : records) bounds.extendBy(r.p);
  Parts parts;
  parts.axis = static_cast<int>(bounds.majorAxis());
  const auto before = [&parts](const RadianceRecord& a, const RadianceRecord& b) {
    return a.p[parts.axis] < b.p[parts.axis];
  };
  const auto middle = records.begin() + records.size() / 2;
  std::nth_element(records.begin(), middle, records.end(), before);
  parts.cut = middle->p[parts.axis];
  if (!(parts.cut > bounds.min[parts.axis])) return parts;
  parts.lower = {records.begin(), middle};
  parts.upper = {middle, records.end()};
  return parts;
}

}  // namespace

/// A box that is judged by itself: it is cut where that pays, with a tree for each part.
struct RadianceGuide::Region {
  uint32_t box = 0;
  std::span<RadianceRecord> records;
  std::vector<Box> boxes{1};
  std::vector<DirectionTree::Node> nodes;
  size_t guided = 0;  ///< records in boxes that guide

  /// Makes box `at` from the records inside and returns its second moment [Q4].
  double settle(uint32_t at, std::span<RadianceRecord> inside) {
    const Judgement whole = judge(inside);
    if (inside.size() >= 2 * kMinRecords) {
      const Parts parts = halves(inside);
      const size_t boxes_before = boxes.size(), nodes_before = nodes.size(), before = guided;
      const uint32_t next = static_cast<uint32_t>(boxes.size());
      boxes[at] = {parts.axis, parts.cut, 0, next};
      boxes.resize(boxes.size() + 2);
      const double apart = parts.lower.empty()
                               ? whole.moment
                               : settle(next, parts.lower) + settle(next + 1, parts.upper);
      if (apart < kWorthCutting * whole.moment) return apart;
      boxes.resize(boxes_before);
      nodes.resize(nodes_before);
      guided = before;
    }
    boxes[at] = {-1, 0, whole.share, static_cast<uint32_t>(nodes.size())};
    if (whole.share > 0) {
      append_direction_tree(moments(inside, 0, 1), nodes);
      guided += inside.size();
    }
    return whole.moment;
  }
};

RadianceRecord RadianceRecord::at(const Vec3f& p, const Vec3f& n, bool glossy, const Vec3f& w,
                                  float pdf_w) {
  RadianceRecord r;
  r.p = p;
  r.square = equal_area_sphere_to_square(w);
  r.pdf_w = pdf_w;
  r.side = side_of(n, glossy);
  return r;
}

RadianceGuide::RadianceGuide(std::vector<RadianceRecord> records) : boxes_(kSides) {
  std::stable_sort(
      records.begin(), records.end(),
      [](const RadianceRecord& a, const RadianceRecord& b) { return a.side < b.side; });
  std::vector<Region> regions;
  auto begin = records.begin();
  for (uint8_t side = 0; side < kSides; ++side) {
    const auto end = std::find_if(begin, records.end(),
                                  [side](const RadianceRecord& r) { return r.side > side; });
    if (begin != end) cut(side, std::span(begin, end), regions);
    begin = end;
  }
  parallel_chunks(regions.size(), 1, [&](int64_t i, int64_t, int64_t) {
    Region& region = regions[i];
    region.settle(0, region.records);
  });
  size_t guided = 0;
  for (const Region& region : regions) {
    take(region);
    guided += region.guided;
  }
  if (guided > 0) guided_ = static_cast<double>(guided) / static_cast<double>(records.size());
}

void RadianceGuide::cut(uint32_t box, std::span<RadianceRecord> records,
                        std::vector<Region>& regions) {
  if (records.size() > kManyRecords) {
    const Parts parts = halves(records);
    if (!parts.lower.empty()) {
      const uint32_t next = static_cast<uint32_t>(boxes_.size());
      boxes_[box] = {parts.axis, parts.cut, 0, next};
      boxes_.resize(boxes_.size() + 2);
      cut(next, parts.lower, regions);
      cut(next + 1, parts.upper, regions);
      return;
    }
  }
  regions.emplace_back();
  regions.back().box = box;
  regions.back().records = records;
}

void RadianceGuide::take(const Region& region) {
  const uint32_t boxes = static_cast<uint32_t>(boxes_.size()) - 1,
                 nodes = static_cast<uint32_t>(nodes_.size());
  const auto moved = [&](Box box) {
    box.next += box.axis >= 0 ? boxes : nodes;
    return box;
  };
  boxes_[region.box] = moved(region.boxes[0]);
  for (size_t i = 1; i < region.boxes.size(); ++i) boxes_.push_back(moved(region.boxes[i]));
  nodes_.insert(nodes_.end(), region.nodes.begin(), region.nodes.end());
}

size_t RadianceGuide::bytes() const {
  return boxes_.size() * sizeof(Box) + nodes_.size() * sizeof(DirectionTree::Node);
}

bool RadianceGuide::is_sound() const {
  if (!(guided_ >= 0 && guided_ <= 1)) return false;
  if (boxes_.empty()) return guided_ == 0 && nodes_.empty();
  if (boxes_.size() < kSides) return false;
  std::vector<size_t> roots;
  for (size_t i = 0; i < boxes_.size(); ++i) {
    const Box& box = boxes_[i];
    // The parts of a box come after the box.
    if (box.axis >= 0 && (box.next <= i || size_t{box.next} + 1 >= boxes_.size())) return false;
    if (box.axis < 0 && box.share > 0) roots.push_back(box.next);
  }
  // Trees follow each other without gaps.
  std::ranges::sort(roots);
  roots.push_back(nodes_.size());
  if (roots.front() != 0) return false;
  const std::span nodes(nodes_);
  for (size_t i = 0; i + 1 < roots.size(); ++i)
    if (roots[i + 1] > nodes_.size() ||
        !is_sound_tree(nodes.subspan(roots[i], roots[i + 1] - roots[i])))
      return false;
  return true;
}

DirectionTree RadianceGuide::at(const Vec3f& p, const Vec3f& n, bool glossy) const {
  if (!guides()) return {};
  const Box* box = &boxes_[side_of(n, glossy)];
  while (box->axis >= 0) box = &boxes_[box->next + (p[box->axis] >= box->cut ? 1 : 0)];
  return box->share > 0 ? DirectionTree(&nodes_[box->next], box->share) : DirectionTree();
}

}  // namespace nephroid
