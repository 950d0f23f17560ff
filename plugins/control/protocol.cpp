#include "plugins/control/protocol.h"

#include "core/base/number_text.h"
#include "plugins/control/request.h"

namespace runnel {

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
  hello.protocol = NumberIn<int>(arguments->Option("protocol")).value_or(0);
  if (hello.protocol != kControlProtocol) {
    return Error{.message = "the application speaks protocol " + arguments->Option("protocol") +
                            ", this program " + std::to_string(kControlProtocol),
                 .hint = "use the program that started it"};
  }
  hello.process = NumberIn<pid_t>(arguments->Option("process")).value_or(0);
  hello.application = arguments->Option("application");
  hello.file = arguments->Option("file");
  hello.time = Duration(NumberIn<std::int64_t>(arguments->Option("nanoseconds")).value_or(0));
  return hello;
}

}  // namespace runnel
