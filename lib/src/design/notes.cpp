#include "design/notes.hpp"

#include <algorithm>

namespace glissade::design_file {
namespace {

template <typename Thing>
void add_new(std::vector<Thing>& things, Thing thing) {
  if (std::find(things.begin(), things.end(), thing) == things.end()) things.push_back(std::move(thing));
}

}  // namespace

void Notes::quantity(const std::string& path, Dimension dimension) {
  add_new(places_[path].quantities, dimension);
}

void Notes::word(const std::string& path, std::string_view word) {
  add_new(places_[path].words, std::string(word));
}

void Notes::list(const std::string& path, const ItemCounts& counts) {
  places_[path].list = true;
  places_[path].items = counts;
}

void Notes::key(const std::string& path, std::string_view key, bool needed) {
  Noted& noted = places_[path];
  add_new(noted.keys, std::string(key));
  bool& is_needed = noted.is_needed[std::string(key)];
  is_needed = is_needed || needed;
}

Noted Notes::at(const std::string& path) const {
  const auto found = places_.find(path);
  return found == places_.end() ? Noted{} : found->second;
}

}  // namespace glissade::design_file
