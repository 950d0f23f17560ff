// Services as the protocol has them.

#include "plugins/services/any_call.h"
#include "plugins/services/service.h"
#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

class Clerk final : public Module {
 public:
  using Module::Module;
  Service<Pose2(std::string)> where{this, "where", &Clerk::Where, {.arguments = {"name"}}};
  Service<double(double)> half{this, "half", [](Clerk&, double value) { return value / 2; }};
  Service<void()> reset{this, "reset", [](Clerk&) {}};

 private:
  Result<Pose2> Where(const std::string& name) {
    if (name != "dock") return Error{.message = "there is no such place"};
    return Pose2{1, 2, 3};
  }
  void Update() override {}
};

std::string Word(std::uint32_t number) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
  return bytes;
}

class FoxgloveServices : public FoxgloveTest {
 protected:
  FoxgloveServices() {
    clerk = &runtime.Create<Clerk>(application, "clerk");
    EXPECT_TRUE(runtime.MakeReady(*clerk));
  }
  void Find() {
    Turn();
    for (const Json& message : Take("advertiseServices")) {
      for (const Json& each : message["services"]) services[each["name"]] = each;
    }
  }
  void CallIt(const std::string& name, std::uint32_t call, const std::string& json,
              const std::string& encoding = "json") {
    session->OnBinary("\x02" + Word(services.at(name)["id"]) + Word(call) +
                      Word(static_cast<std::uint32_t>(encoding.size())) + encoding + json);
    session->OnPoll();
  }
  /// What has been answered to the call; "" if nothing has.
  std::string Reply(std::uint32_t call) {
    for (const std::string& bytes : client.binaries) {
      if (bytes[0] == 3 && bytes.substr(5, 4) == Word(call)) return bytes.substr(17);
    }
    return "";
  }
  std::string Failure() {
    const auto failures = Take("serviceCallFailure");
    return failures.empty() ? "" : failures.back()["message"].get<std::string>();
  }

  Clerk* clerk;
  std::map<std::string, Json> services;
};

TEST_F(FoxgloveServices, AreAdvertisedWithTheirSchemas) {
  Begin();
  Find();
  ASSERT_EQ(services.size(), 5u) << "with those of the STOP";
  const Json& where = services.at("/clerk/where");
  EXPECT_EQ(where["type"], "service Pose2(string)");
  EXPECT_EQ(where["request"]["encoding"], "json");
  EXPECT_EQ(Json::parse(where["request"]["schema"].get<std::string>())["properties"]["name"]["type"], "string");
  EXPECT_TRUE(Json::parse(where["responseSchema"].get<std::string>())["properties"].contains("heading"));
  EXPECT_TRUE(
      Json::parse(services.at("/clerk/half")["requestSchema"].get<std::string>())["properties"].contains("value"));
}

TEST_F(FoxgloveServices, AreCalledAndAnswer) {
  Begin();
  Find();
  CallIt("/clerk/where", 7, R"({"name":"dock"})");
  EXPECT_EQ(Reply(7), "") << "nobody has served it";
  clerk->where.Serve();
  session->OnPoll();
  EXPECT_EQ(Json::parse(Reply(7)), Json::parse(R"({"x":1,"y":2,"heading":3})"));
  CallIt("/clerk/half", 8, R"({"value":5})");
  CallIt("/clerk/reset", 9, "{}");
  clerk->half.Serve();
  clerk->reset.Serve();
  session->OnPoll();
  EXPECT_EQ(Json::parse(Reply(8))["value"], 2.5);
  EXPECT_EQ(Reply(9), "{}");
}

TEST_F(FoxgloveServices, SayWhatIsWrong) {
  Begin();
  Find();
  CallIt("/clerk/where", 1, R"({"name":"sea"})");
  clerk->where.Serve();
  session->OnPoll();
  EXPECT_THAT(Failure(), HasSubstr("there is no such place"));
  CallIt("/clerk/where", 2, R"({"nam":"dock"})");
  EXPECT_THAT(Failure(), HasSubstr("did you mean 'name'?"));
  CallIt("/clerk/where", 3, "", "cdr");
  EXPECT_THAT(Failure(), HasSubstr("'json' here, not as 'cdr'"));
  session->OnBinary("\x02 short");
  EXPECT_THAT(Complaint(), HasSubstr("shorter than it says"));
}

// As components described for GenoM3 have it: nothing is right if it is not said.
TEST_F(FoxgloveServices, WantWhatHasNoDefault) {
  const ServiceSignature& signature = internal::MakeServiceSignatureKnown<Pose2(std::string), true>();
  clerk->where.port().Annotate<Callable>(std::make_unique<CallableService>(
      clerk->where, signature, signature.MakeForm({"name"}), "", CallableOptions{.required = {"name"}}));
  Begin();
  Find();
  CallIt("/clerk/where", 1, "{}");
  EXPECT_THAT(Failure(), HasSubstr("argument 'name' is not given"));
  CallIt("/clerk/where", 2, R"({"name":"dock"})");
  clerk->where.Serve();
  session->OnPoll();
  EXPECT_NE(Reply(2), "");
}

TEST_F(FoxgloveServices, GoWithTheirModule) {
  Begin();
  Find();
  CallIt("/clerk/where", 1, R"({"name":"dock"})");
  ASSERT_TRUE(runtime.Delete(*clerk));
  session->OnPoll();
  EXPECT_THAT(Failure(), HasSubstr("deleted"));
  Turn();
  const auto gone = Take("unadvertiseServices");
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0]["serviceIds"].size(), 3u);
}

TEST_F(FoxgloveServices, AreNotForThoseWhoOnlyLook) {
  Begin(/*is_read_only=*/true);
  Turn();
  const auto told = Take("advertiseServices");
  ASSERT_EQ(told.size(), 1u);
  ASSERT_EQ(told[0]["services"].size(), 1u);
  EXPECT_EQ(told[0]["services"][0]["name"], "/stop") << "which is for everybody";
  session->OnBinary("\x02" + Word(3) + Word(1) + Word(4) + "json{}");
  EXPECT_THAT(Failure(), HasSubstr("role 'drive'"));
}

}  // namespace
}  // namespace runnel::test
