#pragma once

#include "glissade/pipeline/track.hpp"

namespace glissade::pipeline {

/// While it lives, a request to stop is met by a search; the work then goes on with what that found.
class SearchGoesOn {
 public:
  explicit SearchGoesOn(const RunContext& context) : context_(context) { tell(true); }
  ~SearchGoesOn() { tell(context_.stop.stop_requested()); }
  SearchGoesOn(const SearchGoesOn&) = delete;
  SearchGoesOn& operator=(const SearchGoesOn&) = delete;

 private:
  void tell(bool goes_on) const {
    if (context_.goes_on_after_stop != nullptr) *context_.goes_on_after_stop = goes_on;
  }
  const RunContext& context_;
};

}  // namespace glissade::pipeline
