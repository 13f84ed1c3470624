// Compiled routes: decide which estimator renders a path, a word of events and a light, eye first
// (docs/routes.md). Camera walks read words from the left, light walks from the right; where they
// meet, a table names the owner. It must not know scenes or estimators.
// Paper: Doidge et al. 2012, whose two sub-spaces are the preset doidge2012.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "route/route_set.h"
#include "route/symbols.h"

namespace nephroid {

/// The automaton's state after reading C e1 ... ek.
using EyeState = uint16_t;
/// The reversed automaton's state after reading the light and the events from it towards the eye.
using LightState = uint16_t;

/// A part of the picture: the words with the same owner that lie in the same AOVs. A route is the
/// sum of its parts, and so is an AOV.
using Part = uint8_t;
inline constexpr Part kNoPart = 255;

/// The route and the AOVs of a part.
struct PartMeaning {
  int route = 0;
  std::vector<int> aovs;
};

/// A set of symbols, e.g. those that a scene has.
struct SymbolSet {
  std::vector<bool> events;  ///< [EventSymbol]
  std::vector<bool> lights;  ///< [LightSymbol]
};

/// A table of numbers below 65536, stored as bytes if they fit.
class NumberTable {
 public:
  NumberTable() = default;
  explicit NumberTable(const std::vector<uint16_t>& numbers);
  uint16_t operator[](size_t i) const { return narrow_.empty() ? wide_[i] : narrow_[i]; }
  size_t bytes() const { return narrow_.size() + 2 * wide_.size(); }

 private:
  std::vector<uint8_t> narrow_;
  std::vector<uint16_t> wide_;
};

/// The compiled tables: rows are states, columns are symbols (8 per label).
struct RouteTables {
  size_t eye_states = 0, light_states = 0, event_symbols = 0, light_symbols = 0;
  NumberTable eye_next;     ///< [eye][event]
  NumberTable merge_next;   ///< [eye][event], where the event is the merge vertex
  std::vector<Part> owner;  ///< [eye][light]
  NumberTable emitted;      ///< [light symbol] -> LightState
  NumberTable light_next;   ///< [light state][event]
  std::vector<Part> meet;   ///< [eye][light state]
  EyeState start = 0;
};

/// The routes that one estimator samples together. Its walks use the index of the group.
struct RouteGroup {
  const EstimatorTraits* estimator = nullptr;
  std::vector<int> routes;
  std::vector<Part> parts;
};

class Routes {
 public:
  /// Called by compile_routes.
  Routes(std::vector<RouteDefinition> routes, std::vector<AovDefinition> aovs,
         std::vector<PartMeaning> parts, std::vector<std::string> labels, RouteTables tables);

  const std::vector<RouteDefinition>& definitions() const { return definitions_; }
  const std::vector<AovDefinition>& aovs() const { return aovs_; }
  const std::vector<PartMeaning>& parts() const { return parts_; }
  /// Names that expressions mention; labels()[i] is Label i + 1.
  const std::vector<std::string>& labels() const { return labels_; }
  const std::vector<RouteGroup>& groups() const { return groups_; }
  const RouteTables& tables() const { return tables_; }
  /// Label of a name: 0 if no expression mentions it.
  Label label(const std::string& name) const;

  /// The same routes for a scene with these symbols only: fewer events are useful.
  Routes restricted_to(const SymbolSet& symbols) const;

  EyeState start() const { return tables_.start; }
  /// State after one more event, seen from the eye.
  EyeState next(EyeState eye, EventSymbol e) const {
    return tables_.eye_next[eye * tables_.event_symbols + e];
  }
  /// The same if photons are merged at this event's vertex.
  EyeState merge(EyeState eye, EventSymbol e) const {
    return tables_.merge_next[eye * tables_.event_symbols + e];
  }
  /// Owner of the word that ends here with a light; never kNoPart for words without a merge and a
  /// light that some route can reach.
  Part owner(EyeState eye, LightSymbol light) const {
    return tables_.owner[eye * tables_.light_symbols + light];
  }

