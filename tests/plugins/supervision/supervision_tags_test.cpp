#include <gmock/gmock.h>

#include "plugins/application_tags/run_description.h"
#include "tests/plugins/application_files/reading/test_application.h"
#include "tests/plugins/supervision/notices.h"
#include "tests/support/wait_until.h"

namespace runnel::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct SupervisedWorkshop : Workshop {
  SupervisedWorkshop() {}
  // What the file says besides two sources and a sink that the first one feeds.
  std::string ErrorsOf(const std::string& words) {
    return Errors(
        "<application name=\"demo\">"
        "<module name=\"a\" type=\"test/source\"/><module name=\"b\" type=\"test/source\"/>"
        "<module name=\"sink\" type=\"test/sink\"/>"
        "<connect from=\"a/value\" to=\"sink/value\" queue=\"5\"/>" +
        words + "</application>");
  }
};

class SupervisionTags : public ::testing::Test {
 protected:
  SupervisedWorkshop workshop;
};

TEST_F(SupervisionTags, MakeRulesThatSwitchSetAndReplace) {
  const std::string errors = workshop.ErrorsOf(
      "<on_stale input=\"sink/value\" after=\"30ms\">"
      "  <switch input=\"sink/value\" from=\"a/value\" to=\"b/value\"/>"
      "  <set parameter=\"b/gain\" value=\"2\"/>"
      "  <otherwise><switch input=\"sink/value\" from=\"b/value\" to=\"a/value\"/></otherwise>"
      "</on_stale>"
      "<on_fault of=\"a\"><replace module=\"a\" by=\"test/source\"/><quit/></on_fault>");
  ASSERT_THAT(errors, IsEmpty());
  Scheduler scheduler(workshop.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  std::vector<ChangeSet> done;
  Supervisor supervisor(workshop.runtime, scheduler, [&](const ChangeSet& changes) -> Result<ChangeSet> {
    done.push_back(changes);
    return ChangeSet();
  });
  const auto application = workshop.runtime.root().Find("/demo");
  ASSERT_TRUE(AddRules(**application, scheduler, supervisor));
  scheduler.RunUntil(Time(std::chrono::milliseconds(100)));  // the source publishes nothing
  ASSERT_EQ(done.size(), 1u);
  ASSERT_EQ(done[0].size(), 3u);
  EXPECT_EQ(std::get<DisconnectPorts>(done[0][0]).from, "/demo/a/output/value");
  const auto& connect = std::get<ConnectPorts>(done[0][1]);
  EXPECT_EQ(connect.from, "/demo/b/output/value");
  EXPECT_EQ(connect.options.queue, 5u);  // as before
  EXPECT_EQ(std::get<SetParameter>(done[0][2]).value, "2");
}

TEST_F(SupervisionTags, PublishValuesUntilAllIsWellAgain) {
  ASSERT_THAT(workshop.ErrorsOf("<on_stale input=\"sink/value\" after=\"30ms\" fresh_after=\"20ms\">"
                                "  <publish port=\"sink/value\" value=\"-7\"/></on_stale>"),
              IsEmpty());
  Scheduler scheduler(workshop.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  Supervisor supervisor(workshop.runtime, scheduler, [](const ChangeSet&) { return Result<ChangeSet>(ChangeSet()); });
  const auto application = workshop.runtime.root().Find("/demo");
  ASSERT_TRUE(AddRules(**application, scheduler, supervisor));
  const auto found = workshop.runtime.root().Find("/demo/sink/input/value");
  ASSERT_TRUE(found);
  auto& input = dynamic_cast<Port&>(**found);
  scheduler.RunUntil(Time(std::chrono::milliseconds(100)));  // the source publishes nothing
  ASSERT_TRUE(input.is_set_by_hand(Port::Setter::kRule));
  const auto stale = test::NoticesOf(supervisor);
  ASSERT_EQ(stale.size(), 1u);
  EXPECT_FALSE(stale[0].is_failure);
  EXPECT_THAT(stale[0].message, HasSubstr("published -7 at /demo/sink/input/value"));

  const auto source = workshop.runtime.root().Find("/demo/a");
  ASSERT_TRUE(source);
  for (int ms = 101; ms < 200; ++ms) {
    dynamic_cast<Source&>(**source).value.Publish(ms);
    scheduler.RunUntil(Time(std::chrono::milliseconds(ms)));
  }
  EXPECT_FALSE(input.is_set_by_hand(Port::Setter::kRule));  // what is published is read again
}

TEST_F(SupervisionTags, RefuseValuesThatThePortCannotHave) {
  const std::string errors = workshop.ErrorsOf(
      "<on_stale input=\"sink/value\" after=\"30ms\"><publish port=\"sink/value\" value=\"much\"/>"
      "<publish port=\"sink/valeu\"/><publish prot=\"sink/value\"/><set value=\"1\"/></on_stale>");
  EXPECT_THAT(errors, AllOf(HasSubstr("much"), HasSubstr("did you mean 'value'"), HasSubstr("did you mean 'port'"),
                            HasSubstr("'parameter'"), Not(HasSubstr("failed"))));
}

TEST_F(SupervisionTags, MakeRulesOfModulesThatDoNotReturn) {
  ASSERT_THAT(workshop.ErrorsOf("<on_stuck of=\"a\" after=\"20ms\"><set parameter=\"b/gain\" value=\"2\"/>"
                                "  <otherwise><set parameter=\"b/gain\" value=\"1\"/></otherwise></on_stuck>"
                                "<on_stuck of=\".\" after=\"1s\"/>"),
              IsEmpty());
  Scheduler scheduler(workshop.runtime);
  std::vector<ChangeSet> done;
  Supervisor supervisor(workshop.runtime, scheduler, [&](const ChangeSet& changes) -> Result<ChangeSet> {
    done.push_back(changes);
    return ChangeSet();
  });
  ASSERT_TRUE(AddRules(**workshop.runtime.root().Find("/demo"), scheduler, supervisor));
  const auto rules = scheduler.StuckRules();
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_EQ(rules[0].of, "/demo/a");
  EXPECT_EQ(rules[0].after, std::chrono::milliseconds(20));
  EXPECT_FALSE(rules[1].on_stuck) << "it is only told of";
  rules[0].on_stuck(Fault{"/demo/a", "is stuck"});
  rules[0].on_return(Fault{"/demo/a", "is stuck"});
  std::size_t told = 0;
  test::WaitUntil("both have been carried out, in their order",
                  [&] { return (told += test::NoticesOf(supervisor).size()) == 2; });
  ASSERT_EQ(done.size(), 2u);
  EXPECT_EQ(std::get<SetParameter>(done[0][0]).value, "2");
  EXPECT_EQ(std::get<SetParameter>(done[1][0]).value, "1");
}

TEST_F(SupervisionTags, TellWhatIsWrongWithTheirPlace) {
  EXPECT_THAT(workshop.ErrorsOf("<on_stale input=\"sink/valve\" after=\"30ms\"><quit/></on_stale>"),
              AllOf(HasSubstr("app.xml:1:"), HasSubstr("did you mean 'value'?")));
  EXPECT_THAT(workshop.ErrorsOf("<on_stale input=\"sink/second\" after=\"1s\"><quit/></on_stale>"),
              HasSubstr("nothing is connected"));
  EXPECT_THAT(workshop.ErrorsOf("<on_stale input=\"sink/value\" after=\"soon\"><quit/></on_stale>"),
              HasSubstr("'soon'"));
  EXPECT_THAT(workshop.ErrorsOf("<on_stale input=\"sink/value\" after=\"1s\"/>"),
              HasSubstr("does not say what is to be done"));
  EXPECT_THAT(workshop.ErrorsOf("<on_stale input=\"sink/value\" after=\"1s\">"
                                "<switch input=\"sink/value\" to=\"a/label\"/></on_stale>"),
              HasSubstr("carries"));
  EXPECT_THAT(workshop.ErrorsOf("<on_stale input=\"sink/value\" after=\"1s\">"
                                "<switch input=\"sink/value\"/></on_stale>"),
              HasSubstr("neither"));
  EXPECT_THAT(workshop.ErrorsOf("<on_fault of=\"a\"><set parameter=\"a/gain\" value=\"99\"/></on_fault>"),
              HasSubstr("/demo/a/parameter/gain"));
  EXPECT_THAT(workshop.ErrorsOf("<on_fault of=\"a\"><set parameter=\"a/text\" value=\"x\"/></on_fault>"),
              HasSubstr("static"));
  EXPECT_THAT(workshop.ErrorsOf("<on_fault of=\"a\"><replace module=\"b\" by=\"test/sorce\"/></on_fault>"),
              HasSubstr("test/source"));
  EXPECT_THAT(workshop.ErrorsOf("<on_stuck of=\"nobody\" after=\"1s\"/>"), HasSubstr("nobody"));
  EXPECT_THAT(workshop.ErrorsOf("<on_stuck of=\"a\" after=\"0s\"/>"), HasSubstr("not longer"));
  EXPECT_THAT(workshop.ErrorsOf("<on_fault of=\"nobody\"><quit/></on_fault>"), HasSubstr("nobody"));
  EXPECT_THAT(workshop.ErrorsOf("<on_fault of=\"a\" action=\"quit\"><quit/></on_fault>"), HasSubstr("one thing"));
}

TEST_F(SupervisionTags, AWordOfBeforeIsRefusedWithTheNewOne) {
  EXPECT_THAT(workshop.ErrorsOf("<on_fault of=\"a\"><stop/></on_fault>"),
              HasSubstr("what ends the run is called <quit/> now"));
  EXPECT_THAT(workshop.ErrorsOf("<on_fault of=\"a\" action=\"stop_application\"/>"),
              HasSubstr("'stop_application' is not possible for action; there is 'quit'"));
}

}  // namespace
}  // namespace runnel::testing
