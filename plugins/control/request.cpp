#include "plugins/control/request.h"

#include <algorithm>

#include "plugins/structure/change_arguments.h"

namespace runnel {

using internal::AsArgument;

namespace {

bool IsName(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char character) {
    return (character >= 'a' && character <= 'z') || character == '_';
  });
}

}  // namespace

Result<Request> Request::Parse(std::string_view text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  Diagnostics diagnostics;
  const auto lines = internal::SplitChanges(text.substr(0, end), {}, diagnostics);
  if (!diagnostics.ok()) return diagnostics.errors().front();
  if (lines.size() != 1 || lines.front().front().equals) {
    return Error{.message = "a request is one line that begins with a command"};
  }
  Request request;
  for (const internal::ChangeArgument& word : lines.front()) {
    if (!IsName(request.command.empty() || word.equals ? word.name() : request.command)) {
      return Error{.message = "'" + word.name() + "' is no name of a command or option"};
    }
    if (request.command.empty()) {
      request.command = word.text;
    } else if (!word.equals) {
      request.arguments.push_back(word.text);
    } else if (!request.options.emplace(word.name(), word.value()).second) {
      return Error{.message = "the option '" + word.name() + "' is there twice"};
    }
  }
  request.body = text.substr(std::min(end + 1, text.size()));
  return request;
}

std::string Request::ToText() const {
  std::string text = command;
  for (const std::string& word : arguments) text += " " + AsArgument(word);
  for (const auto& [name, value] : options) text += " " + name + "=" + AsArgument(value);
  return body.empty() ? text : text + "\n" + body;
}

std::string Request::Option(const std::string& option) const {
  const auto found = options.find(option);
  return found == options.end() ? "" : found->second;
}

}  // namespace runnel
