#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/shop/bolted.hpp"

#include <string>

/// @return what is wrong with the holes of bolts; empty: nothing
inline std::string bolt_fault(const glissade::Workshop& workshop) {
  try {
    (void)glissade::parts::require_bolts_meet(workshop);
  } catch (const glissade::InternalError& error) {
    return error.what();
  }
  return "";
}
