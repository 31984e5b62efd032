#pragma once

#include <string_view>

namespace glissade::report::page_assets {

/// The committed bundle of the page (web/dist), as built from web/src.
extern const std::string_view kScript;
extern const std::string_view kStyle;
extern const std::string_view kLicences;
/// Of a page of figures that lets its reader choose.
extern const std::string_view kChooser;

}  // namespace glissade::report::page_assets
