// Services and clients whose types are known at run time only, among themselves and with those that are compiled.

#include "core/types/text_format.h"
#include "plugins/services/services_at_run_time.h"
#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

const SignatureTypes kRepeat{&TypeOf<std::string>(), {&TypeOf<std::string>(), &TypeOf<int>()}};
// No module in C++ has such services.
const SignatureTypes kSum{&TypeOf<double>(), {&TypeOf<double>(), &TypeOf<float>()}};

std::string ArgumentsText(const CallForm& form, const CallBase& call) {
  return ToText(*form.arguments(), form.ArgumentsOf(call));
}

class LateServer final : public Module {
 public:
  using Module::Module;
  ServiceAtRunTime repeat{OutputGroup(),
                          "repeat",
                          kRepeat,
                          {.arguments = {"text", "times"}},
                          {},
                          [this](const CallForm& form, CallBase& call, Activity*) -> Result<void> {
                            served.push_back(ArgumentsText(form, call));
                            *static_cast<std::string*>(form.ReplyOf(call)) = "late";
                            return {};
                          }};
  ServiceAtRunTime sum{OutputGroup(),
                       "sum",
                       kSum,
                       {.description = "adds", .arguments = {"a", "b"}},
                       {.defaults = "{a: 1, b: 2}", .are_arguments_optional = true},
                       [this](const CallForm& form, CallBase& call, Activity*) -> Result<void> {
                         served.push_back(ArgumentsText(form, call));
                         if (fails) return Error{.message = "is too much"};
                         *static_cast<double*>(form.ReplyOf(call)) = 7;
                         return {};
                       }};
  std::vector<std::string> served;
  bool fails = false;

 private:
  void Update() override {}
};

class LateAsker final : public Module {
 public:
  using Module::Module;
  ClientAtRunTime repeat{
      InputGroup(), "repeat", kRepeat, {.arguments = {"text", "times"}}, [this](CallBase& call, CallStatus status) {
        Note(repeat, call, status);
      }};
  ClientAtRunTime sum{
      InputGroup(), "sum", kSum, {.calls = 2}, [this](CallBase& call, CallStatus status) { Note(sum, call, status); }};

  CallStatus Ask(ClientAtRunTime& client, const std::string& arguments) {
    CallBase* const call = client.Acquire();
    if (call == nullptr) return CallStatus::kBusy;
    const CallForm& form = *client.form();
    EXPECT_TRUE(SetFromText(*form.arguments(), arguments, const_cast<void*>(form.ArgumentsOf(*call))));
    const CallStatus status = client.Begin(*call);
    status == CallStatus::kPending ? client.AwaitInCycle(*call) : CallSlots::Release(*call);
    return status;
  }
  std::vector<std::string> told;

 private:
  void Note(ClientAtRunTime& client, CallBase& call, CallStatus status) {
    told.push_back(status == CallStatus::kAnswered ? ToText(*client.form()->reply(), client.form()->ReplyOf(call))
                                                   : CallStatusName(status) + (": " + call.error));
  }
  void Update() override {}
};

class RunTimeTypesTest : public ServiceTest {
 protected:
  RunTimeTypesTest() {
    Register<LateServer>("test/late_server");
    Register<LateAsker>("test/late_asker");
    Must({CreateModule{"/app/late_server", "test/late_server"}, CreateModule{"/app/late_asker", "test/late_asker"}});
  }
  LateServer& late_server() { return At<LateServer>("/app/late_server"); }
  LateAsker& late_asker() { return At<LateAsker>("/app/late_asker"); }
};

TEST_F(RunTimeTypesTest, AModuleInCppCallsSuchAService) {
  Must({DisconnectPorts{"/app/server/repeat", "/app/asker/repeat"}});
  Must({ConnectPorts{"/app/late_server/repeat", "/app/asker/repeat"}});
  auto future = asker().repeat.Begin("ab", 3);
  Steps(1);
  ASSERT_TRUE(future.is_done());
  EXPECT_EQ(*future.outcome(), "late");
  EXPECT_THAT(late_server().served, ElementsAre("{text: \"ab\", times: 3}"));
}

TEST_F(RunTimeTypesTest, SuchAClientCallsAModuleInCpp) {
  Must({ConnectPorts{"/app/server/repeat", "/app/late_asker/repeat"}});
  EXPECT_EQ(late_asker().Ask(late_asker().repeat, "{text: ab, times: 2}"), CallStatus::kPending);
  Steps(1);
  EXPECT_THAT(late_asker().told, ElementsAre("abab"));
}

TEST_F(RunTimeTypesTest, TypesThatNoModuleInCppHasAreConnectedAndRefusedByTheirNames) {
  EXPECT_EQ(late_asker().Ask(late_asker().sum, "{argument1: 1, argument2: 1}"), CallStatus::kNotConnected);
  EXPECT_THAT(Refusal({ConnectPorts{"/app/late_server/sum", "/app/late_asker/repeat"}}),
              HasSubstr("service double(double, float)"));
  Must({ConnectPorts{"/app/late_server/sum", "/app/late_asker/sum"}});
  EXPECT_EQ(At<Port>("/app/late_server/output/sum").type().name(), "service double(double, float)");
  for (const char* each : {"{argument1: 1, argument2: 2}", "{argument1: 3, argument2: 4}"}) {
    EXPECT_EQ(late_asker().Ask(late_asker().sum, each), CallStatus::kPending);
  }
  EXPECT_EQ(late_asker().Ask(late_asker().sum, "{argument1: 5, argument2: 6}"), CallStatus::kBusy);
  Steps(1);
  EXPECT_THAT(late_asker().told, ElementsAre("7", "7"));
  EXPECT_THAT(late_server().served, ElementsAre("{a: 1, b: 2}", "{a: 3, b: 4}"));
  late_server().fails = true;
  late_asker().Ask(late_asker().sum, "{argument1: 1, argument2: 2}");
  Steps(1);
  EXPECT_THAT(late_asker().told.back(), "failed: is too much");
}

TEST_F(RunTimeTypesTest, CallsThatWaitAreServedByTheModuleThatComes) {
  Must({ConnectPorts{"/app/late_server/sum", "/app/late_asker/sum"}});
  late_asker().Ask(late_asker().sum, "{argument1: 1, argument2: 2}");
  Must({ReplaceModule{"/app/late_server", "test/late_server"}});
  Steps(1);
  EXPECT_THAT(late_asker().told, ElementsAre("7"));
  late_asker().Ask(late_asker().sum, "{argument1: 1, argument2: 2}");
  Must({DeleteElement{"/app/late_server"}});
  Steps(1);
  EXPECT_THAT(late_asker().told.back(), HasSubstr("disconnected"));
}

TEST_F(RunTimeTypesTest, ACallFromOutsideHasDefaults) {
  Callable& sum = *At<Port>("/app/late_server/output/sum").FindAnnotation<Callable>();
  EXPECT_TRUE(sum.are_arguments_optional());
  EXPECT_EQ(sum.description(), "adds");
  const auto call = sum.NewCall();
  ASSERT_EQ(call->Begin(runtime.clock().Now(), 1s), CallStatus::kPending);
  Steps(1);
  EXPECT_EQ(call->Poll(runtime.clock().Now()), CallStatus::kAnswered);
  EXPECT_EQ(ToText(*sum.reply(), call->reply()), "7");
  EXPECT_THAT(late_server().served, ElementsAre("{a: 1, b: 2}"));
}

}  // namespace
}  // namespace runnel::test
