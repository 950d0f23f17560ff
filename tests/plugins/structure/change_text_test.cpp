#include "plugins/structure/change_text.h"

#include <random>
#include <set>

#include <gmock/gmock.h>

#include "plugins/structure/change_fields.h"

namespace runnel::test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

namespace {

ChangeSet Parse(std::string_view text) {
  Diagnostics diagnostics;
  PlacedChanges placed = ParseChanges(text, {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  EXPECT_EQ(placed.changes.size(), placed.positions.size());
  return placed.changes;
}

template <typename Kind>
Kind ParseOne(std::string_view text) {
  const ChangeSet changes = Parse(text);
  EXPECT_THAT(changes, SizeIs(1)) << text;
  if (changes.size() != 1) return {};
  EXPECT_TRUE(std::holds_alternative<Kind>(changes[0])) << text;
  return std::holds_alternative<Kind>(changes[0]) ? std::get<Kind>(changes[0]) : Kind{};
}

std::string ErrorOf(std::string_view text) {
  Diagnostics diagnostics;
  const PlacedChanges placed = ParseChanges(text, {"rules"}, diagnostics);
  EXPECT_THAT(diagnostics.errors(), SizeIs(1)) << text;
  return diagnostics.ToString();
}

}  // namespace

TEST(ChangeText, ReadsTheCreationOfModulesWithTheirSettings) {
  const auto change = ParseOne<CreateModule>("create /robot/filter sensors/scan_filter window=5 label=\"a b\"");
  EXPECT_EQ(change.path, "/robot/filter");
  EXPECT_EQ(change.type, "sensors/scan_filter");
  ASSERT_THAT(change.settings, SizeIs(2));
  EXPECT_EQ(change.settings[0].parameter, "window");
  EXPECT_EQ(change.settings[0].value, "5");
  EXPECT_EQ(change.settings[1].value, "a b");
}

TEST(ChangeText, ReadsWhatIsSaidOfThreads) {
  const std::string text = "create thread fast activation=free_running period=5ms priority=20 on_overrun=catch_up";
  const auto thread = ParseOne<AddThread>(text);
  EXPECT_EQ(thread.name, "fast");
  EXPECT_EQ(thread.options.activation, ThreadOptions::Activation::kFreeRunning);
  EXPECT_EQ(thread.options.period, std::chrono::milliseconds(5));
  EXPECT_EQ(thread.options.priority, 20);
  EXPECT_EQ(ChangeText(thread), text);
  const auto schedule = ParseOne<ScheduleThread>("schedule /threads/fast period=2ms");
  EXPECT_EQ(schedule.period, std::chrono::milliseconds(2));
  EXPECT_FALSE(schedule.priority);
  EXPECT_EQ(ChangeText(schedule), "schedule /threads/fast period=2ms");
  const auto otherwise = ParseOne<ScheduleThread>("schedule fast activation=trigger");
  EXPECT_EQ(otherwise.activation, ThreadOptions::Activation::kTrigger);
  EXPECT_EQ(ChangeText(otherwise), "schedule fast activation=trigger");
  EXPECT_THAT(ErrorOf("schedule fast activation=triger"), HasSubstr("did you mean 'trigger'?"));
  EXPECT_THAT(ErrorOf("schedule fast perod=2ms"), HasSubstr("did you mean 'period'?"));
  EXPECT_THAT(ErrorOf("schedule fast priority=100"), HasSubstr("from 0 to 99"));
  EXPECT_THAT(ErrorOf("create thread fast activation=always"), HasSubstr("'always'"));
}

TEST(ChangeText, ReadsFromWhichLevelOnIsLogged) {
  const auto debug = ParseOne<LogElement>("log /robot debug");
  EXPECT_EQ(debug.path, "/robot");
  EXPECT_EQ(debug.level, LogLevel::kDebug);
  EXPECT_EQ(ChangeText(debug), "log /robot debug");
  const auto inherits = ParseOne<LogElement>("log / inherit");
  EXPECT_FALSE(inherits.level);
  EXPECT_EQ(ChangeText(inherits), "log / inherit");
  EXPECT_THAT(ErrorOf("log /robot waring"), HasSubstr("did you mean 'warning'?"));
  EXPECT_THAT(ErrorOf("log /robot"), HasSubstr("a level is missing"));
}

TEST(ChangeText, ReadsTheCreationOfGroupsAndPorts) {
  EXPECT_EQ(ParseOne<CreateGroup>("create group /robot/left").path, "/robot/left");
  const auto port = ParseOne<CreatePort>("create port /robot/left/scan output RangeScan");
  EXPECT_EQ(port.path, "/robot/left/scan");
  EXPECT_EQ(port.direction, Port::Direction::kOutput);
  EXPECT_EQ(port.type, "RangeScan");
}

TEST(ChangeText, ReadsTheCreationOfParametersOfGroups) {
  const char* const text = "create parameter /robot/radius left/radius right/radius description=\"of both wheels\"";
  const auto parameter = ParseOne<CreateParameter>(text);
  EXPECT_EQ(parameter.path, "/robot/radius");
  EXPECT_THAT(parameter.targets, ElementsAre("left/radius", "right/radius"));
  EXPECT_EQ(parameter.description, "of both wheels");
  EXPECT_EQ(ChangeText(parameter), text);
  EXPECT_THAT(ErrorOf("create parameter /robot/radius"), HasSubstr("a parameter that it stands for"));
}

TEST(ChangeText, WritesModulesThatAreCalledLikeAWordSoThatTheyAreReadBack) {
  EXPECT_EQ(ParseOne<CreateModule>(ChangeText(CreateModule{"group", "t"})).path, "/group");
}

TEST(ChangeText, ReadsConnections) {
  const auto plain = ParseOne<ConnectPorts>("connect /a/x /b/y");
  EXPECT_EQ(plain.from, "/a/x");
  EXPECT_EQ(plain.to, "/b/y");
  EXPECT_EQ(plain.options.queue, 0U);
  const auto queued = ParseOne<ConnectPorts>("connect /a/x /b/y on_full=drop_newest queue=10");
  EXPECT_EQ(queued.options.queue, 10U);
  EXPECT_EQ(queued.options.on_full, OnFull::kDropNewest);
  EXPECT_FALSE(queued.options.pull);
  EXPECT_TRUE(ParseOne<ConnectPorts>("connect /a/x /b/y pull=true").options.pull);
  EXPECT_FALSE(ParseOne<ConnectPorts>("connect /a/x /b/y queue=1 pull=false").options.pull);
  EXPECT_EQ(ChangeText(ConnectPorts{"/a/x", "/b/y", {.pull = true}}), "connect /a/x /b/y pull=true");
  const auto late = ParseOne<ConnectPorts>("connect /a/x.y /b/y convert=round when=present late=true");
  EXPECT_EQ(late.from, "/a/x.y");
  EXPECT_EQ(late.options.convert, "round");
  EXPECT_TRUE(late.options.when_present && late.options.late);
  EXPECT_EQ(ChangeText(late), "connect /a/x.y /b/y convert=round when=present late=true");
  EXPECT_EQ(ChangeText(ConnectPorts{"/a/x", "/b/y", {.part = "y"}}), "connect /a/x.y /b/y");
  EXPECT_EQ(ChangeText(ConnectPorts{"/a/x", "/b/y", {.part = "[0]"}}), "connect /a/x[0] /b/y");
  EXPECT_EQ(ParseOne<DisconnectPorts>("disconnect /a/x /b/y").to, "/b/y");
}

TEST(ChangeText, ReadsReplacements) {
  const auto change = ParseOne<ReplaceModule>("replace /r/p with planning/bug1 step=0.1 probation=3");
  EXPECT_EQ(change.path, "/r/p");
  EXPECT_EQ(change.type, "planning/bug1");
  EXPECT_EQ(change.probation_cycles, 3U);
  ASSERT_THAT(change.settings, SizeIs(1));
  EXPECT_EQ(change.settings[0].value, "0.1");
  EXPECT_EQ(ParseOne<ReplaceModule>("replace /r/p with planning/bug1").probation_cycles,
            ReplaceModule{}.probation_cycles);
}

TEST(ChangeText, ReadsValuesInBracketsAsOneWord) {
  EXPECT_EQ(ParseOne<SetParameter>("set /r/p {x: 1, name: \"a ] \\\" }\", l: [1, 2]}").value,
            "{x: 1, name: \"a ] \\\" }\", l: [1, 2]}");
  const auto change = ParseOne<CreateModule>("create /r/p t a=[[1, 2], [3, 4]] b={} # and that is it");
  ASSERT_THAT(change.settings, SizeIs(2));
  EXPECT_EQ(change.settings[0].value, "[[1, 2], [3, 4]]");
  EXPECT_EQ(change.settings[1].value, "{}");
}

TEST(ChangeText, ReadsQuotedWordsAndTheirEscapes) {
  EXPECT_EQ(ParseOne<SetParameter>(R"(set /r/p "20 ms; \"x\" \\ \n\t#")").value, "20 ms; \"x\" \\ \n\t#");
  EXPECT_EQ(ParseOne<SetParameter>("set /r/p \"\"").value, "");
  EXPECT_EQ(ParseOne<AssignToThread>("move /r/p to \"\"").thread, "");
  EXPECT_EQ(ParseOne<SetParameter>("set \"/r/a name\" a=b").path, "/r/a name");
  EXPECT_EQ(ParseOne<SetParameter>("set /r/p a=b").value, "a=b");
}

TEST(ChangeText, ReadsSeveralChangesByLineAndBySemicolon) {
  EXPECT_THAT(Parse("delete /a\n\n# nothing here\n  delete /b ; delete /c;; \r\n;"), SizeIs(3));
  EXPECT_THAT(Parse(""), IsEmpty());
  EXPECT_THAT(Parse(" # only words"), IsEmpty());
}

TEST(ChangeText, KnowsWhereEachChangeStands) {
  Diagnostics diagnostics;
  const auto placed = ParseChanges("delete /a; delete \"/ö\"; delete /b\n delete /c", {"f.xml", 7, 20}, diagnostics);
  EXPECT_THAT(placed.positions, ElementsAre(SourcePosition{"f.xml", 7, 20}, SourcePosition{"f.xml", 7, 31},
                                            SourcePosition{"f.xml", 7, 44}, SourcePosition{"f.xml", 8, 2}));
}

TEST(ChangeText, NamesTheNearestWordAndThePlace) {
  EXPECT_EQ(ErrorOf("\n  conect /a /b"), "rules:2:3: error: there is no change 'conect'; did you mean 'connect'?\n");
  EXPECT_THAT(ErrorOf("connect /a /b quue=3"),
              HasSubstr("1:15: error: there is no option 'quue'; did you mean 'queue'?"));
  EXPECT_THAT(ErrorOf("connect /a /b queue=3 on_full=refus"), HasSubstr("did you mean 'refuse'?"));
  EXPECT_THAT(ErrorOf("create port /a inpt T"), HasSubstr("did you mean 'input'?"));
  EXPECT_THAT(ErrorOf("replace /a by t"), HasSubstr("1:12: error: there should be 'with'"));
}

TEST(ChangeText, SaysWhatIsMissingAndWhatIsTooMuch) {
  EXPECT_THAT(ErrorOf("delete"), HasSubstr("a path is missing after 'delete'; write: delete PATH"));
  EXPECT_THAT(ErrorOf("connect /a"), HasSubstr("the input is missing after '/a'"));
  EXPECT_THAT(ErrorOf("replace /a"), HasSubstr("'with' is missing"));
  EXPECT_THAT(ErrorOf("set /a 20 ms"), HasSubstr("1:11: error: 'ms' is one word too many"));
  EXPECT_THAT(ErrorOf("create /a t =3"), HasSubstr("'=3' is one word too many"));
  EXPECT_THAT(ErrorOf("create /a t w=3 w=4"), HasSubstr("'w' is there twice"));
  EXPECT_THAT(ErrorOf("connect /a /b on_full=refuse"), HasSubstr("no meaning without a queue"));
  EXPECT_THAT(ErrorOf("connect /a /b queue=3 pull=true"), HasSubstr("cannot have a queue"));
  EXPECT_THAT(ErrorOf("connect /a /b pull=tru"), HasSubstr("did you mean 'true'?"));
}

TEST(ChangeText, RefusesCountsThatAreNone) {
  for (const char* count : {"", "-1", "3x", "1000001", "99999999999999999999999", "1.5"}) {
    EXPECT_THAT(ErrorOf(std::string("connect /a /b queue=") + count), HasSubstr("is not a count"));
  }
}

TEST(ChangeText, RefusesWhatIsNotClosed) {
  EXPECT_THAT(ErrorOf("set /a \"b\n"), HasSubstr("1:8: error: the quotation mark is not closed"));
  EXPECT_THAT(ErrorOf("set /a \"b\\"), HasSubstr("must stand before one of"));
  EXPECT_THAT(ErrorOf("set /a [1, [2]"), HasSubstr("1:8: error: the bracket is not closed"));
  EXPECT_THAT(ErrorOf("set /a [1]x"), HasSubstr("a blank is missing"));
  EXPECT_THAT(ErrorOf("set /a b\"c\""), HasSubstr("in the middle of a word"));
  EXPECT_THAT(ErrorOf(std::string_view("set /a \0", 8)), HasSubstr("a control character"));
}

TEST(ChangeText, TellsAllThatIsWrongAndReturnsTheRest) {
  Diagnostics diagnostics;
  const auto placed = ParseChanges("delet /a\ndelete /b\nset /a \"\ndelete /c", {}, diagnostics);
  EXPECT_THAT(diagnostics.errors(), SizeIs(2));
  EXPECT_THAT(placed.changes, SizeIs(2));
}

TEST(ChangeText, EachKindOfChangeHasAnExampleThatIsReadAndWrittenBack) {
  std::set<std::size_t> kinds;
  for (const ChangeForm& form : ChangeForms()) {
    const ChangeSet changes = Parse(form.example);
    ASSERT_THAT(changes, SizeIs(1)) << form.name;
    kinds.insert(changes[0].index());
    EXPECT_EQ(ChangeText(changes[0]), form.example);
    EXPECT_EQ(FormOf(changes[0]), &form);
  }
  EXPECT_THAT(kinds, SizeIs(std::variant_size_v<Change>)) << "one has no form";
}

TEST(ChangeText, WhatToWriteIsMadeOfTheFields) {
  EXPECT_THAT(ErrorOf("connect"), HasSubstr("write: connect FROM[.PART] TO [queue=N] "
                                            "[on_full=drop_oldest|drop_newest|refuse] [pull=true] [convert=NAME] "
                                            "[when=present] [late=true]"));
  EXPECT_THAT(ErrorOf("create port"), HasSubstr("write: create port PATH input|output TYPE [description=TEXT]"));
  EXPECT_THAT(ErrorOf("create parameter"), HasSubstr("create parameter PATH PARAMETER ... [description=TEXT]"));
  EXPECT_THAT(ErrorOf("replace"), HasSubstr("replace PATH with TYPE [NAME=VALUE ...] [probation=CYCLES]"));
  EXPECT_THAT(ErrorOf("tag"), HasSubstr("tag PATH [WORD ...]"));
}

namespace {

// Pieces of which texts are made that are nearly right.
class RandomText {
 public:
  explicit RandomText(std::uint32_t seed) : random_(seed) {}

  std::size_t Below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  std::string Letters() {
    static const std::string kCharacters = "ab/=\"\\ ;#[]{}\n\t\r\x01\x7f\xc3\xb6.,:0";
    std::string text;
    for (std::size_t left = Below(8); left > 0; --left) text += kCharacters[Below(kCharacters.size())];
    return text;
  }
  std::string Changes() {
    static const std::vector<std::string> kPieces{"create",  "delete",  "connect",  "disconnect",  "set",    "replace",
                                                  "move",    "group",   "port",     "with",        "to",     "input",
                                                  "/a/b",    "queue=3", "on_full=", "refuse",      "{x: 1}", "[1, ",
                                                  "\"a b\"", "\"",      "a=\"b\"",  "probation=2", ";",      "\n"};
    std::string text;
    for (std::size_t left = Below(14); left > 0; --left) {
      text += Below(10) == 0 ? Letters() : kPieces[Below(kPieces.size())];
      if (Below(8) > 0) text += ' ';
    }
    return text;
  }
  std::string Name() {
    static const std::string kCharacters = "abcxyz_0";
    std::string text(1 + Below(5), 'a');
    for (char& character : text) character = kCharacters[Below(kCharacters.size())];
    return text;
  }
  std::vector<Setting> Settings() {
    std::vector<Setting> settings;
    for (std::size_t i = Below(3); i > 0; --i) {
      settings.push_back({"p" + std::to_string(i), Letters()});
    }
    return settings;
  }
  Change AnyChange() {
    switch (Below(9)) {
      case 0:
        return CreateModule{"/" + Letters(), Name(), Settings()};
      case 1:
        return CreateGroup{"/" + Letters()};
      case 2:
        return CreatePort{"/" + Name(), static_cast<Port::Direction>(Below(2)), Letters()};
      case 3:
        return DeleteElement{Letters()};
      case 4:
        return ConnectPorts{Letters(), Letters(), {1 + Below(9), static_cast<OnFull>(Below(3))}};
      case 5:
        return DisconnectPorts{Letters(), Letters()};
      case 6:
        return SetParameter{Letters(), Letters()};
      case 7:
        return ReplaceModule{Letters(), Letters(), Settings(), Below(20)};
      default:
        return AssignToThread{Letters(), Letters()};
    }
  }

 private:
  std::mt19937 random_;
};

}  // namespace

TEST(ChangeText, ReadsBackWhateverItWrites) {
  RandomText random(1);
  for (int i = 0; i < 20'000; ++i) {
    const std::string text = ChangeText(random.AnyChange());
    Diagnostics diagnostics;
    const auto placed = ParseChanges(text, {}, diagnostics);
    // What has control characters other than the usual ones is written, and read, in quotation marks.
    ASSERT_TRUE(diagnostics.ok()) << text << '\n' << diagnostics.ToString();
    ASSERT_THAT(placed.changes, SizeIs(1)) << text;
    ASSERT_EQ(ChangeText(placed.changes[0]), text);
  }
}

TEST(ChangeText, ReadsAnyTextWithoutHarmAndReadsWhatItAcceptsTheSameAgain) {
  RandomText random(2);
  int accepted = 0;
  for (int i = 0; i < 100'000; ++i) {
    const std::string text = random.Changes();
    Diagnostics diagnostics;
    const auto placed = ParseChanges(text, {}, diagnostics);
    for (const Error& each : diagnostics.errors()) {
      ASSERT_GT(each.position.line, 0) << text;
      ASSERT_GT(each.position.column, 0) << text;
    }
    for (const Change& each : placed.changes) {
      ++accepted;
      const ChangeSet again = Parse(ChangeText(each));
      ASSERT_THAT(again, SizeIs(1)) << text;
      ASSERT_EQ(ChangeText(again[0]), ChangeText(each));
    }
  }
  EXPECT_GT(accepted, 1'000);
}

}  // namespace runnel::test