  /// State of a light walk before its first event.
  LightState emitted(LightSymbol light) const { return tables_.emitted[light]; }
  /// State after one more event, seen from the light.
  LightState light_next(LightState state, EventSymbol e) const {
    return tables_.light_next[state * tables_.event_symbols + e];
  }
  /// Owner of the word with the eye side `eye`, the vertex where they meet included, and the light
  /// side `light`, that vertex excluded. With an eye state from merge() it is kNoPart unless the
  /// owner merges exactly here.
  Part meet(EyeState eye, LightState light) const {
    return tables_.meet[eye * tables_.light_states + light];
  }

  /// True if the part belongs to the group (false for kNoPart).
  bool owns(size_t group, Part part) const { return part != kNoPart && part_group_[part] == group; }

  // Useful events of a group's walks, among the symbols that can occur. Masks have event classes,
  // kVolume included; a class is set if one of its sides is useful.

  /// True if some word that ends at a light here belongs to the group.
  bool ends(size_t group, EyeState eye) const { return flags_[group].ends[eye]; }
  /// Events after which a camera walk may still end at a light in a word of the group.
  ClassMask useful(size_t group, EyeState eye, Label label) const {
    return flags_[group].useful[eye * label_count() + label];
  }
  /// Events after which a camera walk may still come to a vertex where the group merges.
  ClassMask useful_before_merge(size_t group, EyeState eye, Label label) const {
    return flags_[group].useful_before_merge[eye * label_count() + label];
  }
  /// Classes of events at which the group may merge photons after this eye state.
  ClassMask merges(size_t group, EyeState eye, Label label) const {
    return flags_[group].merges[eye * label_count() + label];
  }
  /// Classes at which a photon with this light side may be merged by the group.
  ClassMask deposits(size_t group, LightState light, Label label) const {
    return flags_[group].deposits[light * label_count() + label];
  }
  /// Events after which a light walk may still store a photon, at the group's merge vertices.
  ClassMask useful_before_deposit(size_t group, LightState light, Label label) const {
    return flags_[group].useful_before_deposit[light * label_count() + label];
  }
  /// True if a light walk in this state is useful to the group's photons only if an S comes next.
  /// Without a state: true if any state is such.
  bool needs_specular(size_t group, LightState light) const {
    return flags_[group].needs_specular[light];
  }
  bool needs_specular(size_t group) const {
    const std::vector<bool>& states = flags_[group].needs_specular;
    return std::find(states.begin(), states.end(), true) != states.end();
  }
  /// Events after which a light walk may still be the light side of a word of the group, cut
  /// anywhere.
  ClassMask useful_from_light(size_t group, LightState light, Label label) const {
    return flags_[group].useful_from_light[light * label_count() + label];
  }
  /// Classes of first events e1 (seen from the eye) with which a light walk makes a word of the
  /// group when it is connected to the camera.
  ClassMask connects(size_t group, LightState light, Label label) const {
    return flags_[group].connects[light * label_count() + label];
  }
  /// Events after which a light walk may still be connected to the camera.
  ClassMask useful_before_connection(size_t group, LightState light, Label label) const {
    return flags_[group].useful_before_connection[light * label_count() + label];
  }

 private:
  struct Flags {
    std::vector<bool> ends, needs_specular;
    std::vector<ClassMask> useful, useful_before_merge, merges, deposits, useful_before_deposit,
        useful_from_light, connects, useful_before_connection;
  };
  size_t label_count() const { return labels_.size() + 1; }
  void find_useful_events(const SymbolSet& symbols);
  /// [light state]: true if a reachable eye state makes a word of the group with it.
  std::vector<bool> states_that_meet(size_t group, const std::vector<bool>& reached) const;

  std::vector<RouteDefinition> definitions_;
  std::vector<AovDefinition> aovs_;
  std::vector<PartMeaning> parts_;
  std::vector<std::string> labels_;
  RouteTables tables_;
  std::vector<RouteGroup> groups_;
  std::vector<uint8_t> part_group_;
  std::vector<Flags> flags_;  ///< [group]
};

}  // namespace nephroid
