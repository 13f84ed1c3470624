#include "input/mitsuba/references.h"

#include <algorithm>

#include "input/spelling.h"

namespace nephroid::mitsuba {
namespace {

constexpr int kMaxReferenceDepth = 128;  ///< objects within each other, also by reference

/// A walk over all objects, each once. The depth of an object is that of what it holds, so that
/// chains of references are found wherever the walk meets them first.
class Resolver {
 public:
  explicit Resolver(const Ids& ids) : ids_(ids) {}

  /// The depth of the object.
  int resolve(Object& object, int depth) {
    const auto [entry, is_new] = depths_.try_emplace(&object, kInProgress);
    if (!is_new) {
      if (entry->second == kInProgress)
        throw SceneError(object.where, "\"" + object.id + "\" refers to itself");
      return entry->second;
    }
    int below = 0;
    for (Child& child : object.children) {
      if (!child.object) child.object = ids_.find(child.reference, child.where);
      if (depth > kMaxReferenceDepth) refuse(child.where);
      // The tree is ours until the document is returned.
      below = std::max(below, resolve(const_cast<Object&>(*child.object), depth + 1));
      if (below > kMaxReferenceDepth) refuse(child.where);
    }
    return depths_[&object] = below + 1;
  }

 private:
  static constexpr int kInProgress = 0;

  [[noreturn]] static void refuse(const SourceLocation& where) {
    throw SceneError(where, "objects are nested more than " + std::to_string(kMaxReferenceDepth) +
                                " levels deep, expected fewer");
  }

  const Ids& ids_;
  std::map<const Object*, int> depths_;
};

}  // namespace

void Ids::add(const std::string& id, Object* object) {
  const SourceLocation where = object->where;
  const auto [entry, is_new] = objects_.try_emplace(id, object);
  if (!is_new)
    throw SceneError(where,
                     "id \"" + id + "\" is already given at " + entry->second->where.to_string());
}

void Ids::add_alias(const std::string& id, const std::string& as, const SourceLocation& where) {
  aliases_[as] = {id, where};
}

Object* Ids::find(const std::string& id, const SourceLocation& where) const {
  std::string name = id;
  for (size_t i = 0; i <= aliases_.size(); ++i) {
    const auto object = objects_.find(name);
    if (object != objects_.end()) return object->second;
    const auto alias = aliases_.find(name);
    if (alias == aliases_.end()) break;
    name = alias->second.id;
  }
  std::vector<std::string> known;
  for (const auto& entry : objects_) known.push_back(entry.first);
  throw SceneError(where, "there is no object with id \"" + id +
                              "\", expected the id of an object" + did_you_mean(id, known));
}

void resolve_references(Object& root, const Ids& ids) {
  Resolver(ids).resolve(root, 0);
}

}  // namespace nephroid::mitsuba
