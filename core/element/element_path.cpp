#include "core/element/element_path.h"

#include <algorithm>
#include <cctype>

namespace runnel {

Result<void> CheckElementName(std::string_view name) {
  const auto is_control = [](char letter) { return static_cast<unsigned char>(letter) < 0x20; };
  const std::string quoted = "'" + std::string(name) + "'";
  if (name.empty()) return Error{.message = "a name must not be empty"};
  if (name == "." || name == "..") return Error{.message = "the name " + quoted + " is reserved"};
  if (name.find('/') != std::string_view::npos) {
    return Error{.message =
                     "the name " + quoted + " contains a '/', which separates names in paths"};
  }
  if (name.front() == ' ' || name.back() == ' ' || std::ranges::any_of(name, is_control)) {
    return Error{.message = "the name " + quoted +
                            " begins or ends with a blank or contains a control character"};
  }
  return {};
}

std::vector<std::string_view> SplitPath(std::string_view path) {
  std::vector<std::string_view> names;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    if (end > 0) names.push_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return names;
}

}  // namespace runnel
