#include "glissade/study/plan.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include "study/table_file.hpp"
#include "study/trimmed.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace glissade::study {
namespace {

constexpr const char* kPointsMark = "points ";
constexpr const char* kDigestMark = " sha256:";

struct KeyAndRest {
  std::string key;
  std::string_view rest;
};

KeyAndRest split_key(std::string_view text, const std::string& option, const std::string& example) {
  const std::size_t sign = text.find('=');
  const std::string_view key = trimmed(text.substr(0, sign));
  const std::string_view rest =
      sign == std::string_view::npos ? std::string_view{} : trimmed(text.substr(sign + 1));
  if (!key.empty() && !rest.empty()) return {std::string(key), rest};
  throw InputError({option, "'" + std::string(text) + "' is not of the form KEY=...",
                    "A key is the path to a value in the design file, its names joined by dots.", example});
}

constexpr const char* kGridExample = "--vary body.friction_angle=10deg:25deg:151";

/// Commas between values; those within brackets, braces or quotes belong to a value.
std::vector<std::string> list_of(std::string_view text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = '\0';
  for (const char letter : text) {
    if (quote != '\0') {
      if (letter == quote) quote = '\0';
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth;
    } else if (letter == ']' || letter == '}') {
      --depth;
    } else if (letter == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += letter;
  }
  for (std::string& value : values) value = std::string(trimmed(value));
  return values;
}

/// The unit that all values share, if all of them are numbers.
Input input_of(std::string key, const std::vector<std::string>& values) {
  Input input{std::move(key), "", true};
  for (std::size_t index = 0; index < values.size(); ++index) {
    const auto quantity = split_quantity(values[index]);
    if (!quantity || (index != 0 && quantity->unit != input.unit)) return {std::move(input.key), "", false};
    input.unit = quantity->unit;
  }
  return input;
}

std::optional<std::vector<std::string_view>> grid_parts(std::string_view text) {
  const std::size_t first = text.find(':');
  const std::size_t last = text.rfind(':');
  if (first == std::string_view::npos || first == last) return {};
  const std::string_view middle = text.substr(first + 1, last - first - 1);
  if (middle.find(':') != std::string_view::npos || text.find_first_of("[{\"'") != std::string_view::npos)
    return {};
  return std::vector{trimmed(text.substr(0, first)), trimmed(middle), trimmed(text.substr(last + 1))};
}

std::uint64_t grid_count(std::string_view text, const std::string& key) {
  std::uint64_t count = 0;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (status == std::errc() && rest == text.data() + text.size() && count >= 1 &&
      count <= Plan::kMostPoints) {
    return count;
  }
  throw InputError({"--vary " + key,
                    "'" + std::string(text) + "' is no number of values from 1 to 1000000000",
                    "A grid is FROM:TO:NUMBER.", kGridExample});
}

Factor grid(const std::string& key, const std::vector<std::string_view>& parts) {
  const auto from = split_quantity(parts[0]);
  const auto to = split_quantity(parts[1]);
  const std::string place = "--vary " + key;
  if (!from || !to) {
    throw InputError({place, "'" + std::string(from ? parts[1] : parts[0]) + "' is no number",
                      "A grid is FROM:TO:NUMBER.", kGridExample});
  }
  if (from->unit != to->unit) {
    throw InputError(
        {place, "the ends " + std::string(parts[0]) + " and " + std::string(parts[1]) + " differ in unit",
         "The steps between them are counted in one unit.", kGridExample});
  }
  const std::uint64_t count = grid_count(parts[2], key);
  Factor factor;
  factor.inputs = {{key, from->unit, true}};
  factor.size = count;
  factor.grid = Grid{from->number, to->number, count};
  return factor;
}

void require_distinct(const std::vector<Input>& inputs, const std::string& place) {
  std::set<std::string> keys;
  for (const Input& input : inputs) {
    if (keys.insert(input.key).second) continue;
    throw InputError({place, input.key + " is given twice", "A key has one value at each point.", ""});
  }
}

std::string in_letters(std::string_view unit) {
  std::string text;
  if (unit.starts_with("1/")) unit.remove_prefix(1);
  for (const char letter : unit) {
    if (letter == '/') {
      text += text.empty() ? "per_" : "_per_";
    } else if (letter == '%') {
      text += "percent";
    } else if (letter != '^' && letter != ' ') {
      text += letter;
    }
  }
  return text;
}

}  // namespace

std::optional<SplitQuantity> split_quantity(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  SplitQuantity quantity;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), quantity.number);
  if (status != std::errc() || !std::isfinite(quantity.number)) return {};
  quantity.unit = std::string(trimmed({rest, static_cast<std::size_t>(text.data() + text.size() - rest)}));
  return quantity;
}

std::string joined_quantity(std::string number, std::string_view unit) {
  const bool runs_on = !unit.empty() && unit.front() >= '0' && unit.front() <= '9';
  return std::move(number) + (runs_on ? " " : "") + std::string(unit);
}

std::string Input::column() const {
  return unit.empty() ? key : key + "_" + in_letters(unit);
}

Factor vary(std::string_view text) {
  const auto [key, rest] = split_key(text, "--vary", kGridExample);
  Factor factor;
  if (const auto parts = grid_parts(rest)) {
    factor = grid(key, *parts);
  } else {
    const std::vector<std::string> values = list_of(rest);
    if (std::find(values.begin(), values.end(), "") != values.end()) {
      throw InputError({"--vary " + key, "'" + std::string(rest) + "' has an empty value",
                        "Values are separated by commas.", "--vary " + key + "=30deg,33deg"});
    }
    factor.inputs = {input_of(key, values)};
    factor.size = values.size();
    for (const std::string& value : values) factor.values.push_back({value});
  }
  factor.text = "vary " + key + "=" + std::string(rest);
  return factor;
}

