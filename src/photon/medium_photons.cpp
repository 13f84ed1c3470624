#include "photon/medium_photons.h"

#include <bit>
#include <limits>

#include "photon/photon_order.h"

namespace nephroid {

MediumPhotons::MediumPhotons(std::vector<Photon> photons,
                             const std::function<float(const Vec3f&)>& radius_at,
                             std::vector<uint32_t>* order)
    : photons_(std::move(photons)) {
  if (photons_.empty()) return;
  Vec3f min = photons_[0].p, max = min;
  for (const Photon& photon : photons_)
    for (int i = 0; i < 3; ++i) {
      min[i] = std::min(min[i], photon.p[i]);
      max[i] = std::max(max[i], photon.p[i]);
    }
  constexpr float kCells = 0x1p21f;
  const float extent = std::max(max_component(max - min), std::numeric_limits<float>::min());
  const auto cell = [&](float x, int axis) {
    return static_cast<uint32_t>(std::min((x - min[axis]) / extent * kCells, kCells - 1));
  };
  std::vector<uint64_t> codes;
  codes.reserve(photons_.size());
  for (const Photon& photon : photons_)
    codes.push_back(morton_code(cell(photon.p.x, 0), cell(photon.p.y, 1), cell(photon.p.z, 2)));
  std::vector<uint32_t> places = sort_codes(codes);
  const size_t of_photons = photons_.capacity() * sizeof(Photon);
  bytes_ = of_photons + photons_.size() * kBytesToSortCode;
  if (order != nullptr) *order = places;
  take_in_order(photons_, places);
  places = {};
  radii_.reserve(photons_.size());
  for (const Photon& photon : photons_) radii_.push_back(radius_at(photon.p));
  nodes_.reserve(photons_.size());
  build(0, static_cast<uint32_t>(photons_.size()), codes);
  bytes_ = std::max(bytes_, of_photons + codes.size() * sizeof(uint64_t) +
                                radii_.size() * sizeof(float) + nodes_.capacity() * sizeof(Node));
}

void MediumPhotons::build(uint32_t begin, uint32_t end, const std::vector<uint64_t>& codes) {
  const size_t index = nodes_.size();
  Node& node = nodes_.emplace_back();
  if (end - begin <= kLeafSize) {
    node.first = begin;
    node.count = end - begin;
    node.min = Vec3f(kInfinity);
    node.max = Vec3f(-kInfinity);
    for (uint32_t i = begin; i < end; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        node.min[axis] = std::min(node.min[axis], photons_[i].p[axis] - radii_[i]);
        node.max[axis] = std::max(node.max[axis], photons_[i].p[axis] + radii_[i]);
      }
    return;
  }
  // At the first plane that separates the cells of the run.
  uint32_t middle = begin + (end - begin) / 2;
  if (const uint64_t differing = codes[begin] ^ codes[end - 1]; differing != 0) {
    const uint64_t above = codes[end - 1] & ~(std::bit_floor(differing) - 1);
    middle = static_cast<uint32_t>(
        std::lower_bound(codes.begin() + begin, codes.begin() + end, above) - codes.begin());
  }
  build(begin, middle, codes);
  const auto second = static_cast<uint32_t>(nodes_.size());
  build(middle, end, codes);
  Node& all = nodes_[index];
  const Node &a = nodes_[index + 1], &b = nodes_[second];
  all.first = second;
  for (int axis = 0; axis < 3; ++axis) {
    all.min[axis] = std::min(a.min[axis], b.min[axis]);
    all.max[axis] = std::max(a.max[axis], b.max[axis]);
  }
}

}  // namespace nephroid
