#include "plugins/values/port_patterns.h"

#include <algorithm>
#include <span>

#include "core/element/element_path.h"

namespace runnel {

namespace {

using Parts = std::vector<std::string>;

bool IsPortGroup(const std::string& name) {
  constexpr const char* kGroups[] = {"input",         "output",           "sensor_input",
                                     "sensor_output", "controller_input", "controller_output"};
  return std::ranges::count(kGroups, name) > 0;
}

// Pieces, of whose pattern each `any` stands for any number of them; others fit by `fits`.
template <typename Piece, typename Any, typename Fits>
bool FitPieces(std::span<const Piece> pattern, std::span<const Piece> pieces, const Any& any, const Fits& fits) {
  if (pattern.empty()) return pieces.empty();
  if (pattern.front() != any) {
    return !pieces.empty() && fits(pattern.front(), pieces.front()) &&
           FitPieces(pattern.subspan(1), pieces.subspan(1), any, fits);
  }
  for (std::size_t skip = 0; skip <= pieces.size(); ++skip) {
    if (FitPieces(pattern.subspan(1), pieces.subspan(skip), any, fits)) return true;
  }
  return false;
}

// A path of parts, which are characters.
bool FitsParts(std::span<const std::string> pattern, std::span<const std::string> path) {
  return FitPieces(pattern, path, "**", [](const std::string& a, const std::string& b) {
    return FitPieces(std::span(a), std::span(b), '*', std::equal_to<char>());
  });
}

// The path as it stands, and without its port group.
std::vector<Parts> Forms(std::string_view path) {
  std::vector<Parts> forms{PartsOf(path)};
  Parts& whole = forms.front();
  if (whole.size() >= 2 && IsPortGroup(whole[whole.size() - 2])) {
    Parts without = whole;
    without.erase(without.end() - 2);
    forms.push_back(std::move(without));
  }
  return forms;
}

// Names have no commas, so that these stand between patterns.
void AppendParts(const std::string& list, std::vector<std::string>& patterns) {
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    patterns.push_back(list.substr(at, end - at));
    at = end + 1;
  }
}

std::string Join(std::span<const std::string> parts) {
  std::string text;
  for (const std::string& part : parts) text += "/" + part;
  return text;
}

}  // namespace

Result<PortPatterns> PortPatterns::Make(const std::vector<std::string>& patterns) {
  PortPatterns made;
  for (const std::string& list : patterns) AppendParts(list, made.texts_);
  for (const std::string& text : made.texts_) {
    const bool is_excluded = text.starts_with('!');
    const std::string_view path = std::string_view(text).substr(is_excluded ? 1 : 0);
    Parts parts = PartsOf(path);
    if (parts.empty()) {
      return Error{.message = "'" + text + "' is no pattern of ports",
                   .hint = "for example /robot/pose, */pose, /robot/**, or !**/scan"};
    }
    if (!path.starts_with('/')) parts.insert(parts.begin(), "**");
    (is_excluded ? made.excluded_ : made.wanted_).push_back(std::move(parts));
  }
  return made;
}

bool PortPatterns::FitOne(const Parts& pattern, std::string_view path) {
  return std::ranges::any_of(Forms(path), [&](const Parts& form) {
    const std::span<const std::string> whole = form;
    return FitsParts(pattern, whole) || (!whole.empty() && FitsParts(pattern, whole.subspan(1)));
  });
}

bool PortPatterns::Fit(std::string_view path) const {
  const auto fits = [&](const Parts& pattern) { return FitOne(pattern, path); };
  return (wanted_.empty() || std::ranges::any_of(wanted_, fits)) && std::ranges::none_of(excluded_, fits);
}

std::vector<std::string> PortPatterns::Names() const {
  std::vector<std::string> names;
  for (const std::string& text : texts_) {
    if (!text.starts_with('!') && text.find('*') == std::string::npos) names.push_back(text);
  }
  return names;
}

bool PortPatterns::Name(std::string_view path) const {
  return Fit(path) &&
         std::ranges::any_of(Names(), [&](const std::string& name) { return FitOne(PartsOf(name), path); });
}

std::vector<std::string> PartsOf(std::string_view path) {
  const auto names = SplitPath(path);
  return {names.begin(), names.end()};
}

std::string PlainPortPath(std::string_view path) { return Join(Forms(path).back()); }

std::string ShortPortPath(std::string_view path) {
  const Parts parts = Forms(path).back();
  return Join(std::span(parts).subspan(parts.size() > 1 ? 1 : 0));
}

}  // namespace runnel
