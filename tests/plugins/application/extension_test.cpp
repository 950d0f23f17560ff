// Extensions that are plugins: found by their descriptions, loaded when an option or a word asks for them.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "plugins/application/application.h"
#include "plugins/application/extension_description.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path kFolder = RUNNEL_TEST_EXTENSIONS;

LoadedApplication LoadWith(const std::string& inside, std::vector<ExtensionByName> extensions = {},
                           const std::filesystem::path& folder = kFolder) {
  return Application::LoadText("<application name=\"a\">" + inside + "</application>",
                               {.plugin_folders = {folder},
                                .clock = SchedulerOptions::ClockKind::kSimulated,
                                .extensions_by_name = std::move(extensions)});
}

std::string StartTexts(const Application& application) {
  std::string text;
  for (const auto& extension : application.extensions()) text += extension->StartText();
  return text;
}

/// A folder with one description, and no library.
class Described : public testing::Test {
 protected:
  Result<ExtensionCatalogue> Read(const std::string& text) {
    std::ofstream(folder_ / "absent.extension.xml") << text;
    return ExtensionCatalogue::Read({folder_.path(), "/no/such/folder"});
  }
  TemporaryFolder folder_;
};

TEST(Extension, IsAttachedByItsNameWithItsArguments) {
  const auto application = LoadWith("", {{"greeting", {{{"name", "Ada"}, {"name", "Alan"}}}}});
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  EXPECT_EQ(StartTexts(*application), "hello Ada Alan\n");
}

TEST(Extension, IsAttachedByAWordOfTheFileAndOnlyOnce) {
  const auto application = LoadWith("<group name=\"g\"><greeting/><greeting/></group><greeting/>");
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  EXPECT_EQ(StartTexts(*application), "hello\n");
  const auto by_both = LoadWith("<greeting/>", {{"greeting", {{{"name", "Ada"}}}}});
  ASSERT_TRUE(by_both) << by_both.diagnostics().ToString();
  EXPECT_EQ(StartTexts(*by_both), "hello Ada\n");
  const auto loaded = LoadWith("<load plugin=\"greeting\"/><greeting/>");
  ASSERT_TRUE(loaded) << loaded.diagnostics().ToString();
  EXPECT_EQ(StartTexts(*loaded), "hello\n");
}

TEST(Extension, IsNotLoadedIfNobodyAsksForIt) {
  const auto application = LoadWith("");
  ASSERT_TRUE(application);
  EXPECT_THAT(application->extensions(), IsEmpty());
  EXPECT_THAT(application->plugins().loaded(), IsEmpty());
  const auto with = LoadWith("<greeting/>");
  ASSERT_TRUE(with);
  EXPECT_THAT(with->plugins().loaded(), ElementsAre("greeting"));
}

TEST(Extension, RefusesWhatItsOptionsAreNot) {
  EXPECT_THAT(LoadWith("", {{"greeting", {{{"nam", "Ada"}}}}}).diagnostics().ToString(),
              HasSubstr("the extension 'greeting' has no option 'nam'; did you mean 'name'?"));
  EXPECT_THAT(LoadWith("", {{"greting"}}).diagnostics().ToString(),
              HasSubstr("there is no extension 'greting'; did you mean 'greeting'?"));
  EXPECT_THAT(LoadWith("", {{"greeting", {{{"name", "nobody"}}}}}).diagnostics().ToString(),
              HasSubstr("--name: nobody is greeted"));
}

TEST_F(Described, AndNotInstalledIsToldByItsNameOnceWithAllOtherMistakes) {
  ASSERT_TRUE(Read("<extension summary=\"sees\"><tag name=\"see\"/><option name=\"see\"/></extension>"));
  const std::string text = LoadWith("\n<see port=\"1\"/><module/>", {}, folder_.path()).diagnostics().ToString();
  EXPECT_THAT(text, HasSubstr(":2:1: error: /: <see> needs the extension 'absent', which is not "
                              "installed; it sees\n"));
  EXPECT_THAT(text, AllOf(HasSubstr("<module> has no 'name'"), Not(HasSubstr("unknown"))));
  EXPECT_THAT(LoadWith("", {{"absent", {{{"see", ""}}}}}, folder_.path()).error().message,
              "--see needs the extension 'absent', which is not installed");
}

TEST_F(Described, SaysWhatItAdds) {
  const auto read = Read(R"(<extension summary="sees">
  <tag name="see"/> <command name="look"/>
  <option name="eye" kind="value" value="SIDE" summary="which"/>
  <option name="both" command="look"/>
</extension>)");
  ASSERT_TRUE(read) << read.error().ToString();
  const ExtensionDescription* const found = read->FindTag("see");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found, read->FindCommand("look"));
  EXPECT_EQ(found, read->Find("absent"));
  EXPECT_EQ(read->FindTag("look"), nullptr);
  EXPECT_EQ(found->summary, "sees");
  ASSERT_EQ(found->options.size(), 2u);
  EXPECT_EQ(found->options[0].kind, ExtensionOption::Kind::kValue);
  EXPECT_EQ(found->options[0].value_name, "SIDE");
  EXPECT_EQ(found->options[1].kind, ExtensionOption::Kind::kFlag);
  EXPECT_EQ(found->options[1].command, "look");
}

