#include "glissade/core/error.hpp"

namespace glissade {
namespace {

std::string joined(const std::vector<Issue>& issues) {
  std::string text;
  for (const Issue& issue : issues) {
    if (!text.empty()) text += '\n';
    text += to_text(issue);
  }
  return text;
}

}  // namespace

std::string to_text(const Issue& issue) {
  constexpr const char* kIndent = "\n      ";
  std::string text = issue.where.empty() ? issue.what : issue.where + ": " + issue.what;
  if (!issue.why.empty()) text += kIndent + issue.why;
  if (!issue.hint.empty()) text += kIndent + ("Try: " + issue.hint);
  return text;
}

Error::Error(std::vector<Issue> issues) : std::runtime_error(joined(issues)), issues_(std::move(issues)) {}

}  // namespace glissade
