#include "io/text_scanner.hpp"

#include <algorithm>
#include <cstring>

namespace glissade::io {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18U;
constexpr std::size_t kMostPeek = 4096;

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\f' || c == '\v';
}

}  // namespace

TextScanner::TextScanner(ByteSource& source) : source_(source), buffer_(kBufferSize), size_(source.size()) {}

/// Moves what is left to the front and fills up behind it; @return whether anything was added
bool TextScanner::refill() {
  const std::size_t left = filled_ - place_;
  std::memmove(buffer_.data(), buffer_.data() + place_, left);
  scanned_ += place_;
  place_ = 0;
  filled_ = left;
  const std::size_t added = source_.read(buffer_.data() + left, buffer_.size() - left);
  filled_ += added;
  // A file that grew meanwhile has more bytes than its size said.
  size_ = std::max(size_, scanned_ + filled_);
  return added > 0;
}

std::string_view TextScanner::peek(std::size_t count) {
  if (filled_ - place_ < std::min(count, kMostPeek)) (void)refill();
  return {buffer_.data() + place_, std::min({count, kMostPeek, filled_ - place_})};
}

std::size_t TextScanner::read(char* buffer, std::size_t count) {
  const std::size_t buffered = std::min(count, filled_ - place_);
  std::memcpy(buffer, buffer_.data() + place_, buffered);
  place_ += buffered;
  if (buffered == count) return count;
  const std::size_t added = source_.read(buffer + buffered, count - buffered);
  scanned_ += added;
  size_ = std::max(size_, scanned_ + place_);
  return buffered + added;
}

void TextScanner::skip_to_line_end() {
  while (!at_end() && !is_line_end(buffer_[place_])) ++place_;
}

void TextScanner::skip_line_break() {
  const char first = buffer_[place_++];
  ++line_;
  if (first == '\r' && !at_end() && buffer_[place_] == '\n') ++place_;
}

void TextScanner::skip_line() {
  skip_to_line_end();
  if (!at_end()) skip_line_break();
}

/// Blanks and comments within a line.
void TextScanner::skip_blanks() {
  while (!at_end() && is_blank(buffer_[place_])) ++place_;
  if (comment_ != 0 && !at_end() && buffer_[place_] == comment_) skip_to_line_end();
}

std::string_view TextScanner::word() {
  skip_blanks();
  while (!at_end() && is_line_end(buffer_[place_])) {
    skip_line_break();
    skip_blanks();
  }
  return take_word();
}

std::string_view TextScanner::take_word() {
  if (filled_ - place_ < kLongestWord) (void)refill();
  const std::size_t most = std::min(filled_ - place_, kLongestWord);
  std::size_t length = 0;
  while (length < most) {
    const char c = buffer_[place_ + length];
    if (is_blank(c) || is_line_end(c) || (comment_ != 0 && c == comment_)) break;
    ++length;
  }
  const std::string_view word(buffer_.data() + place_, length);
  place_ += length;
  return word;
}

}  // namespace glissade::io
