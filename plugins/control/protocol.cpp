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
                 .words = {},
                 .options = {{"protocol", std::to_string(protocol)},
                             {"process", std::to_string(process)},
                             {"application", application},
                             {"file", file},
                             {"nanoseconds", std::to_string(time.count())}},
                 .body = {}}
      .ToText();
}

Result<Hello> Hello::Parse(std::string_view text) {
  const auto words = Request::Parse(text);
  if (!words || words->command != "runnel") {
    return Error{.message = "who answers there is no application of Runnel's"};
  }
  Hello hello;
  hello.protocol = ReadNumber<int>(words->Option("protocol"));
  if (hello.protocol != kControlProtocol) {
    return Error{.message = "the application speaks protocol " + words->Option("protocol") +
                            ", this program " + std::to_string(kControlProtocol),
                 .hint = "use the program that started it"};
  }
  hello.process = ReadNumber<pid_t>(words->Option("process"));
  hello.application = words->Option("application");
  hello.file = words->Option("file");
  hello.time = Duration(ReadNumber<std::int64_t>(words->Option("nanoseconds")));
  return hello;
}

}  // namespace runnel
