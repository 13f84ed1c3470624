// The state of a view as JSON, as docs/view-protocol.md says.
#pragma once

#include <string>
#include <vector>

#include "view/live_state.h"

namespace nephroid {

/// A picture to compare with, as the page lists it.
struct ListedComparison {
  std::string id, name;
};

/// `save_directory` is empty if the page downloads what it saves.
std::string state_json(const LiveState& state, const std::vector<ListedComparison>& comparisons,
                       const std::string& save_directory);

}  // namespace nephroid
