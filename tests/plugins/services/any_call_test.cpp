// Services called by those who know their types by description only.

#include "core/types/text_format.h"
#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

class AnyCallTest : public ServiceTest {
 protected:
  Callable& At(const std::string& path) { return *EditorTest::At<Port>(path).FindAnnotation<Callable>(); }
  Time now() { return runtime.clock().Now(); }
};

TEST_F(AnyCallTest, IsDescribedByItsArgumentsAndReply) {
  Callable& repeat = At("/app/server/output/repeat");
  ASSERT_EQ(repeat.arguments()->fields().size(), 2u);
  EXPECT_EQ(repeat.arguments()->fields()[0].name, "text");
  EXPECT_EQ(repeat.arguments()->fields()[1].name, "times");
  EXPECT_EQ(repeat.reply(), &TypeOf<std::string>());
  Callable& twice = At("/app/server/output/twice");
  EXPECT_EQ(twice.arguments(), &TypeOf<int>());
  EXPECT_EQ(twice.description(), "doubles");
  EXPECT_FALSE(twice.is_activity());
  Callable& reset = At("/app/server/output/reset");
  EXPECT_EQ(reset.arguments(), nullptr);
  EXPECT_EQ(reset.reply(), nullptr);
}

TEST_F(AnyCallTest, TakesArgumentsAsText) {
  Callable& repeat = At("/app/server/output/repeat");
  const auto call = repeat.NewCall();
  ASSERT_TRUE(SetFromText(*repeat.arguments(), "{text: ab, times: 2}", call->arguments()));
  EXPECT_EQ(call->Begin(now(), 1s), CallStatus::kPending);
  EXPECT_EQ(call->Poll(now()), CallStatus::kPending);
  Steps(1);
  ASSERT_EQ(call->Poll(now()), CallStatus::kAnswered);
  EXPECT_EQ(ToText(*repeat.reply(), call->reply()), "abab");
}

TEST_F(AnyCallTest, TimesOutAndSaysErrors) {
  Callable& twice = At("/app/server/output/twice");
  const auto late = twice.NewCall();
  ASSERT_EQ(late->Begin(now(), 1ms), CallStatus::kPending);
  EXPECT_EQ(late->Poll(now() + 2ms), CallStatus::kTimedOut);
  const auto wrong = twice.NewCall();
  *static_cast<int*>(wrong->arguments()) = -1;
  ASSERT_EQ(wrong->Begin(now(), 1s), CallStatus::kPending);
  Steps(1);
  EXPECT_EQ(wrong->Poll(now()), CallStatus::kFailed);
  EXPECT_THAT(wrong->error(), HasSubstr("is negative"));
}

TEST_F(AnyCallTest, OutlivesTheService) {
  const auto call = At("/app/server/output/twice").NewCall();
  ASSERT_EQ(call->Begin(now(), 1s), CallStatus::kPending);
  Must({DeleteElement{"/app/server"}});
  EXPECT_EQ(call->Poll(now()), CallStatus::kDisconnected);
}

TEST_F(AnyCallTest, AServiceNamesAllOfItsArgumentsOrNone) {
  Server& owner = server();
  EXPECT_THROW((Service<void(int, int)>(EditorTest::At<Group>("/app"), owner, "x", [](Server&, int, int) {},
                                        {.arguments = {"one"}})),
               ProgrammingError);
}

}  // namespace
}  // namespace runnel::test
