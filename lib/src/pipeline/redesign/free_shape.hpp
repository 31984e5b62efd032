#pragma once

#include "glissade/pipeline/redesign.hpp"

#include "pipeline/redesign/ruled_letters.hpp"

namespace glissade::pipeline {

/// The free shape. Where a search ended with a worse one than is known, or with none, what is known is the answer.
/// @param places  counted from the edge
/// @param result  with all other shapes; told of the search
[[nodiscard]] RedesignShape free_shape(const Design& design, const RedesignOptions& options,
                                       const InRunShape& certificate, const RuledLetters& ruled,
                                       const Problem& places, const RunContext& context, Redesign& result);

}  // namespace glissade::pipeline
