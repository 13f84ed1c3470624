// What a film is, in the metadata of its state, so that it can be made again without the scene.
// It must not know what is in a film.
#pragma once

#include "film/film.h"
#include "film/state_file.h"

namespace nephroid {

/// `passes_add_up`: those of the film's estimators are independent of each other.
void add_film_metadata(const Film& film, bool passes_add_up, Metadata* metadata);

/// Metadata of a state without what the program alone reads, for its picture.
Metadata picture_metadata_of(Metadata metadata);

/// An empty film like that of the picture. Throws IoError if its metadata make no sense.
Film film_of(const StateFile& file);

/// What add_film_metadata was told.
bool passes_add_up(const StateFile& file);

}  // namespace nephroid
