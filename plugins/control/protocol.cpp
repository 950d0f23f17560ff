#include "plugins/control/protocol.h"

#include <charconv>

#include "plugins/control/request.h"

namespace runnel {

namespace {

template <typename Number>
Number ReadNumber(const std::string& text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

std::string Hello::ToText() const {
  return Request{.command = "runnel",
                 .arguments = {},
                 .options = {{"protocol", std::to_string(protocol)},
                             {"process", std::to_string(process)},
                             {"application", application},
                             {"file", file},
                             {"nanoseconds", std::to_string(time.count())}},
                 .body = {}}
      .ToText();
}

Result<Hello> Hello::Parse(std::string_view text) {
  const auto arguments = Request::Parse(text);
  if (!arguments || arguments->command != "runnel") {
    return Error{.message = "who answers there is no application of Runnel's"};
  }
  Hello hello;
  hello.protocol = ReadNumber<int>(arguments->Option("protocol"));
  if (hello.protocol != kControlProtocol) {
    return Error{.message = "the application speaks protocol " + arguments->Option("protocol") +
                            ", this program " + std::to_string(kControlProtocol),
                 .hint = "use the program that started it"};
  }
  hello.process = ReadNumber<pid_t>(arguments->Option("process"));
  hello.application = arguments->Option("application");
  hello.file = arguments->Option("file");
  hello.time = Duration(ReadNumber<std::int64_t>(arguments->Option("nanoseconds")));
  return hello;
}

}  // namespace runnel
