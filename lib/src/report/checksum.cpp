#include "glissade/core/error.hpp"
#include "glissade/core/stop.hpp"
#include "glissade/report/report.hpp"

#include <array>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <openssl/evp.h>

namespace glissade {

namespace {

/// One running checksum.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    good_ = context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
  }

  void add(const char* bytes, std::size_t count) {
    good_ = good_ && EVP_DigestUpdate(context_.get(), bytes, count) == 1;
  }

  /// @return 64 hexadecimal digits; none if the library failed
  [[nodiscard]] std::optional<std::string> digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (!good_ || EVP_DigestFinal_ex(context_.get(), digest.data(), &size) != 1) return {};
    constexpr const char* kDigits = "0123456789abcdef";
    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
      text += kDigits[digest[i] >> 4U];
      text += kDigits[digest[i] & 15U];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
  bool good_ = false;
};

}  // namespace

std::string sha256_of_file(const std::filesystem::path& file, const std::stop_token& stop) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw FileError({file.string(), "cannot be read for its checksum", "", "whether it still exists"});
  Sha256 sum;
  std::vector<char> block(1U << 20U);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0) {
    require_going(stop);
    sum.add(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  const auto digits = sum.digits();
  if (stream.bad() || !digits) throw FileError({file.string(), "its checksum could not be computed", "", ""});
  return *digits;
}

std::string sha256_of_text(std::string_view text) {
  Sha256 sum;
  sum.add(text.data(), text.size());
  if (auto digits = sum.digits()) return *std::move(digits);
  throw InternalError({"", "a checksum could not be computed", "", ""});
}

}  // namespace glissade
