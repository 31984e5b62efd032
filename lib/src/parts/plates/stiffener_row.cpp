#include "parts/plates/stiffener_row.hpp"

#include "parts/plates/even_row.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace glissade::parts {
namespace {

RowTask task_of(const Span& unit, double spacing, std::vector<double> places) {
  RowTask task;
  task.places = std::move(places);
  task.from = unit.from;
  task.to = unit.to;
  task.spacing = spacing;
  return task;
}

/// The free place nearest to one.
std::optional<double> nearest_to(double about, const StiffenerSeats& seats) {
  if (seats.anywhere && seats.is_free(about)) return about;
  std::vector<double> places = seats.places;
  std::sort(places.begin(), places.end(), [&](double a, double b) {
    return std::pair(std::fabs(a - about), a) < std::pair(std::fabs(b - about), b);
  });
  const auto first = std::find_if(places.begin(), places.end(), seats.is_free);
  if (first == places.end()) return std::nullopt;
  return *first;
}

/// Those nearest to so many even gaps; one that would stand in the way of the one before it is left out.
std::vector<double> nearest_to_even(const Span& unit, double gaps, const StiffenerSeats& seats) {
  std::vector<double> row;
  for (double k = 1.0; k < gaps; k += 1.0) {
    const auto at = nearest_to(unit.from + (unit.to - unit.from) * k / gaps, seats);
    if (at && (row.empty() || (*at > row.back() && seats.beside(row.back(), *at)))) row.push_back(*at);
  }
  return row;
}

}  // namespace

std::vector<double> stiffener_row(const Span& unit, double spacing, const StiffenerSeats& seats) {
  const double gaps = std::ceil((unit.to - unit.from) / spacing - 1e-9);
  if (!(gaps > 1.0)) return {};
  const std::vector<double> even = nearest_to_even(unit, gaps, seats);
  std::vector<std::size_t> whole(even.size());
  std::iota(whole.begin(), whole.end(), std::size_t{0});
  if (!even.empty() && cost_of(task_of(unit, spacing, even), whole).excess == 0.0) return even;
  std::vector<double> places = even;
  std::copy_if(seats.places.begin(), seats.places.end(), std::back_inserter(places), seats.is_free);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  RowTask task = task_of(unit, spacing, std::move(places));
  task.beside = [&](std::size_t a, std::size_t b) { return seats.beside(task.places[a], task.places[b]); };
  std::vector<double> row;
  for (const std::size_t i : cheapest_row(task)) row.push_back(task.places[i]);
  return row;
}

}  // namespace glissade::parts
