#pragma once

#include "glissade/parts/shop_part.hpp"

#include <cstddef>

namespace glissade::parts {

/// Holds points along the edges of every piece, and straight edges, against the insides of all others.
/// @return how many pairs were looked at
/// @throws InternalError if two parts clash: which, and by how much
std::size_t require_no_clash(const Workshop& workshop);

}  // namespace glissade::parts
