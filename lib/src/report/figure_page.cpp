#include "glissade/report/figure_page.hpp"

#include "glissade/core/version.hpp"

#include "report/line_style.hpp"
#include "report/markup.hpp"
#include "report/page_assets.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace glissade {

using namespace report;

namespace {

constexpr const char* kStyle =
    ":root{color-scheme:light dark;--paper:#f6f7f8;--panel:#fff;--ink:#16202a;--soft:#52606d;--grid:#dfe4e8}"
    "@media (prefers-color-scheme:dark){:root{--paper:#12171c;--panel:#1a2129;--ink:#e8edf2;--soft:#a3b0bd;"
    "--grid:#303b46}}"
    "body{margin:0 auto;max-width:1240px;padding:20px;background:var(--paper);color:var(--ink);"
    "font:15px/1.5 system-ui,'DejaVu Sans',sans-serif}"
    "h1{font-size:1.7rem;line-height:1.2;margin:0;overflow-wrap:anywhere}p{color:var(--soft);margin:4px 0 "
    "16px}"
    ".figures{columns:2 480px;column-gap:14px}"
    "figure{margin:0 0 14px;break-inside:avoid;background:#fff;border:1px solid "
    "var(--grid);border-radius:8px;padding:8px}"
    "figure svg{display:block;width:100%;height:auto}"
    ".scroll{overflow-x:auto;margin:16px 0;background:var(--panel);border:1px solid var(--grid);"
    "border-radius:8px;padding:8px}"
    // That a table goes on beyond its room: while it scrolls, where a browser can tell without a script; else on what is
    // narrower than any comparison.
    ".wide{timeline-scope:--across}.wide .scroll{scroll-timeline:--across x}.more{display:none;margin:16px 0 "
    "0}"
    "@media screen and (max-width:760px){.more{display:block}}"
    "@supports (animation-timeline:--across){@media "
    "screen{.more{display:block;max-height:0;margin:0;overflow:hidden;"
    "animation:more linear both;animation-timeline:--across}}}"
    "@keyframes more{0%,100%{max-height:4em;margin-top:16px}}"
    "table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}"
    "th,td{padding:5px 10px;border-bottom:1px solid var(--grid);text-align:right;white-space:nowrap}"
    "thead th{white-space:normal;vertical-align:bottom}"
    "th:first-child,td.remark{text-align:left}th:first-child{white-space:normal;min-width:8em}td.remark{"
    "color:var(--soft);white-space:normal}"
    "@media "
    "print{@page{margin:14mm}:root{--paper:#fff;--panel:#fff;--ink:#16202a;--soft:#52606d;--grid:#dfe4e8}"
    "body{max-width:none;padding:0;font-size:9pt}"
    ".figures{columns:1}figure{border:0;padding:0}figure svg{max-height:96mm}"
    ".scroll{border:0;overflow:visible;padding:0}tr{break-inside:avoid}"
    "table{font-size:7.5pt}th,td{padding:2px 4px}th:first-child{min-width:6em}}";

/// A table's cell: units with their exponents raised.
std::string cell_text(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kExponents = {
      {{"^2", "\u00b2"}, {"^3", "\u00b3"}}};
  for (const auto& [plain, raised] : kExponents) {
    for (std::size_t at = text.find(plain); at != std::string::npos; at = text.find(plain, at)) {
      text.replace(at, plain.size(), raised);
    }
  }
  return escaped_markup(text);
}

/// @param choice  the number of the row's choice; 0: none
std::string row_of(const std::vector<std::string>& cells, std::size_t columns, std::size_t choice) {
  std::string row = choice > 0 ? "<tr class=\"choice-" + std::to_string(choice) + "\">" : std::string("<tr>");
  row += "<th scope=\"row\">" + escaped_markup(cells.empty() ? "" : cells.front()) + "</th>";
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const bool remark = i + 1 == cells.size() && cells.size() < columns;
    row += remark ? R"(<td class="remark" colspan=")" + std::to_string(columns - i) + "\">"
                  : std::string("<td>");
    row += cell_text(cells[i]) + "</td>";
  }
  return row + "</tr>\n";
}

