#include "input/gltf/node_graph.h"

#include <algorithm>
#include <cmath>

namespace nephroid::gltf {
namespace {

/// The node's own transform: its matrix, or its translation, rotation and scale with what is
/// animated.
Mat44d local_transform(const JsonValue& node, size_t index, const AnimationPose& animation) {
  const std::vector<double> numbers = node.find_numbers("matrix", 16);
  if (!numbers.empty()) {
    // Column by column for column vectors is row by row for row vectors.
    Mat44d m;
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[i];
    return m;
  }
  NodePose pose;
  pose.translation = node.get_numbers<3>("translation", pose.translation);
  pose.rotation = node.get_numbers<4>("rotation", pose.rotation);
  pose.scale = node.get_numbers<3>("scale", pose.scale);
  animation.apply(index, pose);
  return matrix_of(pose);
}

bool is_hidden(const JsonValue& node) {
  const auto visibility = node.extension("KHR_node_visibility");
  return visibility && !visibility->get_flag("visible", true);
}

}  // namespace

Mat44d matrix_of(const NodePose& pose) {
  const auto [x, y, z, w] = pose.rotation;
  const double n = x * x + y * y + z * z + w * w;
  const double s = n > 0 ? 2 / n : 0;
  // Rows are the images of the axes: points are row vectors.
  Mat44d m(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y), 0,
           s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x), 0,
           s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y), 0,
           pose.translation[0], pose.translation[1], pose.translation[2], 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] *= pose.scale[i];
  return m;
}

std::optional<JsonValue> chosen_scene(Document& document) {
  if (document.root().find("scene")) return document.item_of("scenes", document.root(), "scene");
  const std::vector<JsonValue>& scenes = document.list("scenes");
  return scenes.empty() ? std::nullopt : std::optional<JsonValue>(scenes.front());
}

NodeGraph::NodeGraph(Document& document, const AnimationPose& start, const AnimationPose& end) {
  find_parents(document);
  find_worlds(document, start, end);
  find_shown(document);
}

void NodeGraph::find_parents(Document& document) {
  const std::vector<JsonValue>& nodes = document.list("nodes");
  parents_.assign(nodes.size(), kNone);
  children_.resize(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i) {
    const std::optional<JsonValue> children = nodes[i].find_array("children");
    if (!children) continue;
    for (const JsonValue& child : children->elements()) {
      document.item("nodes", child.index(), child);
      if (parents_[child.index()] != kNone)
        child.fail("node " + std::to_string(child.index()) +
                   " is a child of two nodes, expected one parent");
      parents_[child.index()] = i;
      children_[i].push_back(child.index());
    }
  }
}

void NodeGraph::find_worlds(Document& document, const AnimationPose& start,
                            const AnimationPose& end) {
  const std::vector<JsonValue>& nodes = document.list("nodes");
  worlds_.resize(nodes.size());
  // From the roots downwards, without recursion: chains may be long.
  std::vector<size_t> order;
  for (size_t i = 0; i < nodes.size(); ++i)
    if (parents_[i] == kNone) order.push_back(i);
  for (size_t next = 0; next < order.size(); ++next) {
    const size_t node = order[next];
    if (start.moves(node) && nodes[node].find("matrix"))
      document.diagnostics().warn(nodes[node].where(),
                                  "the animation of this node is ignored: the node has a matrix, "
                                  "expected translation, rotation and scale");
    worlds_[node] = {local_transform(nodes[node], node, start),
                     local_transform(nodes[node], node, end)};
    if (const size_t parent = parents_[node]; parent != kNone) {
      worlds_[node].start = worlds_[node].start * worlds_[parent].start;
      worlds_[node].end = worlds_[node].end * worlds_[parent].end;
    }
    order.insert(order.end(), children_[node].begin(), children_[node].end());
  }
  if (order.size() == nodes.size()) return;
  std::vector<bool> reached(nodes.size(), false);
  for (const size_t node : order) reached[node] = true;
  const auto lost = std::find(reached.begin(), reached.end(), false) - reached.begin();
  nodes[lost].fail("this node is a descendant of itself, expected a tree of nodes");
}

void NodeGraph::find_shown(Document& document) {
  const std::vector<JsonValue>& nodes = document.list("nodes");
  std::vector<bool> taken(nodes.size(), false);
  const auto take = [&](size_t node) {
    if (taken[node] || is_hidden(nodes[node])) return;
    taken[node] = true;
    shown_.push_back(node);
  };
  if (const std::optional<JsonValue> scene = chosen_scene(document)) {
    const std::optional<JsonValue> roots = scene->find_array("nodes");
    for (const JsonValue& root : roots ? roots->elements() : std::vector<JsonValue>()) {
      document.item("nodes", root.index(), root);
      take(root.index());
    }
  } else {
    for (size_t i = 0; i < nodes.size(); ++i)
      if (parents_[i] == kNone) take(i);
  }
  for (size_t next = 0; next < shown_.size(); ++next)
    for (const size_t child : std::vector<size_t>(children_[shown_[next]])) take(child);
}

}  // namespace nephroid::gltf
