#pragma once

#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"
#include "glissade/motion/motion.hpp"

#include <string>

namespace glissade::pipeline {

/// @return what resists where a body stalls, for a message: "the friction angle, 17 deg"
[[nodiscard]] std::string friction_text(const Body& body, const Stall& stall);

/// @param length  of the whole track [m]
[[nodiscard]] Issue law_end_problem(const Design& design, const LawEnd& end, double length);

}  // namespace glissade::pipeline
