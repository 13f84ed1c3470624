#include "input/gltf/deformation.h"

#include <algorithm>
#include <cmath>

#include "core/counted.h"

namespace nephroid::gltf {
namespace {

void add_weighted(Document& document, const JsonValue& target, const std::string& name,
                  double weight, std::vector<Vec3f>& to) {
  if (to.empty()) return;
  const std::optional<NumberArray> offsets = find_accessor(document, target, name, 3);
  if (!offsets) return;
  if (offsets->count != to.size())
    target.fail(name + " has " + counted(offsets->count, "element") + ", expected " +
                std::to_string(to.size()) + ", one per vertex");
  const auto w = static_cast<float>(weight);
  for (size_t i = 0; i < to.size(); ++i)
    to[i] += Vec3f((*offsets)[i][0], (*offsets)[i][1], (*offsets)[i][2]) * w;
}

/// Warns of the attributes of a target that do not move.
void warn_of_lost_attributes(Document& document, const JsonValue& target) {
  for (const std::string& name : target.member_names())
    if (name.starts_with("TEXCOORD_") || name.starts_with("COLOR_"))
      document.diagnostics().warn(target.where(), "this morph target of " + name +
                                                      " is ignored: positions, normals and "
                                                      "tangents are morphed");
}

/// The matrices of a skin's joints, mesh to world.
std::vector<Mat44d> joint_matrices(Document& document, const JsonValue& skin,
                                   const NodeGraph& nodes) {
  std::vector<Mat44d> matrices;
  for (const JsonValue& joint : skin.get("joints").elements()) {
    document.item("nodes", joint.index(), joint);
    matrices.push_back(nodes.world(joint.index()).start);
  }
  const auto inverse = find_accessor(document, skin, "inverseBindMatrices", 16);
  if (!inverse) return matrices;
  if (inverse->count < matrices.size())
    skin.get("inverseBindMatrices")
        .fail("there are " + counted(inverse->count, "matrix", "matrices") + " for " +
              counted(matrices.size(), "joint") + ", expected one for each");
  for (size_t i = 0; i < matrices.size(); ++i) {
    Mat44d m;
    for (int k = 0; k < 16; ++k) m[k / 4][k % 4] = (*inverse)[i][k];
    matrices[i] = m * matrices[i];
  }
  return matrices;
}

/// The weighted sum of joint matrices for a vertex, from up to eight sets of four joints.
class Blend {
 public:
  Blend(AttributeSource& source, const JsonValue& primitive, size_t vertices,
        std::vector<Mat44d> joints)
      : joints_(std::move(joints)) {
    constexpr size_t kMaxSets = 8;
    for (size_t set = 0; set < kMaxSets; ++set) {
      auto numbers = source.find("JOINTS_" + std::to_string(set));
      auto weights = source.find("WEIGHTS_" + std::to_string(set));
      if (!numbers || !weights) break;
      if (numbers->width != 4 || weights->width != 4 || numbers->count != vertices ||
          weights->count != vertices)
        primitive.fail("JOINTS_n or WEIGHTS_n is wrong, expected four numbers for each vertex");
      for (const float joint : numbers->values)
        if (!(joint >= 0 && joint < static_cast<float>(joints_.size())))
          primitive.fail("joint " + std::to_string(static_cast<int64_t>(joint)) +
                         " is out of range, the skin has " + counted(joints_.size(), "joint"));
      sets_.push_back({*std::move(numbers), *std::move(weights)});
    }
    if (sets_.empty())
      primitive.fail("a skinned primitive lacks JOINTS_0 or WEIGHTS_0, expected both");
  }

  Mat44d at(size_t vertex) const {
    Mat44d sum(0.0);
    double total = 0;
    for (const auto& [numbers, weights] : sets_)
      for (size_t k = 0; k < 4; ++k) {
        const double weight = weights[vertex][k];
        if (weight == 0) continue;
        sum += joints_[static_cast<size_t>(numbers[vertex][k])] * weight;
        total += weight;
      }
    return total > 0 ? sum * (1 / total) : joints_[0];
  }