Factor read_points(const std::filesystem::path& file) {
  const TableFile table = read_table(file);
  Factor factor;
  std::vector<std::string> units;
  for (const std::string& heading : table.headings) {
    const std::size_t open = heading.find('[');
    const bool with_unit = open != std::string::npos && heading.back() == ']';
    const std::string_view key =
        trimmed(std::string_view(heading).substr(0, with_unit ? open : heading.size()));
    units.emplace_back(
        with_unit ? trimmed(std::string_view(heading).substr(open + 1, heading.size() - open - 2)) : "");
    factor.inputs.push_back({std::string(key), "", true});
  }
  require_distinct(factor.inputs, table.place(0));
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::vector<std::string> values = table.rows[row];
    for (std::size_t column = 0; column < values.size(); ++column) {
      if (values[column].empty()) {
        throw InputError({table.place(row + 1), "column " + table.headings[column] + " is empty",
                          "A point has a value for every key.", ""});
      }
      values[column] = joined_quantity(std::move(values[column]), units[column]);
    }
    factor.values.push_back(std::move(values));
  }
  factor.size = factor.values.size();
  for (std::size_t column = 0; column < factor.inputs.size(); ++column) {
    std::vector<std::string> values;
    values.reserve(factor.values.size());
    for (const auto& row : factor.values) values.push_back(row[column]);
    factor.inputs[column] = input_of(factor.inputs[column].key, values);
  }
  factor.text = kPointsMark + file.filename().string() + kDigestMark + table.digest;
  return factor;
}

std::optional<std::string> points_file_of(std::string_view text) {
  const std::size_t digest = text.rfind(kDigestMark);
  const std::size_t name = std::string_view(kPointsMark).size();
  if (!text.starts_with(kPointsMark) || digest == std::string_view::npos || digest < name) return {};
  return std::string(text.substr(name, digest - name));
}

Factor scatter(const std::vector<std::string>& texts, Sampling sampling, std::uint64_t samples,
               std::uint64_t seed) {
  constexpr const char* kExample = "--scatter body.friction_angle=normal(17deg,1.5deg)";
  Factor factor;
  factor.size = samples;
  factor.text = "samples " + std::to_string(samples) + " " + std::string(word(sampling)) + " seed " +
                std::to_string(seed);
  for (const std::string& text : texts) {
    const auto [key, rest] = split_key(text, "--scatter", kExample);
    factor.distributions.push_back(Distribution::parse(rest, "--scatter " + key));
    factor.inputs.push_back({key, factor.distributions.back().unit(), true});
    factor.text += " " + key + "=" + factor.distributions.back().text();
  }
  require_distinct(factor.inputs, "--scatter");
  if (samples < 1 || samples > Plan::kMostPoints) {
    throw InputError(
        {"--samples", std::to_string(samples) + " is not within 1 to 1000000000", "", "--samples 1000"});
  }
  if (texts.size() > UnitCube::kMostDimensions) {
    throw InputError({"--scatter",
                      std::to_string(texts.size()) + " values scatter, more than " +
                          std::to_string(UnitCube::kMostDimensions),
                      "", "fewer of them"});
  }
  factor.cube = {sampling, samples, texts.size(), seed};
  return factor;
}

double Grid::at(std::uint64_t index) const {
  if (index == 0) return from;
  if (index + 1 == count) return to;
  const double steps = static_cast<double>(count - 1);
  // The product first, which keeps round steps round.
  const double way = (to - from) * static_cast<double>(index);
  if (std::isfinite(way)) return from + way / steps;
  const double share = static_cast<double>(index) / steps;
  return (1.0 - share) * from + share * to;
}

std::vector<std::string> Factor::at(std::uint64_t setting) const {
  if (setting >= size)
    throw InternalError({"", "a factor has no setting " + std::to_string(setting), "", ""});
  if (grid) return {joined_quantity(exact_text(grid->at(setting)), inputs.front().unit)};
  if (distributions.empty()) return values.at(setting);
  const std::vector<double> shares = cube.at(setting);
  std::vector<std::string> texts;
  texts.reserve(shares.size());
  for (std::size_t index = 0; index < shares.size(); ++index) {
    const Distribution& distribution = distributions[index];
    texts.push_back(joined_quantity(exact_text(distribution.quantile(shares[index])), distribution.unit()));
  }
  return texts;
}

Plan::Plan(std::vector<Factor> factors) : factors_(std::move(factors)) {
  if (factors_.empty()) {
    throw InputError({"", "nothing varies", "A sweep needs --vary, --points or --scatter.", kGridExample});
  }
  for (const Factor& factor : factors_) {
    if (factor.size > kMostPoints / count_) {
      throw InputError({"", "more than 1000000000 points", "That is the product of all numbers of values.",
                        "fewer values of each key"});
    }
    count_ *= factor.size;
    inputs_.insert(inputs_.end(), factor.inputs.begin(), factor.inputs.end());
  }
  require_distinct(inputs_, "");
}

std::vector<Override> Plan::point(std::uint64_t index) const {
  if (index >= count_) throw InternalError({"", "a sweep has no point " + std::to_string(index), "", ""});
  std::vector<std::vector<std::string>> settings(factors_.size());
  for (std::size_t place = factors_.size(); place-- > 0;) {
    settings[place] = factors_[place].at(index % factors_[place].size);
    index /= factors_[place].size;
  }
  std::vector<Override> values;
  values.reserve(inputs_.size());
  for (std::size_t place = 0; place < factors_.size(); ++place) {
    for (std::size_t column = 0; column < settings[place].size(); ++column) {
      values.push_back({factors_[place].inputs[column].key, std::move(settings[place][column])});
    }
  }
  return values;
}

}  // namespace glissade::study
