#include "input/mitsuba/plugin.h"

namespace nephroid::mitsuba {

void refuse_plugin(const Object& object, const Plugin* row, const std::vector<std::string>& known) {
  const std::string title = object.tag + " \"" + object.type + "\"";
  if (row) throw SceneError(object.where, title + " cannot be rendered: " + row->note);
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "\"" : ", \"") + name + "\"";
  throw SceneError(object.where, title + " is unknown, expected " +
                                     (names.empty() ? "none" : "one of " + names) +
                                     did_you_mean(object.type, known, object.tag));
}

}  // namespace nephroid::mitsuba
