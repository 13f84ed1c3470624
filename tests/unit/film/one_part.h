// Adds estimates to groups with a single part, as most test films have.
#pragma once

#include "film/film.h"

namespace nephroid::testing_support {

inline void add_one(Film& film, int group, int x, int y, const Rgb& value) {
  film.add(group, x, y, {&value, 1});
}
inline void replace_one(Film& film, int group, int x, int y, const Rgb& value) {
  film.replace(group, x, y, {&value, 1});
}

}  // namespace nephroid::testing_support
