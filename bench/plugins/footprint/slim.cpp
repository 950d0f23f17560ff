// A robot's own program as small as it gets: two modules, a parameter, a thread. Its arguments are extensions that
// it is given besides, such as `viewers inspect=0`.

#include <iostream>
#include <string>

#include <unistd.h>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/application/application.h"
#include "plugins/parameters/parameter.h"

namespace {

constexpr int kToldThere = 3;  // who measures waits for a byte

class Source final : public runnel::Module {
 public:
  using Module::Module;
  runnel::Output<double> value{this, "value"};

 private:
  void Update() override { value.Publish(++last_); }
  double last_ = 0;
};

class Sum final : public runnel::Module {
 public:
  using Module::Module;
  runnel::Input<double> value{this, "value"};
  runnel::Parameter<double> gain{this, "gain", {.default_value = 0.5}};

 private:
  void Update() override {
    const auto seen = value.Read();
    if (!seen.is_new()) return;
    sum_ += gain.Get() * *seen;
    if (is_first_ && write(kToldThere, "", 1) != 1) _exit(1);
    is_first_ = false;
  }
  double sum_ = 0;
  bool is_first_ = true;
};

int Fail(const std::string& text) {
  std::cerr << text;
  return 1;
}

}  // namespace

int main(int count, char** words) {
  runnel::ApplicationOptions options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      options.extensions_by_name.push_back({word});
    } else {
      options.extensions_by_name.back().arguments.values.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
  }
  const auto application = runnel::Application::Compose("slim", options);
  if (!application) return Fail(application.diagnostics().ToString());
  application->Create<Source>("source");
  application->Create<Sum>("sum");
  if (!application->AddThread("main", {.period = std::chrono::milliseconds(10)}) ||
      !application->Connect("/source/value", "/sum/value")) {
    return Fail("it cannot be composed\n");
  }
  const auto ran = application->Run();
  return ran ? 0 : Fail(ran.error().ToString() + "\n");
}
