// Describes a film in the metadata of its state, so that it can be recreated without the scene. It
// must not know the contents of a film.
#pragma once

#include "film/film.h"
#include "film/state_file.h"

namespace nephroid {

/// `passes_add_up`: see passes_add_up() in checkpoint.h.
void add_film_metadata(const Film& film, bool passes_add_up, Metadata* metadata);

/// The metadata of a state without the entry that only the program reads, for its picture.
Metadata picture_metadata_of(Metadata metadata);

/// An empty film with the settings and layout of the state's. Throws IoError if its metadata are
/// invalid.
Film film_of(const StateFile& file);

/// The `passes_add_up` of add_film_metadata.
bool passes_add_up(const StateFile& file);

}  // namespace nephroid
