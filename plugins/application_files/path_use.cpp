#include "plugins/application_files/path_use.h"

#include <algorithm>
#include <string_view>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "plugins/application_files/xml_tag.h"

namespace runnel {

namespace {

void Report(Error error, const PathUse& use, BuildContext& context) {
  error.path = use.base.path();
  context.Report(std::move(error), use.position, use.base);
}

}  // namespace

FrameworkElement* SearchElement(const PathUse& use, BuildContext& context, PathKind kind) {
  PathEnd end = PathSearch(use.base).Follow(use.path, kind);
  if (end.found != nullptr) return end.found;
  if (kind == PathKind::kInput) {  // it remains without what was meant for it
    const auto* const meant = end.at->FindChild(NearestName(end.missing, end.candidates));
    context.MarkUnfed(meant != nullptr ? *meant : *end.at);
  }
  const bool is_news = end.missing.empty() || context.IsNews(*end.at, end.missing, end.candidates);
  if (is_news) Report(std::move(end.error), use, context);
  return nullptr;
}

PathUse PathIn(const XmlAttribute& attribute, FrameworkElement& base) {
  return {base, attribute.value, attribute.value_position};
}

std::vector<PathUse> PathsIn(const XmlAttribute& attribute, FrameworkElement& base) {
  const std::string_view value = attribute.value;
  std::vector<PathUse> paths;
  std::size_t from = 0;
  for (std::string& word : SplitPaths(value)) {
    const std::size_t begin = value.find(word, from);
    from = begin + word.size();
    const std::string_view before = value.substr(0, begin);
    SourcePosition position = attribute.value_position;
    // An attribute may go over several lines.
    position.line += static_cast<int>(std::ranges::count(before, '\n'));
    const std::size_t line_end = before.rfind('\n');
    if (line_end == std::string_view::npos) {
      position.column += static_cast<int>(CharacterCount(before));
    } else {
      position.column = 1 + static_cast<int>(CharacterCount(before.substr(line_end + 1)));
    }
    paths.push_back({base, std::move(word), std::move(position)});
  }
  return paths;
}

Port* SearchPort(const PathUse& use, PathKind kind, BuildContext& context) {
  FrameworkElement* const found = SearchElement(use, context, kind);
  if (found == nullptr) return nullptr;
  const auto port = PathSearch(*found).FindPort("", kind);
  if (port) return *port;
  if (kind == PathKind::kInput) context.MarkUnfed(*found);
  Report(port.error(), use, context);
  return nullptr;
}

FrameworkElement* SearchSettable(const XmlAttribute& path, const XmlAttribute& value, FrameworkElement& base,
                                 BuildContext& context) {
  const PathUse use = PathIn(path, base);
  FrameworkElement* const found = SearchElement(use, context, PathKind::kParameter);
  if (found == nullptr) return nullptr;
  const auto* const parameter = dynamic_cast<const Configurable*>(found);
  if (parameter == nullptr) {
    Report({.message = found->path() + " cannot be set"}, use, context);
    return nullptr;
  }
  const auto good = parameter->CheckText(value.value);
  if (good && !parameter->info().is_static) return found;
  Error error = !parameter->info().is_static
                    ? good.error()
                    : Error{.message = "the parameter is static: it cannot be set while its module runs"};
  error.path = found->path();
  context.Report(std::move(error), parameter->info().is_static ? path.value_position : value.value_position, base);
  return nullptr;
}

Port* FindPort(const PathUse& use, PathKind kind) {
  const auto found = PathSearch(use.base).FindPort(use.path, kind);
  return found ? *found : nullptr;
}

bool IsRightWay(const Port& port, PathKind end, const Port& other) {
  if (!port.is_proxy() || &port == &other) return true;
  const FrameworkElement& group = *port.parent();
  const bool is_input = port.direction() == Port::Direction::kInput;
  // Of one group's input to its output inside, or back outside: either makes sense. Of two outputs
  // one is wrong, whichever; that is told at the first end.
  if (other.parent() == &group) {
    return end == PathKind::kInput || other.direction() != port.direction();
  }
  const bool is_inside = other.IsAtOrBelow(group);
  const bool receives = end == PathKind::kInput;
  return is_input == (is_inside != receives);
}

void CheckInterfaceDirection(const Port& port, const PathUse& use, PathKind end, const Port& other,
                             BuildContext& context) {
  if (IsRightWay(port, end, other)) return;
  if (!context.IsFirstFaultOf(port)) return;
  const bool is_input = port.direction() == Port::Direction::kInput;
  const std::string ways = is_input ? "an input of its group: it sends inside of the group and receives outside"
                                    : "an output of its group: it receives inside of the group and sends outside";
  context.Report({.message = "is " + ways,
                  .path = port.path(),
                  .hint = std::string("write direction=\"") + (is_input ? "output" : "input") +
                          "\" at its <port>, or swap 'from' and 'to'"},
                 use.position, use.base);
}

}  // namespace runnel
