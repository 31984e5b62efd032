#include "glissade/core/number_text.hpp"
#include "glissade/core/version.hpp"
#include "glissade/study/summary.hpp"

#include "report/markup.hpp"
#include "report/page_assets.hpp"
#include "study/page_assets.hpp"

#include <cstdlib>

#include <nlohmann/json.hpp>

namespace glissade::study {
namespace {

using Json = nlohmann::ordered_json;

/// Seven digits are more than a plot shows and less than half of what a double takes.
Json rounded(double value) {
  constexpr int kDigits = 7;
  return std::strtod(rounded_text(value, kDigits).c_str(), nullptr);
}

Json facts_json(const ColumnFacts& facts) {
  Json quantiles = Json::array();
  for (const double value : facts.quantiles) quantiles.push_back(rounded(value));
  return {{"name", facts.name},
          {"count", facts.count},
          {"lowest", rounded(facts.lowest)},
          {"highest", rounded(facts.highest)},
          {"mean", rounded(facts.mean)},
          {"deviation", rounded(facts.standard_deviation)},
          {"quantiles", std::move(quantiles)},
          {"histogram", facts.histogram}};
}

Json axis_json(const Axis& axis) {
  return {{"input", axis.input},
          {"values", axis.values},
          {"lowest", axis.lowest},
          {"highest", axis.highest},
          {"cells", axis.cells}};
}

Json firsts_json(const std::vector<FirstPoint>& points) {
  Json json = Json::array();
  for (const FirstPoint& point : points) json.push_back({{"index", point.index}, {"inputs", point.inputs}});
  return json;
}

Json band_json(const Band& band) {
  Json values = Json::array();
  for (const auto& quantity : band.values) {
    Json cells = Json::array();
    for (const auto& cell : quantity) {
      cells.push_back(cell ? Json::array({rounded((*cell)[0]), rounded((*cell)[1]), rounded((*cell)[2])})
                           : Json(nullptr));
    }
    values.push_back(std::move(cells));
  }
  return {{"across", axis_json(band.across)},
          {"counts", band.counts},
          {"first", firsts_json(band.first_points)},
          {"values", std::move(values)}};
}

Json map_json(const Map& map) {
  Json means = Json::array();
  for (const auto& quantity : map.means) {
    Json cells = Json::array();
    for (const auto& mean : quantity) cells.push_back(mean ? rounded(*mean) : Json(nullptr));
    means.push_back(std::move(cells));
  }
  return {{"across", axis_json(map.across)},
          {"up", axis_json(map.up)},
          {"counts", map.counts},
          {"first", firsts_json(map.first_points)},
          {"means", std::move(means)}};
}

Json best_json(const std::vector<std::vector<BestPoint>>& best) {
  Json json = Json::array();
  for (const auto& points : best) {
    Json rows = Json::array();
    for (const BestPoint& point : points) {
      rows.push_back({{"index", point.index}, {"value", rounded(point.value)}, {"inputs", point.inputs}});
    }
    json.push_back(std::move(rows));
  }
  return json;
}

Json counts_json(const Summary& summary) {
  Json json = Json::array();
  for (const Status status : kStatuses) {
    const auto found = summary.counts.find(status);
    if (found == summary.counts.end()) continue;
    const auto reason = summary.reasons.find(status);
    json.push_back({{"status", word(status)},
                    {"count", found->second},
                    {"reason", reason == summary.reasons.end() ? "" : reason->second}});
  }
  return json;
}

Json influences_json(const Summary& summary) {
  Json json = Json::array();
  for (const Influence& influence : summary.influences) {
    for (std::size_t place = 0; place < summary.varying.size(); ++place) {
      if (summary.varying[place] != influence.quantity) continue;
      json.push_back({{"input", influence.input},
                      {"quantity", place},
                      {"rank", rounded(influence.rank_correlation)},
                      {"rankError", rounded(influence.rank_correlation_error)},
                      {"firstOrder", influence.first_order ? rounded(*influence.first_order) : Json(nullptr)},
                      {"firstOrderError", rounded(influence.first_order_error)},
                      {"dependent", influence.dependent_here}});
    }
  }
  return json;
}

Json page_data(const Results& results, const Summary& summary) {
  Json json;
  json["title"] = "Sweep of " + results.design();
  json["program"] = "glissade " + std::string(version());
  json["design"] = results.design();
  json["base"] = results.base();
  json["frozen"] = results.frozen();
  json["points"] = summary.points;
  json["kept"] = summary.kept;
  json["objective"] = "travel_time_s";
  json["counts"] = counts_json(summary);
  json["inputKeys"] = Json::array();
  for (std::size_t column = 0; column < results.keys().size(); ++column) {
    json["inputKeys"].push_back({{"key", results.keys()[column]},
                                 {"unit", results.units()[column]},
                                 {"column", results.inputs()[column]}});
  }
  json["inputs"] = Json::array();
  for (const ColumnFacts& facts : summary.inputs) json["inputs"].push_back(facts_json(facts));
  json["quantities"] = Json::array();
  for (const std::size_t quantity : summary.varying)
    json["quantities"].push_back(facts_json(summary.quantities[quantity]));
  json["constant"] = Json::array();
  for (const ColumnFacts& facts : summary.quantities) {
    if (facts.count != 0 && !facts.varies()) {
      json["constant"].push_back({{"name", facts.name}, {"value", rounded(facts.lowest)}});
    }
  }
  json["influences"] = influences_json(summary);
  json["bands"] = Json::array();
  for (const Band& band : summary.bands) json["bands"].push_back(band_json(band));
  json["maps"] = Json::array();
  for (const Map& map : summary.maps) json["maps"].push_back(map_json(map));
  json["lowest"] = best_json(summary.lowest);
  json["highest"] = best_json(summary.highest);
  return json;
}

/// Inside a script element nothing but "</" needs care.
std::string script_safe(std::string text) {
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace

std::string summary_page(const Results& results, const Summary& summary) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>";
  page += report::escaped_markup("Sweep of " + results.design()) + "</title>\n<style>\n";
  page += std::string(report::page_assets::kStyle) + std::string(page_assets::kStyle) +
          "</style>\n</head>\n<body>\n";
  page +=
      "<main id=\"page\"><noscript>The figures of this page are drawn by a script inside "
      "it.</noscript></main>\n";
  page += "<script type=\"application/json\" id=\"sweep-data\">";
  page += script_safe(page_data(results, summary).dump(-1, ' ', false, Json::error_handler_t::replace));
  page += "</script>\n<script>\n" + std::string(page_assets::kScript) + "</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace glissade::study
