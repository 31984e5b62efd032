#include "parts/plates/even_row.hpp"

#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace glissade::parts {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Of the rows that end with a place the cheapest one.
struct Way {
  RowCost cost;
  std::size_t from = kNone;
};

std::tuple<double, std::size_t, double> as_part(const RowCost& cost) {
  return {cost.excess, cost.count, cost.uneven};
}

RowCost with_end(const RowTask& task, const RowCost& cost, double span) {
  return cost.with(task.end_weight * span, task.spacing);
}

/// Too few cost more than anything.
bool is_cheaper(const RowTask& task, const RowCost& one, const RowCost& other) {
  return std::pair(one.count < task.least, as_part(one)) <
         std::pair(other.count < task.least, as_part(other));
}

}  // namespace

RowCost RowCost::with(double span, double spacing) const {
  constexpr double kSame = 1e-9;  // rounding [m]
  const double more = span > spacing + kSame ? span - spacing : 0.0;
  return {excess + more * more, count, uneven + span * span};
}

RowCost cost_of(const RowTask& task, const std::vector<std::size_t>& row) {
  RowCost cost = with_end(task, RowCost(), task.places[row.front()] - task.from);
  for (std::size_t i = 1; i < row.size(); ++i)
    cost = cost.with(task.places[row[i]] - task.places[row[i - 1]], task.spacing);
  cost = with_end(task, cost, task.to - task.places[row.back()]);
  cost.count = row.size();
  return cost;
}

std::vector<std::size_t> cheapest_row(const RowTask& task) {
  std::vector<Way> ways(task.places.size());
  std::optional<Way> best;
  std::size_t last = kNone;
  const auto end_with = [&](std::size_t i, Way way) {
    way.cost = with_end(task, way.cost, task.to - task.places[i]);
    if (best && !is_cheaper(task, way.cost, best->cost)) return;
    best = way;
    last = i;
  };
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double at = task.places[i];
    Way first{with_end(task, RowCost(), at - task.from), kNone};
    first.cost.count = 1;
    std::optional<Way> joined;
    for (std::size_t k = 0; k < i; ++k) {
      if (!task.beside(k, i)) continue;
      Way one{ways[k].cost.with(at - task.places[k], task.spacing), k};
      ++one.cost.count;
      if (!joined || is_cheaper(task, one.cost, joined->cost)) joined = one;
    }
    end_with(i, first);
    if (joined) end_with(i, *joined);
    // What goes on from here has two or more, either way.
    ways[i] = joined && as_part(joined->cost) < as_part(first.cost) ? *joined : first;
  }
  std::vector<std::size_t> row;
  if (last == kNone) return row;
  row.push_back(last);
  for (std::size_t from = best->from; from != kNone; from = ways[from].from) row.insert(row.begin(), from);
  return row;
}

}  // namespace glissade::parts
