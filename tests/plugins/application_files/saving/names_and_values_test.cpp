// Whatever names and values a user gives while the application runs: they are refused before
// anything has changed, or a file can say them.

#include <random>

#include <gmock/gmock.h>

#include "core/port/proxy_port.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

const char* const kNamed = R"(<application name="demo">
  <group name="g"/>
  <module name="source" type="test/source">
    <parameter name="gain" value="2.5"/>
  </module>
</application>
)";

/// Names and texts of characters that have a meaning somewhere on the way.
class AnyText {
 public:
  explicit AnyText(unsigned seed) : random_(seed) {}

  std::size_t Below(std::size_t count) { return random_() % count; }
  std::string Make() {
    static const std::vector<std::string> kPieces{
        "a",           "Z", "7",  "_",  "-",  "?",    "*",    ".",    "\"",   "'",    "&",        "<",
        ">",           ";", "#",  "\\", "{",  "]]>",  "=",    "&#7;", "ä",    "日",   "🤖",     "/",
        " ",           ",", "\n", "\t", "\r", "\x01", "\x1b", "\x7f", "\xff", "\xc3", "\xc2\x85", "\xef\xbf\xbe",
        "\xed\xa0\x80"};
    // Mostly of what may be there, for one bad character spoils all.
    const std::size_t pieces = Below(3) == 0 ? kPieces.size() : 23;
    std::string text;
    for (std::size_t i = Below(6); i > 0; --i) text += kPieces[Below(pieces)];
    return text;
  }

 private:
  std::mt19937 random_;
};

Change AnyChange(AnyText& any) {
  const std::string path = (any.Below(2) == 0 ? "/demo/" : "/demo/g/") + any.Make();
  switch (any.Below(5)) {
    case 0:
      return CreateModule{path, "test/source", {{"text", any.Make()}}};
    case 1:
      return CreateModule{path, "test/optional"};
    case 2:
      return CreateGroup{path};
    case 3:
      return CreatePort{"/demo/g/" + any.Make(), Port::Direction::kInput, "double", any.Make()};
    default:
      return SetParameter{"/demo/source/gain", any.Make()};
  }
}

class SavedText : public ::testing::Test {
 protected:
  /// Loads the application from a file with this text.
  FrameworkElement* Load(const std::string& text) {
    WriteAll(file, text);
    FrameworkElement* const application = shop.Load(file);
    if (application == nullptr) throw std::runtime_error("the application does not load");
    return application;
  }
  /// Why it cannot be saved; the file is as it was.
  std::string Refusal(FrameworkElement& application) {
    const auto saved = SaveApplication(application.runtime(), application, shop.tools());
    EXPECT_FALSE(saved);
    EXPECT_EQ(ReadAll(file), kNamed);
    return saved ? "" : saved.error().ToString();
  }

  const TestFolder folder;
  const std::filesystem::path file = folder / "app.xml";
  SavingWorkshop shop;
};

TEST(NamesAndValues, AreRefusedAtOnceOrComeBackFromTheFile) {
  const TestFolder folder;
  int done = 0;
  int refused = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::filesystem::path file = folder / "app.xml";
    WriteAll(file, kNamed);
    SavingWorkshop shop;
    shop.Add<Optional>("test/optional");
    FrameworkElement* const application = shop.Load(file);
    ASSERT_NE(application, nullptr);
    StructureEditor editor(shop.runtime, shop.plugins.modules(), nullptr);
    AnyText any(seed);
    for (int i = 0; i < 16; ++i) {
      const std::string before = StructureText(*application);
      const bool is_done = editor.Apply({AnyChange(any)}).is_done;
      ++(is_done ? done : refused);
      if (!is_done) {
        ASSERT_EQ(StructureText(*application), before);
      }
    }
    const auto saved = SaveApplication(application->runtime(), *application, shop.tools());
    ASSERT_TRUE(saved) << saved.error().ToString();
    ExpectSame(*application, file, seed);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(done, 200);
  EXPECT_GT(refused, 200);
}

TEST(NamesAndValues, OfOneBadCharacterAreRefusedWithItsNameAndPlace) {
  SavingWorkshop shop;
  auto* const application = shop.Build(kNamed);
  ASSERT_NE(application, nullptr);
  StructureEditor editor(shop.runtime, shop.plugins.modules(), nullptr);
  const auto error = [&](Change change) { return editor.Apply({std::move(change)}).diagnostics.ToString(); };
  EXPECT_THAT(error(CreateGroup{"/demo/my filter"}), ::testing::HasSubstr("blank"));
  EXPECT_THAT(error(CreateGroup{"/demo/a\x07"}), ::testing::HasSubstr("control character 0x07"));
  EXPECT_THAT(error(CreateGroup{"/demo/a\xff"}), ::testing::HasSubstr("byte 0xff, which is no UTF-8"));
  EXPECT_THAT(error(CreateModule{"/demo/late", "test/source", {{"text", "ab\x07"}}}),
              ::testing::AllOf(::testing::HasSubstr("control character 0x07"), ::testing::HasSubstr("/demo/late")));
  EXPECT_THAT(error(CreatePort{"/demo/g/p", Port::Direction::kInput, "double", "\x07"}),
              ::testing::AllOf(::testing::HasSubstr("control character 0x07"), ::testing::HasSubstr("/demo/g/p")));
}

// What code has put there nobody has looked at.
TEST_F(SavedText, OfNamesThatNoFileCanSayLeavesTheFileAsItWas) {
  FrameworkElement* const application = Load(kNamed);
  shop.runtime.Create<ProxyPort>(shop.Get<FrameworkElement>("/demo/g"), "odd", Port::Direction::kInput,
                                 TypeOf<double>(), "\x07");
  EXPECT_THAT(Refusal(*application),
              ::testing::AllOf(::testing::HasSubstr("control character 0x07"), ::testing::HasSubstr("/demo/g/odd")));
}

TEST_F(SavedText, KeepsValuesAsTheyWereWrittenUntilTheyChange) {
  std::string text = kNamed;
  text.replace(text.find("2.5"), 3, "250 cm");
  FrameworkElement* const application = Load(text);
  auto& gain = shop.Get<Source>("/demo/source").gain;
  EXPECT_EQ(gain.Get(), 2.5);
  ASSERT_TRUE(gain.SetFromText("2500 mm"));
  EXPECT_EQ(shop.Text(*application, folder.path()), text);
  ASSERT_TRUE(gain.SetFromText("30 cm"));
  text.replace(text.find("250 cm"), 6, "0.3");
  EXPECT_EQ(shop.Text(*application, folder.path()), text);
}

// What no rule of the saver knows of, loading the text does.
TEST_F(SavedText, ThatWouldNotLoadLeavesTheFileAlone) {
  FrameworkElement* const application = Load(kNamed);
  AddedAttribute colour;
  colour.tag = "module";
  colour.rule = {.name = "colour", .kind = AttributeKind::kCount};
  colour.handle = [](const XmlAttribute&, FrameworkElement&, BuildContext&) {};
  colour.saved = [](FrameworkElement&) { return std::string("red"); };
  shop.tags.AddAttribute(colour);
  EXPECT_THAT(Refusal(*application),
              ::testing::AllOf(::testing::HasSubstr("would not load"), ::testing::HasSubstr("'red' is not a count")));
}

}  // namespace
}  // namespace runnel::testing
