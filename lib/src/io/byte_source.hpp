#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>

namespace glissade::io {

/// Bytes in order, of a known number: a file, or memory in tests.
class ByteSource {
 public:
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  /// @return bytes in all
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// @return bytes put into `buffer`; fewer than `count` only at the end
  /// @throws FileError if the system refuses
  [[nodiscard]] virtual std::size_t read(char* buffer, std::size_t count) = 0;

 protected:
  ByteSource() = default;
};

class FileSource final : public ByteSource {
 public:
  /// @throws FileError if the file cannot be opened or is a directory, a device or a pipe
  /// @param stop  read() throws Interrupted if it asks for it
  explicit FileSource(std::filesystem::path file, std::stop_token stop = {});
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override;

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] std::size_t read(char* buffer, std::size_t count) override;

 private:
  std::filesystem::path file_;
  std::stop_token stop_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// @return everything in a file
/// @param most  bytes that are read
/// @throws FileError as FileSource, or if the file is larger than that
[[nodiscard]] std::string whole_text(const std::filesystem::path& file, std::uint64_t most);

class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : rest_(bytes), size_(bytes.size()) {}

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] std::size_t read(char* buffer, std::size_t count) override {
    const std::size_t taken = rest_.copy(buffer, count);
    rest_.remove_prefix(taken);
    return taken;
  }

 private:
  std::string_view rest_;
  std::uint64_t size_;
};

}  // namespace glissade::io
