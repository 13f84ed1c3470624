// Sparse grids of NanoVDB files; see nanovdb_grid.h.
#include "scene/medium/nanovdb_grid.h"

#include <nanovdb/NanoVDB.h>

#include <utility>

#include "scene/medium/nanovdb_file.h"

namespace nephroid {

namespace {

/// Bound of coordinates and transform entries, so that their products are finite.
constexpr double kMaxValue = 1e30;

using Root = nanovdb::NanoRoot<float>;
using Upper = nanovdb::NanoUpper<float>;
using Lower = nanovdb::NanoLower<float>;
using Leaf = nanovdb::NanoLeaf<float>;

/// Visits all nodes of a grid and checks where they lie.
class GridCheck {
 public:
  GridCheck(const NanoVdbBytes& bytes, std::string title, const SourceLocation& where)
      : begin_(reinterpret_cast<const char*>(bytes.data())),
        size_(bytes.size() * sizeof(NanoVdbBlock)),
        title_(std::move(title)),
        where_(where) {}

  void run();

 private:
  [[noreturn]] void fail(const std::string& what) const { throw SceneError(where_, title_ + what); }
  /// The node `offset` bytes after `from`. Fails unless all of it lies in the grid.
  template <class Node>
  const Node& node(const void* from, int64_t offset, int64_t bytes = sizeof(Node)) {
    const int64_t at = reinterpret_cast<const char*>(from) - begin_;
    const bool inside = offset <= size_ - at && offset >= -at && bytes <= size_ - at - offset;
    if (!inside || (at + offset) % 32 != 0) fail(" is broken: a node lies outside of it");
    // Nodes that are reached twice could make the walk very long.
    bytes_seen_ += bytes;
    if (bytes_seen_ > size_) fail(" is broken: nodes overlap");
    return *reinterpret_cast<const Node*>(begin_ + at + offset);
  }
  void value(float v) const {
    if (!std::isfinite(v)) fail(" has a value that is infinite or not a number");
  }
  void check_header(const nanovdb::GridData& grid) const;
  template <class Node>
  void check_internal(const Node& n);
  void check_leaf(const Leaf& leaf) const {
    for (uint32_t i = 0; i < Leaf::SIZE; ++i) value(leaf.data()->mValues[i]);
  }

  const char* begin_;
  int64_t size_, bytes_seen_ = 0;
  std::string title_;
  const SourceLocation& where_;
};

void GridCheck::check_header(const nanovdb::GridData& grid) const {
  if (grid.mMagic != NANOVDB_MAGIC_NUMBER || grid.mGridSize != static_cast<uint64_t>(size_))
    fail(" is broken: its header is wrong");
  if (grid.mGridType != nanovdb::GridType::Float)
    fail(" has values of another type, expected float");
  if (grid.mGridClass != nanovdb::GridClass::FogVolume &&
      grid.mGridClass != nanovdb::GridClass::Unknown)
    fail(" is of another class, expected a fog volume");
}

template <class Node>
void GridCheck::check_internal(const Node& n) {
  using Child = typename Node::ChildNodeType;
  for (uint32_t i = 0; i < Node::SIZE; ++i) {
    if (!n.data()->mChildMask.isOn(i)) {
      value(n.data()->mTable[i].value);
      continue;
    }
    const Child& child = node<Child>(&n, n.data()->mTable[i].child);
    if constexpr (std::is_same_v<Child, Leaf>)
      check_leaf(child);
    else
      check_internal(child);
  }
}

void GridCheck::run() {
  const auto& grid = node<nanovdb::GridData>(begin_, 0);
  check_header(grid);
  const auto& tree = node<nanovdb::TreeData<3>>(&grid, sizeof(nanovdb::GridData));
  const int64_t root_offset = tree.mNodeOffset[3];
  const uint32_t tiles = node<Root>(&tree, root_offset).data()->mTableSize;
  bytes_seen_ -= sizeof(Root);
  using Tile = Root::DataType::Tile;
  const auto& root =
      node<Root>(&tree, root_offset, int64_t{sizeof(Root)} + int64_t{tiles} * sizeof(Tile));
  value(root.background());
  for (uint32_t i = 0; i < tiles; ++i) {
    const Tile* tile = root.data()->tile(i);
    if (tile->isChild())
      check_internal(node<Upper>(&root, tile->child));
    else
      value(tile->value);
  }
}

Imath::V3i to_v3i(const nanovdb::Coord& c) {
  return {c[0], c[1], c[2]};
}

void visit_leaf(const Leaf& leaf, float least, const NanoVdbGrid::BoxVisitor& visit) {
  for (uint32_t i = 0; i < Leaf::SIZE; ++i) {
    const float v = leaf.data()->mValues[i];
    if (!(v > least)) continue;
    const Imath::V3i at = to_v3i(leaf.offsetToGlobalCoord(i));
    visit(at, at, v);
  }
}

template <class Node>
void visit_internal(const Node& n, float least, const NanoVdbGrid::BoxVisitor& visit) {
  using Child = typename Node::ChildNodeType;
  for (uint32_t i = 0; i < Node::SIZE; ++i) {
    if (!n.data()->mChildMask.isOn(i)) {
      const float v = n.data()->mTable[i].value;
      if (!(v > least)) continue;
      const Imath::V3i first = to_v3i(n.offsetToGlobalCoord(i));
      visit(first, first + Imath::V3i(Child::DIM - 1), v);
    } else if constexpr (std::is_same_v<Child, Leaf>) {
      visit_leaf(*n.data()->getChild(i), least, visit);
    } else {
      visit_internal(*n.data()->getChild(i), least, visit);
    }
  }
}

}  // namespace

struct NanoVdbGrid::Impl {
  NanoVdbBytes bytes;
  Mat44d medium_from_index;
  Vec3d medium_min, medium_max;

