#include "glissade/report/report.hpp"

#include "report/markup.hpp"
#include "report/page_assets.hpp"

#include <string>
#include <string_view>

namespace glissade {

using namespace report;

namespace {

/// JSON inside a script element: "</script" and "<!--" must not occur, and a JSON string may spell '<' as
/// \u003c.
std::string escaped_json(std::string_view json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      escaped += "\\u003c";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

/// In a script "<\/script" means the same as "</script" and does not end the element.
std::string escaped_script(std::string_view script) {
  std::string escaped;
  escaped.reserve(script.size());
  constexpr std::string_view kEnd = "</script";
  for (std::size_t i = 0; i < script.size(); ++i) {
    const bool ends = script.compare(i, kEnd.size(), kEnd) == 0;
    escaped += script[i];
    if (ends) escaped += '\\';
  }
  return escaped;
}

}  // namespace

std::string report_html(const ReportInput& input) {
  std::string page;
  page += "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  // Nothing may be fetched, whatever a design file says.
  page +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
      "'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'\">\n";
  page += "<title>" + escaped_markup(input.design->name) + "</title>\n<style>\n";
  page += page_assets::kStyle;
  page +=
      "</style>\n</head>\n<body>\n<div id=\"page\"><noscript>This report draws itself with the scripts it "
      "carries; "
      "switch them on for this file.</noscript></div>\n";
  page += R"(<script type="application/json" id="glissade-data">)";
  page += escaped_json(report_json(input));
  page += "</script>\n<script>";
  page += escaped_script(page_assets::kScript);
  page += "</script>\n<script type=\"text/plain\" id=\"licences\">\n";
  page += escaped_script(page_assets::kLicences);
  page += "</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace glissade
