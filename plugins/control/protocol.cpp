#include "plugins/control/protocol.h"

#include <algorithm>

#include "core/base/argument_text.h"
#include "core/base/number_text.h"

namespace runnel {

using internal::AsArgument;

namespace {

constexpr std::size_t kLongestHeader = FrameReader::kLongestKind + 1 + 20;

bool IsKind(std::string_view text) {
  return !text.empty() && text.size() <= FrameReader::kLongestKind &&
         std::ranges::all_of(text, [](char character) { return character >= 'a' && character <= 'z'; });
}

Error NoFrame(std::string what) {
  return {.message = std::move(what), .hint = "a frame is 'kind length', its bytes, end of line"};
}

bool IsName(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char character) {
    return (character >= 'a' && character <= 'z') || character == '_';
  });
}

}  // namespace

std::string FrameBytes(std::string_view kind, std::string_view payload) {
  std::string bytes;
  bytes.reserve(kind.size() + payload.size() + 24);
  bytes.append(kind).append(" ").append(std::to_string(payload.size())).append("\n");
  return bytes.append(payload).append("\n");
}

Result<std::optional<Frame>> FrameReader::Take() {
  const std::string_view rest = std::string_view(bytes_).substr(at_);
  const std::size_t end = rest.substr(0, kLongestHeader + 1).find('\n');
  if (end == std::string_view::npos) {
    if (rest.size() > kLongestHeader) return NoFrame("what came does not begin with a header");
    return std::optional<Frame>();
  }
  const std::string_view header = rest.substr(0, end);
  const std::size_t blank = std::min(header.find(' '), header.size());
  const auto length = NumberIn<std::size_t>(header.substr(std::min(blank + 1, header.size())));
  if (!IsKind(header.substr(0, blank)) || !length) return NoFrame("what came has no good header");
  if (*length > longest_) {
    return NoFrame("a frame of " + std::to_string(*length) + " bytes is too long; " + std::to_string(longest_) +
                   " are taken");
  }
  if (rest.size() < end + *length + 2) return std::optional<Frame>();
  if (rest[end + 1 + *length] != '\n') return NoFrame("a frame does not end where it said it would");
  Frame frame{std::string(header.substr(0, blank)), std::string(rest.substr(end + 1, *length))};
  at_ += end + *length + 2;
  if (at_ == bytes_.size() || at_ > longest_) {
    bytes_.erase(0, at_);
    at_ = 0;
  }
  return std::optional<Frame>(std::move(frame));
}

Result<Request> Request::Parse(std::string_view text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  Diagnostics diagnostics;
  const auto lines = internal::SplitArguments(text.substr(0, end), {}, diagnostics);
  if (!diagnostics.ok()) return diagnostics.errors().front();
  if (lines.size() != 1 || lines.front().front().equals) {
    return Error{.message = "a request is one line that begins with a command"};
  }
  Request request;
  for (const internal::TextArgument& word : lines.front()) {
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

std::string Hello::ToText() const {
  return Request{.command = "runnel",
                 .arguments = {},
                 .options = {{"protocol", std::to_string(protocol)},
                             {"process", std::to_string(process)},
                             {"application", application},
                             {"file", file},
                             {"nanoseconds", std::to_string(time.count())},
                             {"real", std::to_string(real.count())},
                             {"when", is_asking_when ? "yes" : "no"},
                             {"state", state}},
                 .body = {}}
      .ToText();
}

Result<Hello> Hello::Parse(std::string_view text) {
  const auto arguments = Request::Parse(text);
  if (!arguments || arguments->command != "runnel") {
    return Error{.message = "who answers there is no application of Runnel's"};
  }
  Hello hello;
  hello.protocol = NumberIn<int>(arguments->Option("protocol")).value_or(0);
  if (hello.protocol != kControlProtocol) {
    return Error{.message = "the application speaks protocol " + arguments->Option("protocol") + ", this program " +
                            std::to_string(kControlProtocol),
                 .hint = "use the program that started it"};
  }
  hello.process = NumberIn<pid_t>(arguments->Option("process")).value_or(0);
  hello.application = arguments->Option("application");
  hello.file = arguments->Option("file");
  hello.time = Duration(NumberIn<std::int64_t>(arguments->Option("nanoseconds")).value_or(0));
  hello.real = Duration(NumberIn<std::int64_t>(arguments->Option("real")).value_or(hello.time.count()));
  hello.is_asking_when = arguments->Option("when") == "yes";
  hello.state = arguments->Option("state");
  return hello;
}

}  // namespace runnel
