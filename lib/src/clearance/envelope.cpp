#include "glissade/clearance/envelope.hpp"

#include "glissade/core/error.hpp"

namespace glissade {

std::string_view to_text(EnvelopePart part) {
  switch (part) {
    case EnvelopePart::floor:
      return "floor";
    case EnvelopePart::underside:
      return "underside";
    case EnvelopePart::rim:
      return "rim";
    case EnvelopePart::headroom:
      return "headroom";
    case EnvelopePart::side:
      return "side";
    case EnvelopePart::start_face:
      return "start face";
    case EnvelopePart::finish_face:
      return "finish face";
  }
  throw InternalError({"", "a part of an envelope without a name", "", ""});
}

}  // namespace glissade
