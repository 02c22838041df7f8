// count_contacts.hpp: how many contacts each grain has now.
#pragma once

#include "core/state.hpp"

namespace wedge {

/// Pre: positions and images are those of now. Post: contacts.contact_count of each grain is the number of its
/// contacts with grains, images and walls (overlap > 0); an image has its owner's.
void count_contacts(State& state);

}  // namespace wedge
