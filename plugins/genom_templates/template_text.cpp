#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "core/base/characters.h"
#include "core/base/files.h"
#include "core/base/nearest_name.h"
#include "plugins/genom_templates/template_run.h"

namespace runnel::genom {

namespace {

// Text of the template, or what stands between markers.
struct Piece {
  enum class Kind { kText, kScript, kValue };
  Kind kind;
  std::string text;
  bool begins_line = false;  // since nothing is before it, or a newline was that has been taken away
};

bool IsBlank(const std::string& text, std::size_t from, std::size_t to) {
  return std::all_of(text.begin() + static_cast<std::ptrdiff_t>(from), text.begin() + static_cast<std::ptrdiff_t>(to),
                     [](char c) { return c == ' ' || c == '\t'; });
}

Error ErrorAt(const std::string& text, std::size_t at, std::string message, std::string hint) {
  const auto begin = text.begin();
  const auto here = begin + static_cast<std::ptrdiff_t>(at);
  const int line = static_cast<int>(std::count(begin, here, '\n')) + 1;
  const std::size_t line_start = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const int column = static_cast<int>(at - (line_start == std::string::npos ? 0 : line_start + 1)) + 1;
  return {.message = std::move(message), .position = {"", line, column}, .hint = std::move(hint)};
}

Result<std::vector<Piece>> Cut(const std::string& text) {
  std::vector<Piece> pieces;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t open = text.find("<%", at);
    const std::size_t stray = text.find("%>", at);
    if (stray < open) return ErrorAt(text, stray, "'%>' closes nothing", "open it by <% or <%=");
    pieces.push_back({Piece::Kind::kText, text.substr(at, open == std::string::npos ? open : open - at), false});
    if (open == std::string::npos) break;
    const std::size_t close = text.find("%>", open + 2);
    if (close == std::string::npos) return ErrorAt(text, open, "'<%' has no end", "close it by %>");
    const bool is_value = text.compare(open, 3, "<%=") == 0;
    const std::size_t begin = open + (is_value ? 3 : 2);
    pieces.push_back({is_value ? Piece::Kind::kValue : Piece::Kind::kScript,
                      begin <= close ? text.substr(begin, close - begin) : "", false});
    at = close + 2;
  }
  return pieces;
}

// Takes the blanks and the newline away around scripts that are alone in their line. What is taken stays as newlines of
// the program, behind the script.
void JoinLonelyScripts(std::vector<Piece>& pieces) {
  if (!pieces.empty()) pieces.front().begins_line = true;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].kind != Piece::Kind::kScript) continue;
    // Scripts of one line, with blanks between.
    std::size_t last = i;
    while (last + 2 < pieces.size() && pieces[last + 1].kind == Piece::Kind::kText &&
           pieces[last + 2].kind == Piece::Kind::kScript &&
           IsBlank(pieces[last + 1].text, 0, pieces[last + 1].text.size())) {
      last += 2;
    }
    std::string* before = i == 0 ? nullptr : &pieces[i - 1].text;
    const std::size_t line_start = before == nullptr ? 0 : before->find_last_of('\n') + 1;  // npos + 1 is 0
    const bool begins_line = before == nullptr || (pieces[i - 1].kind == Piece::Kind::kText &&
                                                   (pieces[i - 1].begins_line || line_start > 0) &&
                                                   IsBlank(*before, line_start, before->size()));
    std::string* after = last + 1 < pieces.size() ? &pieces[last + 1].text : nullptr;
    const bool is_text = after != nullptr && pieces[last + 1].kind == Piece::Kind::kText;
    const std::size_t line_end = is_text ? after->find('\n') : std::string::npos;
    const bool ends_line =
        after == nullptr || (is_text && line_end != std::string::npos && IsBlank(*after, 0, line_end)) ||
        (is_text && last + 2 == pieces.size() && line_end == std::string::npos && IsBlank(*after, 0, after->size()));
    if (begins_line && ends_line) {
      if (before != nullptr) before->erase(line_start);
      if (after != nullptr) {
        after->erase(0, line_end == std::string::npos ? after->size() : line_end + 1);
        if (line_end != std::string::npos) pieces[last].text += '\n';
        pieces[last + 1].begins_line = true;
      }
      for (std::size_t j = i + 1; j < last; j += 2) pieces[j].text.clear();
    }
    i = last;
  }
}

// A line of the template is a line of the program.
void AppendText(std::string& program, const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t newline = text.find('\n', at);
    const std::size_t end = newline == std::string::npos ? text.size() : newline + 1;
    program += " write_text(" + Quoted(text.substr(at, end - at)) + ")";
    if (newline != std::string::npos) program += '\n';
    at = end;
  }
}

namespace fs = std::filesystem;

std::vector<fs::path> Folders() {
  std::vector<fs::path> folders;
  if (const char* own = std::getenv("RUNNEL_GENOM_TEMPLATES")) {
    std::istringstream parts(own);
    for (std::string part; std::getline(parts, part, ':');) {
      if (!part.empty()) folders.emplace_back(part);
    }
  }
  folders.push_back(TemplatesOfRunnel());
  return folders;
}

bool IsTemplate(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "template.lua", error);
}

}  // namespace

Result<std::string> ProgramOf(const std::string& text) {
  auto pieces = Cut(text);
  if (!pieces) return pieces.error();
  JoinLonelyScripts(*pieces);
  std::string program;
  for (const Piece& each : *pieces) {
    switch (each.kind) {
      case Piece::Kind::kText:
        AppendText(program, each.text);
        break;
      case Piece::Kind::kScript:
        program += " " + each.text + " ";
        break;
      case Piece::Kind::kValue:
        program += " write_value(" + each.text + ")";
        break;
    }
  }
  return program;
}

fs::path TemplatesOfRunnel() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "share/runnel/genom_templates";
}

std::vector<std::string> TemplateNames() {
  std::vector<std::string> names;
  for (const fs::path& folder : Folders()) {
    for (const std::string& name : NamesInFolder(folder)) {
      if (IsTemplate(folder / name)) names.push_back(name);
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Result<fs::path> FindTemplate(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (IsTemplate(name)) return fs::path(name);
    return Error{.message = "there is no template in '" + name + "'",
                 .hint = "a template is a folder with a file template.lua"};
  }
  for (const fs::path& folder : Folders()) {
    if (IsTemplate(folder / name)) return folder / name;
  }
  return Error{.message = "there is no template '" + name + "'", .hint = NearestNameHint(name, TemplateNames())};
}

}  // namespace runnel::genom
