#include "io/zip_archive.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <zlib.h>

namespace glissade::io {
namespace {

constexpr std::uint32_t kLocalMark = 0x04034b50;
constexpr std::uint32_t kCentralMark = 0x02014b50;
constexpr std::uint32_t kEndMark = 0x06054b50;
constexpr std::uint32_t kVersion = 20;  // deflate
constexpr std::uint32_t kDeflated = 8;
constexpr std::uint32_t kDate = 0x0021;  // 1 January 1980
constexpr std::size_t kLocalBytes = 30;
constexpr std::size_t kCentralBytes = 46;
constexpr std::size_t kEndBytes = 22;
constexpr std::uint64_t kLargestEntry = std::uint64_t{1} << 30U;

void put(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) {
    bytes += static_cast<char>(value & 0xFFU);
    value >>= 8U;
  }
}

std::uint32_t checksum(std::string_view bytes) {
  uLong sum = crc32(0, nullptr, 0);
  while (!bytes.empty()) {
    const std::size_t count = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
    sum = crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(count));
    bytes.remove_prefix(count);
  }
  return static_cast<std::uint32_t>(sum);
}

/// Without zlib's own head and foot, as zip wants it.
std::string deflated(const std::string& content) {
  z_stream stream{};
  constexpr int kRaw = -MAX_WBITS;
  constexpr int kMemory = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw InternalError({"zlib", "cannot start", "", ""});
  }
  std::string packed(deflateBound(&stream, static_cast<uLong>(content.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw InternalError({"zlib", "cannot deflate", "", ""});
  return packed;
}

/// @return whether exactly `size` bytes came out
bool inflate_into(std::string_view packed, std::string& content, std::size_t size) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw InternalError({"zlib", "cannot start", "", ""});
  // As the bytes come, not as the archive claims: a lie about the size takes no memory.
  constexpr std::size_t kChunk = std::size_t{1} << 20U;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  int status = Z_OK;
  while (status == Z_OK && content.size() <= size) {
    const std::size_t before = content.size();
    content.resize(before + kChunk);
    stream.next_out = reinterpret_cast<Bytef*>(content.data() + before);
    stream.avail_out = static_cast<uInt>(kChunk);
    status = inflate(&stream, Z_NO_FLUSH);
    content.resize(content.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END && content.size() == size;
}

/// Fields that local and central headers share, from "version needed" to the length of the extra field.
void put_common(std::string& bytes, const ZipEntry& entry, const std::string& packed) {
  put(bytes, kVersion, 2);
  put(bytes, 0, 2);  // flags
  put(bytes, kDeflated, 2);
  put(bytes, 0, 2);  // midnight
  put(bytes, kDate, 2);
  put(bytes, checksum(entry.content), 4);
  put(bytes, static_cast<std::uint32_t>(packed.size()), 4);
  put(bytes, static_cast<std::uint32_t>(entry.content.size()), 4);
  put(bytes, static_cast<std::uint32_t>(entry.name.size()), 2);
  put(bytes, 0, 2);
}

class Archive {
 public:
  Archive(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::vector<ZipEntry> entries() {
    const std::size_t end = end_record();
    const std::uint32_t count = number(end + 10, 2);
    std::size_t place = number(end + 16, 4);
    std::vector<ZipEntry> found;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (number(place, 4) != kCentralMark) throw error("an entry of its directory is damaged");
      found.push_back(entry(place));
      place += kCentralBytes + number(place + 28, 2) + number(place + 30, 2) + number(place + 32, 2);
    }
    return found;
  }

 private:
  [[nodiscard]] FileError error(const std::string& what) const {
    return FileError({name_, "is no whole zip archive: " + what, "A 3MF file is one.", ""});
  }

  [[nodiscard]] std::uint32_t number(std::size_t place, int count) const {
    if (place > bytes_.size() || bytes_.size() - place < static_cast<std::size_t>(count))
      throw error("it is cut off");
    std::uint32_t value = 0;
    for (int i = count - 1; i >= 0; --i) {
      value = (value << 8U) | static_cast<unsigned char>(bytes_[place + static_cast<std::size_t>(i)]);
    }
    return value;
  }

  [[nodiscard]] std::string_view part(std::size_t place, std::size_t size) const {
    if (place > bytes_.size() || bytes_.size() - place < size) throw error("it is cut off");
    return bytes_.substr(place, size);
  }

  [[nodiscard]] std::size_t end_record() const {
    if (bytes_.size() < kEndBytes) throw error("it is too short");
    constexpr std::size_t kLongestComment = 65535;
    const std::size_t last = bytes_.size() - kEndBytes;
    for (std::size_t back = 0; back <= std::min(last, kLongestComment); ++back) {
      if (number(last - back, 4) == kEndMark) return last - back;
    }
    throw error("its directory is missing");
  }

  [[nodiscard]] ZipEntry entry(std::size_t place) const {
    constexpr std::uint32_t kEncrypted = 1;
    const std::uint32_t method = number(place + 10, 2);
    const std::size_t packed_size = number(place + 20, 4);
    const std::size_t size = number(place + 24, 4);
    ZipEntry entry;
    entry.name = part(place + kCentralBytes, number(place + 28, 2));
    if ((number(place + 8, 2) & kEncrypted) != 0) throw error("an entry is encrypted");
    if (size > kLargestEntry) throw error("an entry has " + std::to_string(size) + " bytes");
    const std::size_t local = number(place + 42, 4);
    if (number(local, 4) != kLocalMark) throw error("the head of an entry is damaged");
    const std::size_t data = local + kLocalBytes + number(local + 26, 2) + number(local + 28, 2);
    const std::string_view packed = part(data, packed_size);
    if (method == 0 && packed_size == size) {
      entry.content = packed;
    } else if (method != kDeflated || !inflate_into(packed, entry.content, size)) {
      throw error("an entry is damaged");
    }
    if (checksum(entry.content) != number(place + 16, 4)) throw error("the checksum of an entry is wrong");
    return entry;
  }

  std::string_view bytes_;
  const std::string& name_;
};

}  // namespace

std::string zip_bytes(const std::vector<ZipEntry>& entries) {
  std::string bytes;
  std::string directory;
  for (const ZipEntry& entry : entries) {
    if (entry.content.size() > kLargestEntry) {
      throw InputError({entry.name, "has " + std::to_string(entry.content.size()) + " bytes",
                        "An entry of an archive has at most " + std::to_string(kLargestEntry) + ".",
                        "a coarser tolerance"});
    }
    const std::string packed = deflated(entry.content);
    const auto place = static_cast<std::uint32_t>(bytes.size());
    put(bytes, kLocalMark, 4);
    put_common(bytes, entry, packed);
    bytes += entry.name;
    bytes += packed;
    put(directory, kCentralMark, 4);
    put(directory, kVersion, 2);
    put_common(directory, entry, packed);
    put(directory, 0, 2);  // length of the comment
    put(directory, 0, 2);  // disk
    put(directory, 0, 2);  // internal attributes
    put(directory, 0, 4);  // external attributes
    put(directory, place, 4);
    directory += entry.name;
  }
  const auto start = static_cast<std::uint32_t>(bytes.size());
  bytes += directory;
  put(bytes, kEndMark, 4);
  put(bytes, 0, 4);  // disks
  put(bytes, static_cast<std::uint32_t>(entries.size()), 2);
  put(bytes, static_cast<std::uint32_t>(entries.size()), 2);
  put(bytes, static_cast<std::uint32_t>(directory.size()), 4);
  put(bytes, start, 4);
  put(bytes, 0, 2);  // length of the comment
  return bytes;
}

std::vector<ZipEntry> unzipped(std::string_view archive, const std::string& name) {
  return Archive(archive, name).entries();
}

}  // namespace glissade::io
