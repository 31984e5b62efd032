#include "optimize/problem/passages.hpp"

#include <cstddef>
#include <utility>

namespace glissade::optimizer {
namespace {

constexpr std::size_t kMostPassages = 16;  // budget: 2^4 ways past four keep-outs

}  // namespace

std::vector<Passages> all_passages(const Limits& limits) {
  std::vector<Passages> all{{}};
  for (const KeepOut& keep_out : limits.keep_outs) {
    std::vector<Passages> longer;
    for (const Passages& begun : all) {
      for (const Passage side : {Passage::above, Passage::below}) {
        if (keep_out.passage != Passage::either && keep_out.passage != side) continue;
        // Beyond the cap the earlier keep-outs have branched already; the later ones go above.
        if (keep_out.passage == Passage::either && side == Passage::below && all.size() >= kMostPassages)
          continue;
        Passages passages = begun;
        passages.push_back(side);
        longer.push_back(std::move(passages));
      }
    }
    all = std::move(longer);
  }
  return all;
}

}  // namespace glissade::optimizer