std::string table_of(const PageTable& table, bool chosen) {
  std::string text =
      "<div class=\"wide\"><p class=\"more\" aria-hidden=\"true\">The table goes on to the right: swipe or "
      "scroll "
      "\u2192</p>\n";
  text += R"(<div class="scroll" tabindex="0" role="region" aria-label="Comparison"><table><thead><tr>)";
  for (const std::string& heading : table.headings) {
    text += "<th scope=\"col\">" + escaped_markup(heading) + "</th>";
  }
  text += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    text += row_of(table.rows[i], table.headings.size(), chosen ? i + 1 : 0);
  return text + "</tbody></table></div></div>\n";
}

constexpr const char* kChoiceStyle =
    ".choice{position:absolute;opacity:0}"
    ".choices{display:flex;flex-wrap:wrap;gap:8px;align-items:center;margin:0 0 16px}"
    ".choices label,.choices "
    "button{display:inline-flex;align-items:center;gap:6px;min-height:36px;padding:2px 12px;"
    "border:1px solid "
    "var(--grid);border-radius:99px;background:var(--panel);color:var(--ink);font:inherit;cursor:pointer}"
    ".choices label svg{flex:none;width:28px;height:10px;background:#fff;border-radius:3px}"
    ".choices output{color:var(--soft);padding:0 4px}"
    "table button{all:unset;cursor:pointer;display:inline-block;min-height:28px}"
    "table button:focus-visible,.choices button:focus-visible{outline:2px solid}"
    "th[aria-sort=ascending] button::after{content:' \\25b2'}th[aria-sort=descending] "
    "button::after{content:' \\25bc'}"
    "th:first-child{position:sticky;left:0;background:var(--panel)}"
    "tr.lit>*,th button[aria-pressed=true]{font-weight:600}"
    "[data-lit] path.line:not(.lit){opacity:.15}path.line.lit{stroke-width:3.5}"
    "@media (max-width:640px){body{padding:12px}.choices label,.choices button{min-height:44px}table "
    "button{min-height:40px}"
    "th:first-child{max-width:42vw}.figures{columns:1}.choices{max-height:45vh;overflow-y:auto}}"
    "@media print{.choices button,.choices output{display:none}}";

/// Boxes that take lines and rows away, by style alone.
std::string choices_of(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string boxes;
  std::string rules;
  std::string labels;
  for (std::size_t i = 1; i <= names.size(); ++i) {
    const std::string n = std::to_string(i);
    boxes += "<input type=\"checkbox\" class=\"choice\" id=\"choose-" + n + "\" checked aria-label=\"" +
             escaped_markup(names[i - 1]) + "\">";
    rules += "#choose-" + n + ":not(:checked)~main .choice-" + n + "{display:none}#choose-" + n +
             ":not(:checked)~.choices label[for=choose-" + n + "]{opacity:.45}#choose-" + n +
             ":focus-visible~.choices label[for=choose-" + n + "]{outline:2px solid}";
    labels += "<label for=\"choose-" + n + "\"><svg viewBox=\"0 0 28 10\" aria-hidden=\"true\"><path " +
              choice_stroke(static_cast<int>(i)) + " stroke-width=\"2\" d=\"M0 5h28\"/></svg>" +
              escaped_markup(names[i - 1]) + "</label>";
  }
  return "<style>" + std::string(kChoiceStyle) + rules + "</style>\n" + boxes + "\n<div class=\"choices\">" +
         labels + "</div>\n";
}

}  // namespace

std::string figure_page_html(const FigurePage& page) {
  const bool chosen = !page.choices.empty() && !page.table.rows.empty();
  std::string text =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; ";
  if (chosen) text += "script-src 'unsafe-inline'; ";
  text += "base-uri 'none'; form-action 'none'\">\n";
  text +=
      "<title>" + escaped_markup(page.title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n";
  text += "<h1>" + escaped_markup(page.title) + "</h1>\n<p>" + escaped_markup(page.subtitle) + "</p>\n";
  text += choices_of(page.choices) + "<main>\n";
  if (!page.table.rows.empty()) text += table_of(page.table, !page.choices.empty());
  text += "<div class=\"figures\">\n";
  for (Figure figure : page.figures) {
    // The boxes name the lines.
    figure.legend = page.choices.empty();
    text += "<figure>" + figures_svg({figure}, 540.0) + "</figure>\n";
  }
  text += "</div>\n</main>\n<p>Made by Glissade " + std::string(version()) + ".</p>\n";
  if (chosen) text += "<script>" + std::string(page_assets::kChooser) + "</script>\n";
  return text + "</body>\n</html>\n";
}

}  // namespace glissade
