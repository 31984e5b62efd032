#pragma once

#include "report/serial/vocabulary.hpp"

#include <bit>
#include <cstddef>
#include <string>
#include <vector>

#include <openssl/evp.h>

namespace glissade::report {

/// Numbers as base64 of their little-endian bytes, with the name of their type; the target machines of the product are
/// little-endian, like base64 readers in browsers.
template <class Number>
Json packed(const char* type, const std::vector<Number>& values) {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t bytes = values.size() * sizeof(Number);
  std::string text(4 * ((bytes + 2) / 3) + 1, '\0');
  const int written =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(values.data()), static_cast<int>(bytes));
  text.resize(static_cast<std::size_t>(written));
  return {{"type", type}, {"data", std::move(text)}};
}

}  // namespace glissade::report
