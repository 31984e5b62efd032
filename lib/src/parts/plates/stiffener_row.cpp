#include "parts/plates/stiffener_row.hpp"

#include "parts/plates/even_row.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// The last free place between a free one and one that is not.
double edge_of_free(double free, double taken, const StiffenerSeats& seats) {
  constexpr double kExact = 1e-6;  // accuracy: a hundredth of what a shop tells apart [m]
  while (std::fabs(taken - free) > kExact) {
    const double middle = 0.5 * (free + taken);
    (seats.is_free(middle) ? free : taken) = middle;
  }
  return free;
}

/// All free places that are looked at, and those where free stretches end.
std::vector<double> free_places(const StiffenerSeats& seats) {
  std::vector<double> free;
  bool was_free = false;
  for (std::size_t i = 0; i < seats.places.size(); ++i) {
    const double here = seats.places[i];
    const bool is_free = seats.is_free(here);
    if (seats.anywhere && i > 0 && is_free != was_free) {
      const double before = seats.places[i - 1];
      free.push_back(is_free ? edge_of_free(here, before, seats) : edge_of_free(before, here, seats));
    }
    if (is_free) free.push_back(here);
    was_free = is_free;
  }
  return free;
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
  std::vector<double> places = free_places(seats);
  places.insert(places.end(), even.begin(), even.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  RowTask task = task_of(unit, spacing, std::move(places));
  task.beside = [&](std::size_t a, std::size_t b) { return seats.beside(task.places[a], task.places[b]); };
  std::vector<double> row;
  for (const std::size_t i : cheapest_row(task)) row.push_back(task.places[i]);
  return row;
}

}  // namespace glissade::parts