 private:
  struct Set {
    NumberArray numbers, weights;
  };
  std::vector<Mat44d> joints_;
  std::vector<Set> sets_;
};

/// The images of the axes.
struct Axes {
  explicit Axes(const Mat44d& m)
      : x(m[0][0], m[0][1], m[0][2]), y(m[1][0], m[1][1], m[1][2]), z(m[2][0], m[2][1], m[2][2]) {}
  bool is_mirrored() const { return x.dot(y.cross(z)) < 0; }

  Vec3d x, y, z;
};

/// The unit normal transformed by the cofactors of the matrix, which exist even where it has no
/// inverse. They are the inverse transposed times the determinant, whose sign is undone.
Vec3f transformed_normal(const Axes& to, const Vec3f& n) {
  const Vec3d sum = to.y.cross(to.z) * double{n.x} + to.z.cross(to.x) * double{n.y} +
                    to.x.cross(to.y) * double{n.z};
  const double length = to.is_mirrored() ? -sum.length() : sum.length();
  return length != 0 ? to_float(sum / length) : n;
}

/// Reverses the winding of all triangles.
void turn_over(std::vector<uint32_t>& triangles) {
  for (size_t t = 0; t + 2 < triangles.size(); t += 3)
    std::swap(triangles[t + 1], triangles[t + 2]);
}

}  // namespace

std::vector<double> morph_weights(const JsonValue& node, size_t node_index, const JsonValue& mesh,
                                  const AnimationPose& animation) {
  std::vector<double> weights;
  if (const std::vector<float>* animated = animation.weights(node_index))
    weights.assign(animated->begin(), animated->end());
  else if (node.find("weights"))
    weights = node.find_numbers("weights");
  else
    weights = mesh.find_numbers("weights");
  const bool any = std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; });
  return any ? weights : std::vector<double>();
}

void morph(Document& document, const JsonValue& primitive, const std::vector<double>& weights,
           Vertices& vertices) {
  const std::optional<JsonValue> targets = primitive.find_array("targets");
  if (!targets) return;
  const std::vector<JsonValue> list = targets->elements();
  for (size_t i = 0; i < std::min(list.size(), weights.size()); ++i) {
    if (weights[i] == 0) continue;
    warn_of_lost_attributes(document, list[i]);
    add_weighted(document, list[i], "POSITION", weights[i], vertices.positions);
    add_weighted(document, list[i], "NORMAL", weights[i], vertices.normals);
    add_weighted(document, list[i], "TANGENT", weights[i], vertices.tangents);
  }
}

void skin(Document& document, const JsonValue& skin, AttributeSource& source,
          const JsonValue& primitive, const NodeGraph& nodes, Vertices& vertices) {
  std::vector<Mat44d> joints = joint_matrices(document, skin, nodes);
  if (joints.empty()) skin.get("joints").fail("a skin has no joints, expected at least one");
  const Blend blend(source, primitive, vertices.positions.size(), std::move(joints));
  size_t mirrored = 0;
  for (size_t i = 0; i < vertices.positions.size(); ++i) {
    const Mat44d m = blend.at(i);
    const Axes axes(m);
    if (axes.is_mirrored()) ++mirrored;
    Vec3d p;
    m.multVecMatrix(to_double(vertices.positions[i]), p);
    vertices.positions[i] = to_float(p);
    if (!vertices.normals.empty())
      vertices.normals[i] = transformed_normal(axes, vertices.normals[i]);
    if (!vertices.tangents.empty()) {
      Vec3d t;
      m.multDirMatrix(to_double(vertices.tangents[i]), t);
      vertices.tangents[i] = to_float(t);
      if (axes.is_mirrored()) vertices.tangent_signs[i] = -vertices.tangent_signs[i];
    }
  }
  if (2 * mirrored > vertices.positions.size()) turn_over(vertices.triangles);
}

}  // namespace nephroid::gltf