TEST_F(Described, WronglyIsToldWithItsPlace) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"<extension/>", "1:1: <extension> has no 'summary'"},
           {"<plugin summary=\"\"/>", "1:1: <plugin> does not describe an extension"},
           {"<extension summary=\"\"><tags/></extension>", "1:23: "},
           {"<extension summary=\"\"><tag/></extension>", "1:23: <tag> has no 'name'"},
           {"<extension summary=\"\"><option name=\"a\" kind=\"b\"/></extension>",
            "1:46: 'b' is no kind of option; flag,"},
           {"<extension", ""}}) {
    const auto read = Read(text);
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().ToString(), AllOf(HasSubstr("absent.extension.xml:"), HasSubstr(message)));
  }
}

TEST_F(Described, LibrariesToPreloadAreNamedFromWhereTheDescriptionIs) {
  const auto read = Read(
      "<extension summary=\"\"><option name=\"a\" preload=\"../b.so\"/><option name=\"c\"/>"
      "</extension>");
  ASSERT_TRUE(read) << read.error().ToString();
  EXPECT_EQ(read->Find("absent")->options[0].preload, folder_.path().parent_path() / "b.so");
  EXPECT_EQ(read->Find("absent")->options[1].preload, "");
}

// Else a description promises what the library does not have.
TEST(Extension, OfThisTreeHasTheWordsOfItsDescription) {
  ApplicationDescription application;
  const auto catalogue = ExtensionCatalogue::Read(application.plugins().search_path());
  ASSERT_TRUE(catalogue) << catalogue.error().ToString();
  std::vector<std::string> names;
  for (const ExtensionDescription& extension : catalogue->all()) {
    names.push_back(extension.name);
    ASSERT_TRUE(application.plugins().Load(extension.name)) << extension.name;
    for (const std::string& tag : extension.tags) {
      const bool is_form_of_file = tag.starts_with("Finstructable");
      EXPECT_TRUE(is_form_of_file || application.tags().FindTag(tag) != nullptr) << tag;
    }
  }
  EXPECT_THAT(names, ElementsAre("finroc_files", "network", "real_time_check", "recording", "tracing", "viewers"));
}

// Once for each option, so that one that the library does not read shows.
TEST(Extension, OfThisTreeRefusesWhatItsOptionsCannotBe) {
  const auto message = [](const std::string& extension, const std::string& option, const std::string& value) {
    const auto application =
        Application::LoadText("<application name=\"a\"/>", {.extensions_by_name = {{extension, {{{option, value}}}}}});
    return application ? "" : application.error().ToString();
  };
  EXPECT_THAT(message("viewers", "inspect", "x"), HasSubstr("'x' is not a port"));
  EXPECT_THAT(message("viewers", "inspect-token", "short"), HasSubstr("the token cannot be used"));
  EXPECT_THAT(message("viewers", "inspect-token", "look:"), HasSubstr("the token cannot be used"));
  EXPECT_THAT(message("viewers", "inspect-token-file", "/no/file"), HasSubstr("/no/file"));
  EXPECT_THAT(message("viewers", "inspect-certificate", "/no/file"), HasSubstr("/no/file"));
  EXPECT_THAT(message("viewers", "inspect-key", "/no/file"), HasSubstr("/no/file"));
  EXPECT_THAT(message("viewers", "inspect", "0.0.0.0:0"), HasSubstr("nothing is encrypted"));
  EXPECT_THAT(message("recording", "record-ports", "a"), HasSubstr("--record-ports needs"));
  EXPECT_THAT(message("recording", "record-compression", "a"), HasSubstr("--record-compression"));
  EXPECT_THAT(message("recording", "record", "/no/folder/a.mcap"), HasSubstr("its folder"));
  EXPECT_THAT(message("recording", "recording", "/no/file.mcap"), HasSubstr("cannot be read"));
  EXPECT_THAT(message("tracing", "trace", ""), HasSubstr("is not the name of a file"));
}

TEST(Extension, OfThisTreeReadsFilesOfFinroc) {
  const TemporaryFolder folder;
  const std::string file = folder / "old.finroc";
  std::ofstream(file) << "<Finstructable defaultname=\"Old One\"/>";
  const auto application = Application::Load(file, {.clock = SchedulerOptions::ClockKind::kSimulated});
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  EXPECT_EQ(application->name(), "old_one");
}

}  // namespace
}  // namespace runnel::test
