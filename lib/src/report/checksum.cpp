#include "glissade/core/error.hpp"
#include "glissade/report/report.hpp"

#include <array>
#include <fstream>
#include <memory>

#include <openssl/evp.h>

namespace glissade {

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw FileError({file.string(), "cannot be read for its checksum", "", "whether it still exists"});

  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int digest_size = 0;
  bool good = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::vector<char> block(1U << 20U);
  while (good &&
         (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0)) {
    good = EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(stream.gcount())) == 1;
  }
  good = good && !stream.bad() && EVP_DigestFinal_ex(context.get(), digest.data(), &digest_size) == 1;
  if (!good) throw FileError({file.string(), "its checksum could not be computed", "", ""});

  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < digest_size; ++i) {
    text += kDigits[digest[i] >> 4U];
    text += kDigits[digest[i] & 15U];
  }
  return text;
}

}  // namespace glissade
