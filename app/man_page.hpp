#pragma once

#include <string>
#include <vector>

namespace glissade::app {

struct HelpPage;

/// @return a page of section 1 for man(1), as troff with the macros man; no date, so that the same program always
///         makes the same bytes
/// @param page  the help of the program or of a command
/// @param also  names of pages to read on
[[nodiscard]] std::string man_page(const HelpPage& page, const std::vector<std::string>& also);

/// @return what the page of a command is called: "glissade-build"
[[nodiscard]] std::string man_name(const HelpPage& page);

}  // namespace glissade::app
