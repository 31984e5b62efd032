#pragma once

#include <string_view>

/// What the page of a sweep is made of, from web/.
namespace glissade::study::page_assets {

extern const std::string_view kScript;
extern const std::string_view kStyle;

}  // namespace glissade::study::page_assets