  const nanovdb::FloatGrid& grid() const {
    return *reinterpret_cast<const nanovdb::FloatGrid*>(bytes.data());
  }
};

NanoVdbGrid::NanoVdbGrid(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
NanoVdbGrid::~NanoVdbGrid() = default;

const Mat44d& NanoVdbGrid::medium_from_index() const {
  return impl_->medium_from_index;
}
const Vec3d& NanoVdbGrid::medium_min() const {
  return impl_->medium_min;
}
const Vec3d& NanoVdbGrid::medium_max() const {
  return impl_->medium_max;
}

std::unique_ptr<NanoVdbGrid> NanoVdbGrid::read(const std::string& file, const std::string& name,
                                               const std::string& path,
                                               const SourceLocation& where) {
  auto bytes = read_nanovdb_grid(file, name, path, where);
  if (!bytes) return nullptr;
  const std::string title = "grid \"" + name + "\" of NanoVDB file \"" + path + "\"";
  GridCheck(*bytes, title, where).run();

  auto impl = std::make_unique<Impl>();
  impl->bytes = std::move(*bytes);
  const auto& data = *reinterpret_cast<const nanovdb::GridData*>(impl->bytes.data());
  const auto is_usable = [](double x) { return std::abs(x) < kMaxValue; };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) impl->medium_from_index[j][i] = data.mMap.mMatD[3 * i + j];
    impl->medium_from_index[3][i] = data.mMap.mVecD[i];
    for (int j = 0; j < 4; ++j)
      if (!is_usable(impl->medium_from_index[j][i]))
        throw SceneError(where, title + " has a transform that is not finite");
    const double min = data.mWorldBBox.min()[i], max = data.mWorldBBox.max()[i];
    if (!is_usable(min) || !is_usable(max) || !(max - min > 1 / kMaxValue))
      throw SceneError(where, title + " is empty or infinite, expected finite bounds");
    impl->medium_min[i] = min;
    impl->medium_max[i] = max;
  }
  if (!is_invertible(impl->medium_from_index))
    throw SceneError(where, title + " has a transform without an inverse");
  return std::unique_ptr<NanoVdbGrid>(new NanoVdbGrid(std::move(impl)));
}

float NanoVdbGrid::background() const {
  return impl_->grid().tree().root().background();
}

float NanoVdbGrid::lookup(const Vec3d& index) const {
  int first[3];
  float t[3];
  for (int i = 0; i < 3; ++i) {
    // Also fails for NaN, and before values leave the range of int.
    if (!(std::abs(index[i]) < 1e9)) return background();
    const double floor = std::floor(index[i]);
    first[i] = static_cast<int>(floor);
    t[i] = static_cast<float>(index[i] - floor);
  }
  auto accessor = impl_->grid().tree().getAccessor();
  float sum = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const int bit[3] = {corner & 1, (corner >> 1) & 1, corner >> 2};
    float weight = 1.0f;
    for (int i = 0; i < 3; ++i) weight *= bit[i] ? t[i] : 1.0f - t[i];
    sum += weight * accessor.getValue({first[0] + bit[0], first[1] + bit[1], first[2] + bit[2]});
  }
  return sum;
}

void NanoVdbGrid::visit_values_above(float least, const BoxVisitor& visit) const {
  const Root& root = impl_->grid().tree().root();
  for (uint32_t i = 0; i < root.data()->mTableSize; ++i) {
    const auto* tile = root.data()->tile(i);
    if (tile->isChild()) {
      visit_internal(*root.data()->getChild(tile), least, visit);
    } else if (tile->value > least) {
      const Imath::V3i first = to_v3i(tile->origin());
      visit(first, first + Imath::V3i(Upper::DIM - 1), tile->value);
    }
  }
}

}  // namespace nephroid
