#include "design/findings.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace glissade::design_file {
namespace {

bool is_within(std::string_view key_path, std::string_view ancestor) {
  if (ancestor.empty() || key_path == ancestor) return true;
  return key_path.starts_with(ancestor) && key_path[ancestor.size()] == '.';
}

}  // namespace

std::string_view parent_path(std::string_view key_path) {
  const std::size_t dot = key_path.rfind('.');
  return dot == std::string_view::npos ? std::string_view{} : key_path.substr(0, dot);
}

Position Findings::position(std::string_view key_path) const {
  for (;; key_path = parent_path(key_path)) {
    const auto found = positions_.find(key_path);
    if (found != positions_.end()) return found->second;
    if (key_path.empty()) return {};
  }
}

std::string Findings::where(Position position) const {
  if (position.override_index >= 0) {
    return "--set " + overrides_[static_cast<std::size_t>(position.override_index)].key_path;
  }
  std::string text = file_.string();
  if (position.line == 0) return text;
  return text + ":" + std::to_string(position.line) + ":" + std::to_string(position.column);
}

std::map<std::string, std::string, std::less<>> Findings::locations() const {
  std::map<std::string, std::string, std::less<>> texts;
  for (const auto& [key_path, position] : positions_) {
    if (!key_path.empty()) texts[key_path] = where(position);
  }
  return texts;
}

void Findings::add(Position position, std::string key_path, Issue issue) {
  // Some groups are read more than once, as one kind of what they may be and as another.
  const auto is_same = [&](const Problem& known) {
    return known.at == position && known.key_path == key_path && known.issue.what == issue.what &&
           known.issue.why == issue.why;
  };
  if (std::any_of(problems_.begin(), problems_.end(), is_same)) return;
  // A file with thousands of problems is not a design; there is no use in sorting and showing them all.
  if (problems_.size() >= 10 * kMostReported) {
    ++left_out_;
    return;
  }
  problems_.push_back({position, std::move(key_path), std::move(issue)});
}

void Findings::add_file(Position position, std::string key_path, Issue issue) {
  ++files_;
  add(position, std::move(key_path), std::move(issue));
}

void Findings::withdraw(std::string_view key_path) {
  std::erase_if(problems_, [&](const Problem& problem) { return problem.key_path == key_path; });
}

bool Findings::spoiled(std::string_view key_path) const {
  return std::any_of(problems_.begin(), problems_.end(), [&](const Problem& problem) {
    return is_within(key_path, problem.key_path) || is_within(problem.key_path, key_path);
  });
}

void Findings::add_unless_spoiled(Finding finding) {
  const auto is_spoiled = [&](const std::string& key_path) { return spoiled(key_path); };
  if (std::any_of(finding.key_paths.begin(), finding.key_paths.end(), is_spoiled)) return;
  const std::string& key_path = finding.key_paths.front();
  add(position(key_path), key_path, std::move(finding.issue));
}

std::vector<Issue> Findings::issues() const {
  std::vector<const Problem*> sorted;
  for (const Problem& problem : problems_) sorted.push_back(&problem);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem* left, const Problem* right) {
    const auto order = [](const Problem& problem) {
      return std::tuple(problem.at.override_index, problem.at.line, problem.at.column);
    };
    return order(*left) < order(*right);
  });
  std::vector<Issue> issues;
  for (const Problem* problem : sorted) {
    if (issues.size() == kMostReported) break;
    issues.push_back(problem->issue);
    issues.back().where = where(problem->at);
  }
  const std::size_t more = sorted.size() + left_out_ - issues.size();
  if (more > 0) issues.push_back({file_.string(), "and " + std::to_string(more) + " more problems", "", ""});
  return issues;
}

}  // namespace glissade::design_file
