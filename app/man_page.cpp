#include "app/man_page.hpp"

#include "glissade/core/version.hpp"

#include "app/help.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace glissade::app {
namespace {

/// Text that troff sets as it stands: its hyphens are minus signs that can be copied to a shell.
std::string as_it_stands(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\\') {
      result += "\\(rs";
    } else if (letter == '-') {
      result += "\\-";
    } else if (letter == '\'') {
      result += "\\(aq";
    } else {
      result += letter;
    }
  }
  return result.starts_with('.') ? "\\&" + result : result;
}

std::string in_capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return text;
}

std::string heading(const std::string& text) {
  return ".SH " + in_capitals(text) + "\n";
}

std::string tagged(const HelpPage::Entries& entries) {
  std::string text;
  for (const auto& [name, description] : entries) {
    text += ".TP\n.B " + as_it_stands(name) + "\n" + as_it_stands(description) + "\n";
  }
  return text;
}

/// Paragraphs of running text; lines that are indented keep their places.
std::string paragraphs(const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  bool begun = false;
  bool in_place = false;
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.starts_with("  ");
    if (in_place && !indented) result += ".EE\n";
    if (!in_place && indented) result += ".PP\n.EX\n";
    if (!indented && !line.empty() && (!begun || in_place)) result += ".PP\n";
    in_place = indented;
    begun = !line.empty();
    if (!line.empty()) result += as_it_stands(line) + "\n";
  }
  return result + (in_place ? ".EE\n" : "");
}

bool is_heading(const std::string& line) {
  return line.ends_with(':') && line.find(' ') == std::string::npos;
}

/// What follows the options: a line that is one word and a colon heads what comes below it.
std::string footer(const std::string& text) {
  std::string result;
  std::string part;
  std::string title = "Notes";
  const auto finish = [&] {
    if (part.find_first_not_of('\n') != std::string::npos) result += heading(title) + paragraphs(part);
    part.clear();
  };
  std::istringstream lines(text);
  bool below_blank = true;
  for (std::string line; std::getline(lines, line);) {
    const bool opens = below_blank && !line.empty();
    if (opens && is_heading(line)) {
      finish();
      title = line.substr(0, line.size() - 1);
    } else {
      if (opens && !line.starts_with("  ") && title != "Notes") {
        finish();
        title = "Notes";
      }
      part += line + "\n";
    }
    below_blank = line.empty();
  }
  finish();
  return result;
}

/// What a page is called by, without a stop.
std::string title_of(const std::string& text) {
  std::string sentence = first_sentence(std::string_view(text).substr(0, text.find(":\n")));
  while (sentence.ends_with('.') || sentence.ends_with(':')) sentence.pop_back();
  return sentence;
}

}  // namespace

std::string man_name(const HelpPage& page) {
  std::string name = page.name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string man_page(const HelpPage& page, const std::vector<std::string>& also) {
  const std::string name = man_name(page);
  std::string text = ".TH " + in_capitals(as_it_stands(name)) + " 1 \"\" \"Glissade " +
                     std::string(version()) + "\" \"Glissade\"\n.nh\n.ad l\n";
  text += heading("Name") + as_it_stands(name) + " \\- " + as_it_stands(title_of(page.description)) + "\n";
  text += heading("Synopsis") + ".B " + as_it_stands(page.usage) + "\n";
  text += heading("Description") + paragraphs(page.description);
  if (!page.commands.empty()) text += heading("Commands") + tagged(page.commands);
  if (!page.arguments.empty()) text += heading("Arguments") + tagged(page.arguments);
  for (const auto& [group, entries] : page.options) text += heading(group) + tagged(entries);
  text += footer(page.footer);
  std::string others;
  for (const std::string& other : also) {
    others += (others.empty() ? ".BR " : " ,\n.BR ") + as_it_stands(other) + " (1)";
  }
  if (!others.empty()) text += heading("See also") + others + "\n";
  return text;
}

}  // namespace glissade::app
