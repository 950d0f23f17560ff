#include "plugins/genom_templates/template_run.h"

#include <fstream>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::SizeIs;

class TemplateRunTest : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name) << text;
  }
  Result<TemplateOutput> Run(const std::string& model = R"({"name": "c", "list": [1, 2.5, null, true]})") {
    return RunTemplate(folder_.path() / "own", model, {{"style", "short"}});
  }
  std::string Wrong() {
    const auto result = Run();
    return result ? "" : result.error().ToString();
  }
  test::TemporaryFolder folder_;
};

TEST_F(TemplateRunTest, MakesFilesOfTextsAndTheModel) {
  Write("own/template.lua",
        "file('a.in', model.name .. '.txt', {what = 'this'})\nkeep('a.in', 'kept', {what = options.style})\n");
  Write("own/a.in", "<% for i, each in ipairs(model.list) do %>\n<%= what %> <%= i %>: <%= each %>\n<% end %>\n");
  const auto result = Run();
  ASSERT_TRUE(result) << result.error().ToString();
  ASSERT_THAT(result->files, SizeIs(2));
  EXPECT_EQ(result->files[0].path, "c.txt");
  EXPECT_EQ(result->files[0].text, "this 1: 1\nthis 2: 2.5\nthis 3: false\nthis 4: true\n");
  EXPECT_FALSE(result->files[0].is_kept);
  EXPECT_TRUE(result->files[1].is_kept);
  EXPECT_THAT(result->sources, SizeIs(3));
}

TEST_F(TemplateRunTest, LibrariesAndTextsWithinTexts) {
  Write("own/template.lua", "file('a.in', 'a')\n");
  Write("own/a.in", "<% local l = library('own') %>\n[<%= text('b.in', {x = l.twice(2)}) %>]<% write(1, 'z') %>");
  Write("own/b.in", "<%= x %>");
  Write("own/own.lua", "return {twice = function(x) return 2 * x end}");
  const auto result = Run();
  ASSERT_TRUE(result) << result.error().ToString();
  EXPECT_EQ(result->files[0].text, "[4]1z");
}

TEST_F(TemplateRunTest, ErrorsHaveFileAndLineOfTheTemplate) {
  Write("own/template.lua", "\nfile('a.in', 'a')\n");
  Write("own/a.in", "one\n<% if true then %>\n<%= model.nothing %>\n<% end %>\n");
  EXPECT_THAT(Wrong(), EndsWith("own/a.in:3: there is no field 'nothing' here"));
  Write("own/a.in", "one\n\n<%= undefined %>\n");
  EXPECT_THAT(Wrong(), EndsWith("own/a.in:3: there is no 'undefined' here"));
  Write("own/a.in", "one\n<%= nil %>\n");
  EXPECT_THAT(Wrong(), EndsWith("own/a.in:2: what is to be written has no value"));
  Write("own/a.in", "one\n<% = %>\n");
  EXPECT_THAT(Wrong(), HasSubstr("own/a.in:2: syntax error"));
  Write("own/a.in", "one\n  <% x\n");
  EXPECT_THAT(Wrong(), EndsWith("own/a.in:2:3: '<%' has no end; close it by %>"));
  Write("own/template.lua", "\n\nerror('on purpose')\n");
  EXPECT_THAT(Wrong(), EndsWith("own/template.lua:3: on purpose"));
  Write("own/template.lua", "fail('as a whole')\n");
  EXPECT_EQ(Wrong(), "as a whole");
  Write("own/template.lua", "file('missing.in', 'a')\n");
  EXPECT_THAT(Wrong(), EndsWith("own/template.lua:1: there is no file 'missing.in' in the template"));
  Write("own/template.lua", "\nlocal a = has(nil, 'b')\n");
  EXPECT_THAT(Wrong(), HasSubstr("own/template.lua:2: bad argument #1 to"));
  Write("own/template.lua", "\nlocal own = library({})\n");
  EXPECT_THAT(Wrong(), HasSubstr("own/template.lua:2: "));
  std::filesystem::remove(folder_.path() / "own/template.lua");
  EXPECT_EQ(Wrong(), "there is no file 'template.lua' in the template");
}

TEST_F(TemplateRunTest, WhatDoesNotComeToAnEndIsEnded) {
  const auto wrong = [this](const std::string& text, std::size_t bytes = 10'000'000) {
    Write("own/template.lua", text);
    const auto result = RunTemplate(folder_.path() / "own", "{}", {}, {.steps = 2'000'000, .bytes = bytes});
    return result ? "" : result.error().ToString();
  };
  EXPECT_THAT(wrong("\nwhile true do\nend\n"), HasSubstr("the template does not come to an end"));
  EXPECT_THAT(wrong("\nwhile true do\nend\n"), HasSubstr("own/template.lua:2: "));
  EXPECT_THAT(wrong("local function f() return f() end f()"),
              HasSubstr("own/template.lua:1: the template does not come to an end"));
  EXPECT_THAT(wrong("local function f() return 1 + f() end f()", 500'000'000),
              HasSubstr("own/template.lua:1: stack overflow"));
  EXPECT_THAT(wrong("local all = {} while true do all[#all + 1] = string.rep('a', 1000000 + #all) end"),
              HasSubstr("own/template.lua: the template needs too much memory"));
  EXPECT_THAT(wrong("local text = string.rep('a', 1000000) while true do text = ('b' .. text):sub(1, 1000000) end"),
              HasSubstr("own/template.lua: the template needs too much memory"));
}

}  // namespace
}  // namespace runnel::genom
